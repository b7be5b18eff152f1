// Dense matrices: for scenes of some dozen nodes.
#include "spectrum.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "plan/stable_step.hpp"

namespace cinch::matrix {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// dt^2/4 k + dt/2 c along the element, what tension gives across.
Eigen::Matrix3d block(const Model& model, std::size_t e, const Vec3& between, double step) {
  const double length = between.norm();
  if (!(length > 0)) return Eigen::Matrix3d::Zero();
  const Vec3 along = between / length;
  const double k = model.stiffness[e], tension = k * std::max(length - model.rest_length[e], 0.0);
  const double quarter = step * step / 4;
  const double across = quarter * tension / length;
  const double in_line = quarter * k + step / 2 * model.damping[e];
  return (in_line - across) * along * along.transpose() + across * Eigen::Matrix3d::Identity();
}

/// 1 / sqrt(m) in the directions that are free.
std::vector<Eigen::Matrix3d> scales(const Model& model) {
  std::vector<Eigen::Matrix3d> all;
  for (const double mass : model.mass) all.push_back(Eigen::Matrix3d::Identity() / std::sqrt(mass));
  for (const kernel::Constraint& c : model.constraints) {
    const Vec3 axis(c.ax, c.ay, c.az);
    all[at(c.node)] = axis * axis.transpose() / std::sqrt(model.mass[at(c.node)]);
  }
  return all;
}

}  // namespace

double largest_usage(const Model& model, const std::vector<Vec3>& place, double step) {
  const std::vector<Eigen::Matrix3d> scale = scales(model);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * model.nodes, 3 * model.nodes);
  for (std::size_t e = 0; e < at(model.elements); ++e) {
    const Index a = model.end_a[e], b = model.end_b[e];
    const Eigen::Matrix3d k = block(model, e, place[at(b)] - place[at(a)], step);
    const Eigen::Matrix3d &sa = scale[at(a)], &sb = scale[at(b)];
    matrix.block<3, 3>(3 * a, 3 * a) += sa * k * sa;
    matrix.block<3, 3>(3 * b, 3 * b) += sb * k * sb;
    matrix.block<3, 3>(3 * a, 3 * b) -= sa * k * sb;
    matrix.block<3, 3>(3 * b, 3 * a) -= sb * k * sa;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

double critical_step(const Model& model, const std::vector<Vec3>& place) {
  double low = 0, high = 4 * stable_step(model).step;
  while (largest_usage(model, place, high) < 1) high *= 2;
  for (int round = 0; round < 40; ++round) {
    const double middle = (low + high) / 2;
    (largest_usage(model, place, middle) < 1 ? low : high) = middle;
  }
  return low;
}

std::vector<Vec3> places(const Assembly& assembly) {
  std::vector<Vec3> all;
  for (const AssemblyNode& node : assembly.nodes) all.push_back(node.position);
  return all;
}

}  // namespace cinch::matrix
