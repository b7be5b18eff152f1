// Minimise sum |d_i| over p_k in disc k, d_i = p_{i+1} - p_i, p_0 = a, p_{m+1} = b: convex, with kinks where
// waypoints coincide. An interior-point method: with slacks t_i >= |d_i| and p_k = c_k + E_k u_k, minimise
//
//   F = sum_i (s t_i - log(t_i^2 - |d_i|^2)) - sum_k log(1 - |u_k|^2)
//
// by Newton's method for a sharpness s (1/m) that grows without end. The slacks are eliminated.
#include "oracle/shortest_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace oracle {
namespace {

using Real = long double;
using Wide3 = Eigen::Matrix<Real, 3, 1>;
using Square3 = Eigen::Matrix<Real, 3, 3>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Points = std::vector<Wide3>;

constexpr Real gap_wanted = 1e-11L;  // m, between the path found and the lower bound

/// Disc as the image of the unit disc, p = c + E u with |u| <= 1.
struct Image {
  Wide3 center;                      // c
  Eigen::Matrix<Real, 3, 2> spread;  // E
};

Image image_of(const Disc& disc) {
  const Wide3 normal = disc.normal.cast<Real>().normalized();
  const Wide3 first = normal.unitOrthogonal();
  Image image;
  image.center = disc.center.cast<Real>();
  image.spread << Real(disc.radius) * first, Real(disc.radius) * normal.cross(first);
  return image;
}

struct Problem {
  Wide3 a, b;
  std::vector<Image> discs;

  Eigen::Index unknowns() const { return 2 * static_cast<Eigen::Index>(discs.size()); }
  std::size_t stretches() const { return discs.size() + 1; }

  /// a, the waypoints, b.
  Points path(const Vector& u) const {
    Points points = {a};
    for (const Image& disc : discs) {
      const auto k = static_cast<Eigen::Index>(points.size()) - 1;
      points.push_back(disc.center + disc.spread * u.segment<2>(2 * k));
    }
    points.push_back(b);
    return points;
  }

  /// Derivative of d_i with respect to u.
  Matrix slope_of_stretch(std::size_t i) const {
    const auto column = 2 * static_cast<Eigen::Index>(i);
    Matrix slope = Matrix::Zero(3, unknowns());
    if (i < discs.size()) slope.middleCols<2>(column) = discs[i].spread;
    if (i > 0) slope.middleCols<2>(column - 2) = -discs[i - 1].spread;
    return slope;
  }
};

Real length_of(const Points& points) {
  Real sum = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) sum += (points[i + 1] - points[i]).norm();
  return sum;
}

/// The unknowns, and the stretches that belong to them. A stretch between waypoints that nearly coincide
/// would drown in round-off as a difference of their places: each is kept by itself and moved by each step.
struct State {
  Vector u;
  Points d;
};

State at_centers(const Problem& problem) {
  State state{Vector::Zero(problem.unknowns()), {}};
  const Points points = problem.path(state.u);
  for (std::size_t i = 0; i < problem.stretches(); ++i) state.d.push_back(points[i + 1] - points[i]);
  return state;
}

void move(const Problem& problem, const Vector& step, State& state) {
  state.u += step;
  for (std::size_t i = 0; i < problem.stretches(); ++i) state.d[i] += problem.slope_of_stretch(i) * step;
}

/// The slack that minimises s t - log(t^2 - |d|^2).
Real best_slack(const Wide3& d, Real s) { return (1 + std::sqrt(1 + s * s * d.squaredNorm())) / s; }

/// q_i = d_i / t_i: the directions of the stretches, shorter than 1 and smooth where waypoints coincide.
Points directions(const Points& stretches, Real s) {
  Points q;
  for (const Wide3& d : stretches) q.push_back(d / best_slack(d, s));
  return q;
}

/// No path is shorter than this. |d_i| >= q_i . d_i for any |q_i| <= 1, and the sum of q_i . d_i is linear in
/// each waypoint, so that its minimum over a disc is known: at the centre less the radius times the slope.
Real lower_bound(const Problem& problem, const Points& q) {
  Real sum = q.back().dot(problem.b) - q.front().dot(problem.a);
  for (std::size_t k = 0; k < problem.discs.size(); ++k) {
    const Wide3 bend = q[k] - q[k + 1];
    sum += bend.dot(problem.discs[k].center) - (problem.discs[k].spread.transpose() * bend).norm();
  }
  return sum;
}

/// Gradient and Hessian of F with respect to u.
struct Expansion {
  Vector gradient;
  Matrix hessian;
};

void add_stretches(const Problem& problem, const Points& stretches, Real s, Expansion& sum) {
  for (std::size_t i = 0; i < problem.stretches(); ++i) {
    const Wide3 d = stretches[i];
    const Real t = best_slack(d, s);
    const Wide3 q = d / t;
    const Square3 curvature = s / t * (Square3::Identity() - s * t / (s * t - 1) * q * q.transpose());
    const Matrix slope = problem.slope_of_stretch(i);
    sum.gradient += s * slope.transpose() * q;
    sum.hessian += slope.transpose() * curvature * slope;
  }
}

void add_rims(const Vector& u, Expansion& sum) {
  for (Eigen::Index k = 0; k < u.size(); k += 2) {
    const Eigen::Matrix<Real, 2, 1> point = u.segment<2>(k);
    const Real inside = 1 - point.squaredNorm();
    sum.gradient.segment<2>(k) += 2 / inside * point;
    sum.hessian.diagonal().segment<2>(k).array() += 2 / inside;
    sum.hessian.block<2, 2>(k, k) += 4 / (inside * inside) * point * point.transpose();
  }
}

bool within_rims(const Vector& u) {
  for (Eigen::Index k = 0; k < u.size(); k += 2)
    if (!(u.segment<2>(k).squaredNorm() < 1)) return false;
  return true;
}

/// One step of Newton's method; returns the decrement. F is self-concordant: steps shortened by 1 + decrement
/// stay within the rims and lower F, with no line search. The halving is there for round-off alone.
Real newton_step(const Problem& problem, Real s, State& state) {
  const Eigen::Index n = problem.unknowns();
  Expansion at{Vector::Zero(n), Matrix::Zero(n, n)};
  add_stretches(problem, state.d, s, at);
  add_rims(state.u, at);
  Vector step = -at.hessian.ldlt().solve(at.gradient);
  const Real decrement = std::sqrt(std::max<Real>(0, -step.dot(at.gradient)));
  if (decrement > Real(0.25)) step /= 1 + decrement;
  for (int halvings = 0; !within_rims(state.u + step); ++halvings) {
    if (halvings == 100) return 0;
    step /= 2;
  }
  move(problem, step, state);
  return decrement;
}

void minimise(const Problem& problem, Real s, State& state) {
  for (int steps = 0; steps < 100; ++steps)
    if (newton_step(problem, s, state) < Real(1e-6)) return;
}

ShortestPath rounded(const Points& points) {
  ShortestPath path{static_cast<double>(length_of(points)), {}};
  for (std::size_t k = 1; k + 1 < points.size(); ++k) path.waypoints.push_back(points[k].cast<double>());
  return path;
}

}  // namespace

ShortestPath shortest_path(const cinch::Vec3& a, const std::vector<Disc>& discs, const cinch::Vec3& b) {
  Problem problem{a.cast<Real>(), b.cast<Real>(), {}};
  for (const Disc& disc : discs) problem.discs.push_back(image_of(disc));
  State state = at_centers(problem);
  if (discs.empty()) return rounded(problem.path(state.u));
  // From a sharpness that hardly feels the lengths to one whose gap, some 20 / s, is below what is wanted.
  // Well centred at each: what the decrement leaves over enters the bound.
  for (Real s = 1; s < Real(1e15); s *= 5) {
    minimise(problem, s, state);
    const Points points = problem.path(state.u);
    const Real bound = lower_bound(problem, directions(state.d, s));
    if (length_of(points) - bound < gap_wanted) return rounded(points);
  }
  throw std::runtime_error("shortest path: the gap to the lower bound does not close");
}

}  // namespace oracle
