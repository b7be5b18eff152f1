#include "statics/freedom.hpp"

#include <algorithm>
#include <utility>

namespace cinch::statics {

Freedom::Freedom(const StaticNet& net) : first_(1, 0) {
  for (std::size_t n = 0; n < net.position.size(); ++n) {
    if (net.support[n] == Support::free)
      for (int c = 0; c < 3; ++c) add(n, Vec3::Unit(c));
    if (net.support[n] == Support::guided) add(n, net.axis[n].normalized());
    first_.push_back(size());
  }
}

Vector Freedom::project(const Points& force) const {
  Vector r(size());
  for (Index i = 0; i < size(); ++i) r[i] = direction_[at(i)].dot(force[node_[at(i)]]);
  return r;
}

Points Freedom::move(Points x, const Vector& q) const {
  for (Index i = 0; i < size(); ++i) x[node_[at(i)]] += q[i] * direction_[at(i)];
  return x;
}

double Freedom::nodal_norm(const Vector& r, std::size_t n) const {
  return r.segment(first_[n], first_[n + 1] - first_[n]).norm();
}

std::size_t Freedom::worst_node(const Vector& r) const {
  std::size_t worst = 0;
  for (std::size_t n = 1; n + 1 < first_.size(); ++n)
    if (!(nodal_norm(r, n) <= nodal_norm(r, worst))) worst = n;
  return worst;
}

Sparse Freedom::assemble(const StaticNet& net, const std::function<Block(std::size_t)>& block) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(at(size()) + 21 * net.elements.size());
  // the whole diagonal belongs to the pattern, also where a node has no elements
  for (Index i = 0; i < size(); ++i) entries.emplace_back(i, i, 0.0);
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const Block k = block(e);
    const auto [a, b] = net.elements[e];
    add_pair(entries, at(a), at(a), k);
    add_pair(entries, at(b), at(b), k);
    add_pair(entries, at(std::max(a, b)), at(std::min(a, b)), -k);
  }
  Sparse matrix(size(), size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void Freedom::add(std::size_t n, const Vec3& direction) {
  node_.push_back(n);
  direction_.push_back(direction);
}

void Freedom::add_pair(std::vector<Eigen::Triplet<double>>& entries, std::size_t row, std::size_t column,
                       const Block& k) const {
  for (Index i = first_[row]; i < first_[row + 1]; ++i)
    for (Index j = first_[column]; j < first_[column + 1]; ++j)
      if (i >= j) entries.emplace_back(i, j, direction_[at(i)].dot(k * direction_[at(j)]));
}

}  // namespace cinch::statics
