// The movable degrees of freedom of a static net: free nodes have 3, guided nodes 1, fixed nodes none.
#pragma once
#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <vector>

#include "statics/element.hpp"

namespace cinch::statics {

using Vector = Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// position = start + sum of q[i] * direction[i] at node[i]; the directions of a node are orthonormal and
/// stand together, nodes in their order.
class Freedom {
 public:
  explicit Freedom(const StaticNet& net);

  Index size() const { return static_cast<Index>(node_.size()); }

  /// Part of nodal forces along each degree of freedom, N.
  Vector project(const Points& force) const;

  /// Points x moved by q, m.
  Points move(Points x, const Vector& q) const;

  /// Length of the part of r that belongs to node n, in the unit of r; zero for a fixed node.
  double nodal_norm(const Vector& r, std::size_t n) const;

  /// Node with the largest `nodal_norm`.
  std::size_t worst_node(const Vector& r) const;

  /// `nodal_norm` of the worst node; zero when nothing can move.
  double largest(const Vector& r) const { return r.size() > 0 ? nodal_norm(r, worst_node(r)) : 0; }

  /// Lower triangle of the matrix of element blocks block(e), N/m; the pattern never changes.
  Sparse assemble(const StaticNet& net, const std::function<Block(std::size_t)>& block) const;

 private:
  void add(std::size_t n, const Vec3& direction);
  void add_pair(std::vector<Eigen::Triplet<double>>& entries, std::size_t row, std::size_t column,
                const Block& k) const;

  std::vector<Index> first_;  ///< by node: its first degree of freedom; one more entry closes the last node
  std::vector<std::size_t> node_;
  Points direction_;
};

}  // namespace cinch::statics
