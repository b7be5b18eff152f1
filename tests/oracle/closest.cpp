#include "oracle/closest.hpp"

#include <algorithm>
#include <cmath>

namespace oracle {
namespace {

using Real = long double;
using Wide3 = Eigen::Matrix<Real, 3, 1>;

/// A straight line seen from a circle: what the paper calls D, M, E and F, with C_B as the origin.
struct LineAndCircle {
  Wide3 start, along;  // D, M
  Wide3 normal;        // N_B
  Real radius = 0;     // R_B

  Wide3 flat(const Wide3& v) const { return v - normal.dot(v) * normal; }
  Real axis_distance(Real t) const { return flat(start + t * along).norm(); }

  /// Squared distance, eq. (4) with a3 = -2 R_B, written as a sum of squares.
  Real squared_distance(Real t) const {
    const Real height = normal.dot(start + t * along);
    const Real outside = axis_distance(t) - radius;
    return height * height + outside * outside;
  }

  /// Half the derivative of the squared distance with respect to t.
  Real slope(Real t) const {
    const Wide3 point = start + t * along;
    const Wide3 flat_point = flat(point);
    const Real rho = flat_point.norm();
    const Real inwards = rho > 0 ? radius * flat_point.dot(flat(along)) / rho : 0;
    return point.dot(along) - inwards;
  }
};

struct Interval {
  Real left = 0, right = 0;
};

/// Golden section on an interval with one minimum; returns an interval that holds it.
Interval golden_section(const LineAndCircle& f, const Interval& whole) {
  const Real ratio = (std::sqrt(Real(5)) - 1) / 2;
  Interval now = whole;
  Real p = now.right - ratio * (now.right - now.left), q = now.left + ratio * (now.right - now.left);
  Real at_p = f.squared_distance(p), at_q = f.squared_distance(q);
  while (now.right - now.left > Real(1e-5)) {
    if (at_p <= at_q) {
      now.right = q;
      q = p, at_q = at_p;
      p = now.right - ratio * (now.right - now.left);
      at_p = f.squared_distance(p);
    } else {
      now.left = p;
      p = q, at_p = at_q;
      q = now.left + ratio * (now.right - now.left);
      at_q = f.squared_distance(q);
    }
  }
  // One width more on each side: a flat minimum may have misled the last comparisons.
  const Real width = now.right - now.left;
  return {std::max(whole.left, now.left - width), std::min(whole.right, now.right + width)};
}

/// Root of a rising slope; an end of the interval where the slope does not change its sign.
Real bisection(const LineAndCircle& f, Interval now) {
  if (f.slope(now.left) >= 0) return now.left;
  if (f.slope(now.right) <= 0) return now.right;
  while (now.right - now.left > Real(1e-17)) {
    const Real middle = (now.left + now.right) / 2;
    (f.slope(middle) < 0 ? now.left : now.right) = middle;
  }
  return (now.left + now.right) / 2;
}

void try_point(const LineAndCircle& f, Real t, Real& best) {
  if (f.squared_distance(t) < f.squared_distance(best)) best = t;
}

void try_piece(const LineAndCircle& f, Real left, Real right, Real& best) {
  if (left < right) try_point(f, bisection(f, golden_section(f, {left, right})), best);
}

/// The squared distance is concave where rho^3 < R rho_min^2 a2 / a6, an interval about the point nearest to
/// the axis (it may be empty, or that point alone), and convex on both sides of it: one minimum on each side
/// at most.
Interval concave_part(const LineAndCircle& f) {
  const Wide3 flat_along = f.flat(f.along);
  const Real a2 = flat_along.squaredNorm(), a6 = f.along.squaredNorm();
  if (!(a2 > 0)) return {0, 0};
  const Real nearest = -f.flat(f.start).dot(flat_along) / a2;
  const Real rho_min = f.axis_distance(nearest);
  const Real rho_edge = std::cbrt(f.radius * rho_min * rho_min * a2 / a6);
  const Real half = rho_edge > rho_min ? std::sqrt((rho_edge * rho_edge - rho_min * rho_min) / a2) : 0;
  return {nearest - half, nearest + half};
}

}  // namespace

Closest closest_to_circle(const cinch::Vec3& a, const cinch::Vec3& b, const cinch::Vec3& center,
                          const cinch::Vec3& normal, double radius) {
  const Wide3 wide_a = a.cast<Real>(), wide_center = center.cast<Real>();
  const LineAndCircle f{wide_a - wide_center, b.cast<Real>() - wide_a, normal.cast<Real>().normalized(),
                        radius};
  const Interval concave = concave_part(f);
  Real best = 0;
  try_piece(f, 0, std::min<Real>(1, concave.left), best);
  try_piece(f, std::max<Real>(0, concave.right), 1, best);
  try_point(f, 1, best);
  return {static_cast<double>(best), static_cast<double>(std::sqrt(f.squared_distance(best)))};
}

Closest closest_to_point(const cinch::Vec3& a, const cinch::Vec3& b, const cinch::Vec3& point) {
  const Wide3 start = (a - point).cast<Real>(), along = (b - a).cast<Real>();
  const Real length2 = along.squaredNorm();
  const Real t = length2 > 0 ? std::clamp<Real>(-start.dot(along) / length2, 0, 1) : 0;
  return {static_cast<double>(t), static_cast<double>((start + t * along).norm())};
}

}  // namespace oracle
