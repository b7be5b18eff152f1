#include "statics/workspace.hpp"

#include <algorithm>
#include <limits>

namespace cinch::statics {

Workspace::Workspace(const StaticNet& given, int most_iterations)
    : net(given), max_iterations(most_iterations), freedom(given) {
  for (std::size_t n = 0; n < net.mass.size(); ++n)
    if (net.support[n] != Support::fixed) weight += net.mass[n] * net.gravity.norm();
  if (weight <= 0) weight = freedom.largest(residual(net.position));
  node_weight = 3 * weight / std::max<Index>(1, freedom.size());
  for (const double rest : net.rest_length) length += rest / static_cast<double>(net.rest_length.size());
}

Vector Workspace::residual(const Points& x) const { return freedom.project(static_force(net, x)); }

void Workspace::factorise(const Sparse& matrix, double shift) {
  if (!analysed_) factor_.analyzePattern(matrix);
  analysed_ = true;
  factor_.setShift(shift);
  factor_.factorize(matrix);
  ++iterations;
}

Vector Workspace::solve(const Vector& load) const {
  if (factor_.info() == Eigen::Success) return factor_.solve(load);
  return Vector::Constant(load.size(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace cinch::statics
