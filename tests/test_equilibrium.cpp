// Static equilibrium against closed forms, finite differences of its own energy, and bad first guesses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "statics/equilibrium.hpp"

namespace cinch {
namespace {

constexpr double g = 9.81;

Index add_node(StaticNet& net, const Vec3& position, double mass, Support support = Support::free) {
  net.position.push_back(position);
  net.mass.push_back(mass);
  net.support.push_back(support);
  net.axis.push_back(Vec3::UnitX());
  return static_cast<Index>(net.position.size()) - 1;
}

void add_element(StaticNet& net, Index a, Index b, double stiffness, double rest) {
  net.elements.push_back({a, b});
  net.stiffness.push_back(stiffness);
  net.rest_length.push_back(rest);
}

StaticNet empty_net() {
  StaticNet net;
  net.gravity = Vec3(0, 0, -g);
  return net;
}

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double weight(const StaticNet& net) {
  double sum = 0;
  for (std::size_t n = 0; n < net.mass.size(); ++n)
    if (net.support[n] != Support::fixed) sum += net.mass[n] * g;
  return sum;
}

double largest_free_force(const StaticNet& net, const std::vector<Vec3>& x) {
  const auto force = static_force(net, x);
  double largest = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    if (net.support[n] == Support::free) largest = std::max(largest, force[n].norm());
  return largest;
}

/// Square net in the xz plane, knot (i, j) is node j (meshes + 1) + i; aramid threads of 2 mm; upper corners
/// fixed; 0.5 g on each end of elements 1, 4, 7 and 10 of the lower edge.
StaticNet square_net(int meshes, double mesh, int parts = 1) {
  StaticNet net = empty_net();
  const double area = std::numbers::pi * 1e-6, rest = mesh / parts, half = 0.5 * meshes * mesh;
  for (int j = 0; j <= meshes; ++j)
    for (int i = 0; i <= meshes; ++i) add_node(net, Vec3(i * mesh - half, 0, j * mesh - half), 0);
  const auto side = [&](Index a, Index b) {
    const Vec3 from = net.position[at(a)], to = net.position[at(b)];
    for (int p = 1; p <= parts; ++p) {
      const Index previous = p == 1 ? a : static_cast<Index>(net.position.size()) - 1;
      const Index next = p == parts ? b : add_node(net, from + (to - from) * p / parts, 0);
      add_element(net, previous, next, 87e9 * area / rest, rest);
      for (const Index n : {previous, next}) net.mass[at(n)] += 650 * area * rest / 2;
    }
  };
  for (int j = 0; j <= meshes; ++j)
    for (int i = 0; i <= meshes; ++i) {
      const Index n = j * (meshes + 1) + i;
      if (i < meshes) side(n, n + 1);
      if (j < meshes) side(n, n + meshes + 1);
    }
  for (int i = 0; i < meshes; i += 3)
    for (const Index n : {i, i + 1}) net.mass[at(n)] += 5e-4;
  net.support[at(meshes * (meshes + 1))] = net.support[at(meshes * (meshes + 2))] = Support::fixed;
  return net;
}

/// Free nodes: position * factor plus jitter of the given size.
void disturb(StaticNet& net, double factor, double jitter) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (std::size_t n = 0; n < net.position.size(); ++n) {
    const Vec3 noise(unit(random), unit(random), unit(random));
    if (net.support[n] == Support::free) net.position[n] = factor * net.position[n] + jitter * noise;
  }
}

/// Chain of equal elements from (0, 0, 0) to (span, 0, 0), zigzag first guess.
StaticNet rope(int elements, double length, double span, double stiffness, double mass) {
  StaticNet net = empty_net();
  for (int i = 0; i <= elements; ++i) {
    const bool end = i == 0 || i == elements;
    add_node(net, Vec3(i == elements ? span : 0.01 * (i % 2), 0, 0), mass,
             end ? Support::fixed : Support::free);
    if (i > 0) add_element(net, i - 1, i, stiffness, length / elements);
  }
  return net;
}

double shape_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, (a[n] - b[n]).norm());
  return largest;
}

TEST(Equilibrium, MassBetweenTwoSprings) {
  // Springs from (-1, 0, 0) and (1, 0, 0), rest 1: at depth z, 2 k (l - 1) z / l = m g with l = sqrt(1 +
  // z^2).
  StaticNet net = empty_net();
  add_node(net, Vec3(-1, 0, 0), 0, Support::fixed);
  add_node(net, Vec3(1, 0, 0), 0, Support::fixed);
  const double z = 0.3, l = std::sqrt(1 + z * z), k = 5e4, mass = 2 * k * (l - 1) * z / l / g;
  add_node(net, Vec3(0.2, 0.1, 0.4), mass);
  add_element(net, 0, 2, k, 1);
  add_element(net, 2, 1, k, 1);
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_LT((result.position[2] - Vec3(0, 0, -z)).norm(), 1e-12);
  EXPECT_EQ(result.slack_elements, 0);
  EXPECT_NEAR(result.energy, k * (l - 1) * (l - 1) - mass * g * z, 1e-12 * k);
}

TEST(Equilibrium, HangingChainElongations) {
  // Element n from below carries n m g.
  StaticNet net = empty_net();
  const int elements = 50;
  const double k = 2.7e6, mass = 1e-3, rest = 0.02;
  add_node(net, Vec3::Zero(), mass, Support::fixed);
  for (int i = 1; i <= elements; ++i) {
    add_node(net, Vec3(0.015 * i, 0.003 * i, 0), mass);
    add_element(net, i - 1, i, k, rest);
  }
  const EquilibriumResult result = find_equilibrium(net);
  double depth = 0;
  for (int i = 1; i <= elements; ++i) {
    depth += rest + (elements + 1 - i) * mass * g / k;
    EXPECT_LT((result.position[at(i)] - Vec3(0, 0, -depth)).norm(), 5e-15 * i + 1e-15) << "node " << i;
  }
}

double catenary_error(int elements) {
  // Length 2 a sinh(span / 2 a); y = a (cosh(x / a) - cosh(span / 2 a)). The support carries H = w a
  // sideways.
  const double span = 1, a = 0.4, total = 2 * a * std::sinh(span / (2 * a)), line_weight = 0.3;
  const double mass = line_weight / g * total / elements;
  const StaticNet net = rope(elements, total, span, 1e8, mass);
  const EquilibriumResult result = find_equilibrium(net);
  double error = std::abs(static_force(net, result.position)[0].x() / (line_weight * a) - 1);
  for (const Vec3& p : result.position) {
    const double z = a * (std::cosh((p.x() - span / 2) / a) - std::cosh(span / (2 * a)));
    error = std::max({error, std::abs(p.z() - z), std::abs(p.y())});
  }
  return error;
}

TEST(Equilibrium, CatenaryIsApproachedQuadratically) {
  const double coarse = catenary_error(25), middle = catenary_error(50), fine = catenary_error(100);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / middle, 4, 0.2);
  EXPECT_NEAR(middle / fine, 4, 0.2);
}

TEST(Equilibrium, DiscreteChainCarriesOneHorizontalForce) {
  const StaticNet net = rope(100, 1.3, 1, 2e6, 1e-3);
  const EquilibriumResult result = find_equilibrium(net);
  double horizontal = 0;
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const Vec3 d = result.position[e + 1] - result.position[e];
    const double tension = 2e6 * (d.norm() - net.rest_length[e]);
    if (e == 0) horizontal = tension * d.x() / d.norm();
    EXPECT_NEAR(tension * d.x() / d.norm(), horizontal, 5e-9) << "element " << e;
    const double carried = (static_cast<double>(e) - 49.5) * 1e-3 * g;
    EXPECT_NEAR(tension * d.z() / d.norm(), carried, 5e-9) << "element " << e;
  }
}

TEST(Equilibrium, SquareNetBalances) {
  const StaticNet net = square_net(10, 0.1);
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_LE(result.relative_residual, 1e-9);
  EXPECT_LE(largest_free_force(net, result.position), 1e-9 * weight(net));
  const auto force = static_force(net, result.position);
  const Vec3 left = force[110], right = force[120];
  const double total = weight(net) + g * (net.mass[110] + net.mass[120]);
  EXPECT_NEAR(left.z() + right.z(), -total, 1e-8);
  EXPECT_NEAR(left.z(), right.z(), 1e-8);
  EXPECT_NEAR(left.x(), -right.x(), 1e-8);
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i) {
      const Vec3 p = result.position[at(11 * j + i)], q = result.position[at(11 * j + 10 - i)];
      EXPECT_NEAR(p.x(), -q.x(), 1e-9);
      EXPECT_NEAR(p.z(), q.z(), 1e-9);
      EXPECT_NEAR(p.y(), 0, 1e-9);
    }
}

TEST(Equilibrium, EnergyIsLowestAtTheResult) {
  // Soft enough that the rise of the energy stands clear of its rounding.
  StaticNet net = square_net(10, 0.1);
  for (double& k : net.stiffness) k *= 1e-3;
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_DOUBLE_EQ(result.energy, static_energy(net, result.position));
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> x = result.position;
    const double size = std::pow(10.0, -5 + trial % 4);
    for (std::size_t n = 0; n < x.size(); ++n)
      if (net.support[n] == Support::free)
        x[n] += size * Vec3(normal(random), normal(random), normal(random));
    EXPECT_GT(static_energy(net, x), result.energy) << "trial " << trial;
  }
}

TEST(Equilibrium, ForceIsMinusGradientOfEnergy) {
  StaticNet net = square_net(3, 0.1);
  for (double& k : net.stiffness) k = 1000;
  std::vector<Vec3> x = net.position;
  disturb(net, 1.2, 0.03);
  std::swap(x, net.position);
  const auto force = static_force(net, x);
  const double h = 1e-6;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int c = 0; c < 3; ++c) {
      auto ahead = x, behind = x;
      ahead[n][c] += h;
      behind[n][c] -= h;
      const double slope = (static_energy(net, ahead) - static_energy(net, behind)) / (2 * h);
      EXPECT_NEAR(force[n][c], -slope, 1e-7) << "node " << n << " coordinate " << c;
    }
}

TEST(Equilibrium, HessianIsMinusGradientOfForce) {
  StaticNet net = square_net(3, 0.1);
  for (double& k : net.stiffness) k = 1000;
  disturb(net, 1.2, 0.03);
  const auto x = net.position;
  const Eigen::MatrixXd lower(static_hessian(net, x));
  const Eigen::MatrixXd hessian = lower.selfadjointView<Eigen::Lower>();
  const double h = 1e-7;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int c = 0; c < 3; ++c) {
      auto ahead = x, behind = x;
      ahead[n][c] += h;
      behind[n][c] -= h;
      const auto up = static_force(net, ahead), down = static_force(net, behind);
      for (std::size_t m = 0; m < x.size(); ++m)
        for (int b = 0; b < 3; ++b) {
          const double slope = (up[m][b] - down[m][b]) / (2 * h);
          const auto row = static_cast<Eigen::Index>(3 * m) + b,
                     column = static_cast<Eigen::Index>(3 * n) + c;
          EXPECT_NEAR(hessian(row, column), -slope, 1e-4);
        }
    }
}

class BadGuess : public testing::TestWithParam<std::array<double, 2>> {};

TEST_P(BadGuess, GivesTheSameShape) {
  const auto [factor, jitter] = GetParam();
  const StaticNet good = square_net(10, 0.1);
  StaticNet bad = good;
  disturb(bad, factor, jitter);
  const EquilibriumResult result = find_equilibrium(bad);
  EXPECT_LE(result.relative_residual, 1e-9);
  EXPECT_LT(shape_difference(result.position, find_equilibrium(good).position), 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Equilibrium, BadGuess,
                         testing::Values(std::array{0.1, 0.0},     // folded to one tenth
                                         std::array{1.0, 0.01},    // jitter
                                         std::array{0.9, 0.0},     // nearly all members slack
                                         std::array{0.0, 0.0},     // all free nodes on one point
                                         std::array{-3.0, 1.0}));  // inside out and far too large

TEST(Equilibrium, SubElements) {
  StaticNet net = square_net(10, 0.1, 2);
  disturb(net, 0.1, 0.01);
  const EquilibriumResult result = find_equilibrium(net);
  // One last place of a coordinate times k is 6e-10 N here, 1.2e-9 of the weight.
  EXPECT_LE(result.relative_residual, 2.5e-9);
}

TEST(Equilibrium, SofterNetReachesTighterTolerance) {
  StaticNet net = square_net(10, 0.1);
  for (double& k : net.stiffness) k *= 1e-2;
  EXPECT_LE(find_equilibrium(net, {.tolerance = 1e-11}).relative_residual, 1e-11);
}

TEST(Equilibrium, ResultStaysPutUnderExplicitSteps) {
  const StaticNet net = square_net(4, 0.1);
  const EquilibriumResult result = find_equilibrium(net);
  std::vector<Vec3> x = result.position, velocity(x.size(), Vec3::Zero());
  const double step = 1e-6;
  for (int i = 0; i < 100000; ++i) {
    const auto force = static_force(net, x);
    for (std::size_t n = 0; n < x.size(); ++n) {
      if (net.support[n] == Support::fixed) continue;
      velocity[n] += step / net.mass[n] * force[n];
      x[n] += step * velocity[n];
    }
  }
  EXPECT_LT(shape_difference(x, result.position), 1e-8);
}

TEST(Equilibrium, SlackRopeFoldedStart) {
  const StaticNet net = rope(200, 3, 0.5, 1e6, 1e-3);
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_LE(result.relative_residual, 1e-9);
  EXPECT_EQ(result.slack_elements, 0);
  EXPECT_NEAR(result.position[100].x(), 0.25, 1e-9);
}

TEST(Equilibrium, UnloadedMembersGoSlack) {
  // A rhombus hung from its top with a heavy foot: the cross tie, longer than the gap it spans, stays slack.
  StaticNet net = empty_net();
  add_node(net, Vec3::Zero(), 0, Support::fixed);
  for (const double side : {-1.0, 1.0}) add_node(net, Vec3(0.1 * side, 0, -0.5), 1e-3);
  add_node(net, Vec3(0, 0, -1), 1);
  for (const Index n : {1, 2}) {
    add_element(net, 0, n, 1e6, 0.5);
    add_element(net, n, 3, 1e6, 0.5);
  }
  add_element(net, 1, 2, 1e6, 0.4);
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_LE(result.relative_residual, 1e-9);
  EXPECT_EQ(result.slack_elements, 1);
  EXPECT_NEAR(result.position[3].z(), -1 - (1.001 + 1) * g / 2 / 1e6, 1e-7);
}

TEST(Equilibrium, LargeNetInSeconds) {
  const StaticNet net = square_net(60, 0.1);
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_LE(result.relative_residual, 1e-9);
  EXPECT_LT(result.iterations, 150);
}

TEST(Equilibrium, GuidedNodeMovesAlongItsAxisOnly) {
  // Ring on a wire through (0, 0, -0.5) along (3, 0, -4) / 5, thread of length 1 from the origin: along the
  // wire the thread balances the ring's weight.
  StaticNet net = empty_net();
  const Vec3 start(0, 0, -0.5), axis = Vec3(3, 0, -4) / 5;
  const double mass = 0.1, k = 1e6;
  add_node(net, Vec3::Zero(), 0, Support::fixed);
  add_node(net, start, mass, Support::guided);
  net.axis[1] = axis;
  add_element(net, 0, 1, k, 1);
  const EquilibriumResult result = find_equilibrium(net);
  const Vec3 p = result.position[1];
  EXPECT_LT((p - start).cross(axis).norm(), 1e-15);
  const double tension = k * (p.norm() - 1);
  EXPECT_NEAR(tension * p.dot(axis) / p.norm(), mass * net.gravity.dot(axis), 1e-8);
  EXPECT_LE(result.relative_residual, 1e-9);
}

TEST(Equilibrium, HorizontalGuideHoldsAPiece) {
  StaticNet net = empty_net();
  add_node(net, Vec3(0.3, 0, 0), 0.1, Support::guided);
  add_node(net, Vec3(0.7, 0, -0.2), 0.2);
  add_element(net, 0, 1, 1e5, 0.5);
  const EquilibriumResult result = find_equilibrium(net);
  EXPECT_NEAR((result.position[1] - result.position[0]).z(), -0.5 - 0.2 * g / 1e5, 1e-12);
  EXPECT_NEAR(result.position[1].x(), result.position[0].x(), 1e-9);
}

TEST(Equilibrium, WithoutGravityThePrestressBalances) {
  StaticNet net = rope(10, 0.9, 1, 1e4, 1e-3);
  net.gravity = Vec3::Zero();
  const EquilibriumResult result = find_equilibrium(net);
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(result.position[at(i)].x(), 0.1 * i, 1e-12);
}

std::string error_of(const StaticNet& net, const EquilibriumOptions& options = {}) {
  try {
    find_equilibrium(net, options);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

TEST(Equilibrium, UnsupportedPieceIsNamed) {
  StaticNet net = square_net(2, 0.1);
  const Index a = add_node(net, Vec3(5, 0, 0), 1e-3), b = add_node(net, Vec3(5.25, 0, 0), 1e-3);
  add_element(net, a, b, 1e4, 0.2);
  EXPECT_NE(error_of(net).find("piece of 2 nodes with node 9 at (5, 0, 0) m can fall"), std::string::npos)
      << error_of(net);
  net.support[at(b)] = Support::guided;
  net.axis[at(b)] = Vec3(0.6, 0, 0.8);
  EXPECT_NE(error_of(net).find("can fall"), std::string::npos);
  net.support[at(b)] = Support::fixed;
  EXPECT_EQ(error_of(net), "");
}

TEST(Equilibrium, FailureNamesTheWorstNode) {
  const std::string text = error_of(square_net(10, 0.1), {.max_iterations = 1});
  EXPECT_NE(text.find("static equilibrium not found: node "), std::string::npos) << text;
  EXPECT_NE(text.find("of the weight"), std::string::npos) << text;
}

TEST(Equilibrium, ArraysThatDoNotFitAreRefused) {
  StaticNet net = square_net(2, 0.1);
  net.stiffness[3] = 0;
  EXPECT_NE(error_of(net).find("element 3"), std::string::npos);
  net.stiffness.pop_back();
  EXPECT_NE(error_of(net).find("differ in length"), std::string::npos);
  net = square_net(2, 0.1);
  net.position[4].z() = std::nan("");
  EXPECT_NE(error_of(net).find("bad position, mass or axis of node 4"), std::string::npos) << error_of(net);
  net.mass.pop_back();
  EXPECT_NE(error_of(net).find("differ in length"), std::string::npos);
}

TEST(Equilibrium, NothingToMove) {
  StaticNet net = empty_net();
  EXPECT_EQ(find_equilibrium(net).iterations, 0);
  add_node(net, Vec3::Zero(), 1, Support::fixed);
  EXPECT_EQ(find_equilibrium(net).relative_residual, 0);
}

}  // namespace
}  // namespace cinch
