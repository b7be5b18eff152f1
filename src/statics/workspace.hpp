// What the methods share while they solve one net: its scales, its degrees of freedom, its factorisation.
#pragma once
#include <Eigen/SparseCholesky>

#include "statics/freedom.hpp"

namespace cinch::statics {

/// Refers to the net it is made for.
struct Workspace {
  const StaticNet& net;
  int max_iterations;
  Freedom freedom;
  double weight = 0;       ///< of the movable nodes, N; without any, the largest residual of the first guess
  double node_weight = 0;  ///< mean share of three degrees of freedom in it, N
  double length = 0;       ///< mean rest length, m
  int iterations = 0;      ///< factorisations so far, by both methods

  Workspace(const StaticNet& net, int max_iterations);

  /// Force along each degree of freedom at positions x, N.
  Vector residual(const Points& x) const;

  /// Factorises matrix + shift I, lower triangle, N/m. All matrices must have the pattern of the first: it is
  /// analysed only once.
  void factorise(const Sparse& matrix, double shift);

  /// Displacements under a load, m, by the latest factorisation. Not a number where that failed, which both
  /// methods take as a step to refuse.
  Vector solve(const Vector& load) const;

 private:
  bool analysed_ = false;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower> factor_;
};

}  // namespace cinch::statics
