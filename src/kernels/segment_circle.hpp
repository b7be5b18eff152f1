// Closest points of a thread element's centre line (a segment) and a ring's centre line (a circle in space).
//
// Si, Pang, Du, Fu, "Dynamics Modeling and Simulation of a Net Closing Mechanism for Tether-Net Capture",
// Int. J. Aerospace Eng. 2021, 8827141, Sec. 4.1. With M = A2 - A1, D = A1 - C, N the ring's unit normal,
// E = M - (N.M) N and F = D - (N.D) N, the squared distance of A(t) = A1 + t M from the circle is
//   f(t) = a6 t^2 + a5 t + a4 + a3 sqrt(a2 t^2 + a1 t + a0)                                         (4)
//   a6 = M.M, a5 = 2 D.M, a4 = D.D + R^2, a3 = -2 R, a2 = E.E, a1 = 2 E.F, a0 = F.F                  (5)
// (the paper prints a3 = -2 R^2, which has the wrong dimension).
//
// The exact method works on the same f written as a distance: with the axial place n = N.(A - C) and the
// distance rho = |F + t E| from the ring's axis, f = (rho - R)^2 + n^2, and half its derivative is
//   h(t)  = V (1 - R/rho) + (N.M) n,   V = (F + t E).E,   rho^2 = b^2 + V^2 / E.E,   b^2 = |F x E|^2 / E.E
//   h'(t) = M.M - R E.E b^2 / rho^3
//   h''(t) = 3 R E.E b^2 V / rho^5
// So h is concave before t0 (V = 0, where the line is nearest to the axis) and convex behind it, and f has at
// most one minimum on either side. Seen from the other end of the segment the concave side is convex too: one
// Newton iteration, from the far end of a convex piece downwards, serves both. It cannot overshoot a root.
// Which side: f(t0 + s) - f(t0 - s) = 4 c s with c = h(t0) = (N.M) n(t0). Walked in the direction in which c
// <= 0, the line has its lowest point behind t0, where h rises from c through its one root; the other side
// can win only if the segment ends before that root and reaches farther there. So there is never more than
// one root to find.
#pragma once
#include <cmath>

#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

struct CirclePoint {  // closest points of a segment (or point) and a circle
  double t;           // parameter on the segment, 0..1
  double distance;    // |PQ|
  V3 p;               // point on the segment
  V3 q;               // point on the circle
  V3 radial;          // unit vector from the centre to q, in the ring's plane
};

/// A unit vector normal to the unit vector n, by a rule that depends on n alone (Frisvad's basis). It turns
/// smoothly with n, but for a jump at 26 degrees from -z: no rule is smooth for all n.
inline V3 any_normal(V3 n) {
  const double s = n.z < -0.9 ? -1.0 : 1.0;
  const double a = 1.0 / (s + n.z);
  return {1.0 - s * n.x * n.x * a, -s * n.x * n.y * a, -s * n.x};
}

/// Closest point of the circle to p; t is 0. On the ring's axis all are equally near, and any_normal decides.
inline CirclePoint point_circle(V3 p, V3 center, V3 normal, double radius) {
  const V3 d = p - center;
  const double axial = dot(normal, d);
  V3 w = d - axial * normal;
  double rho2 = dot(w, w);
  if (rho2 < 0.1 * axial * axial) {  // take the rounding of the long axial part out of the short radial one
    w = w - dot(normal, w) * normal;
    rho2 = dot(w, w);
  }
  const bool on_axis = rho2 <= 1e-30 * axial * axial + 1e-280;
  const V3 radial = on_axis ? any_normal(normal) : 1.0 / std::sqrt(rho2) * w;
  const V3 q = center + radius * radial;
  return {0.0, norm(p - q), p, q, radial};
}

/// The segment's point at t, exact at both ends, and its closest point on the circle.
inline CirclePoint segment_point_circle(V3 a1, V3 a2, double t, V3 center, V3 normal, double radius) {
  const V3 m = a2 - a1;
  CirclePoint c = point_circle(t < 0.5 ? a1 + t * m : a2 - (1.0 - t) * m, center, normal, radius);
  c.t = t;
  return c;
}

/// No point of the segment is nearer to the circle than this: the distance changes by no more than the way
/// along it. Costs a fifth of the exact method or less; for sorting out candidates.
inline double segment_circle_lower_bound(V3 a1, V3 a2, V3 center, V3 normal, double radius) {
  const V3 m = a2 - a1;
  const V3 d = 0.5 * (a1 + a2) - center;
  const double axial = dot(normal, d);
  const V3 w = d - axial * normal;
  const double gap = norm(w) - radius;
  return std::sqrt(gap * gap + axial * axial) - 0.5 * norm(m);
}

// ---- exact method

/// What both directions along a segment share.
struct SegmentRing {
  double radius;
  double b2;          // squared distance of line and axis, in the ring's plane
  double ee, inv_ee;  // E.E and its inverse (both 0: parallel to the axis)
  double mm;          // M.M
};

/// The segment walked in one direction, u = 0..1: V = v + u ee, n = n0 + u dn.
struct Walk {
  double v, n0, dn;
};

struct HalfSlope {
  double h, dh, d2h;
  double d3h;  // a quarter of a bound of |h'''|
};

/// h and its derivatives at u, where V >= 0.
inline HalfSlope half_slope(const SegmentRing& s, const Walk& w, double u) {
  const double v = w.v + u * s.ee;
  const double rho2 = s.b2 + v * v * s.inv_ee;
  const double axial = w.dn * (w.n0 + u * w.dn);
  if (rho2 < 1e-280) return {axial + v - s.radius * std::sqrt(s.ee), s.mm, 0.0, 0.0};  // limit from V > 0
  const double inv = 1.0 / std::sqrt(rho2);
  const double k = s.radius * inv;
  const double bend = k * s.ee * (s.b2 * inv * inv);
  const double curl = 3.0 * bend * inv * inv;
  return {axial + (v - k * v), s.mm - bend, curl * v, curl * s.ee};
}

/// Squared distance at u.
inline double squared_distance(const SegmentRing& s, const Walk& w, double u) {
  const double v = w.v + u * s.ee;
  const double n = w.n0 + u * w.dn;
  const double gap = std::sqrt(s.b2 + v * v * s.inv_ee) - s.radius;
  return gap * gap + n * n;
}

/// Greatest root of h in [lo, 1], where h is convex and at = half_slope(1) has h > 0; lo if there is none.
/// Newton from above cannot pass a root; near one it is led on by Chebyshev's term, too small to reach
/// the other root. The order falls to one where two roots are about to merge and vanish, hence the cap.
inline double convex_root(const SegmentRing& s, const Walk& w, HalfSlope at, double lo) {
  double u = 1.0;
  for (int i = 0; i < 64; ++i) {
    if (!(at.dh > 0.0)) return at.h > 0.0 ? lo : u;  // past the lowest h: no root if it is positive
    const double inv = 1.0 / at.dh;
    const double step = at.h * inv;
    const double r2 = step * at.d2h * inv;
    const double r3 = step * step * at.d3h * inv;
    const double newton = u - step;
    if (!(newton > lo)) return lo;
    const double led = newton - 0.5 * step * r2;
    u = std::fabs(r2) < 0.25 ? (led > lo ? led : lo) : newton;
    if (std::fabs(step) * (r2 * r2 + r3) <= 1e-17) break;  // bounds the error that this step leaves
    at = half_slope(s, w, u);
  }
  return u < 1.0 ? u : 1.0;
}

/// Lowest point of f in [0, 1] where h is convex all along (V >= 0).
inline double lowest_one_side(const SegmentRing& s, const Walk& w) {
  const HalfSlope start = half_slope(s, w, 0.0);
  const HalfSlope end = half_slope(s, w, 1.0);
  double u = 1.0;
  if (end.h > 0.0) {
    if (start.h > 0.0 && start.dh >= 0.0) return 0.0;
    u = convex_root(s, w, end, 0.0);
  }
  if (start.h > 0.0 && squared_distance(s, w, 0.0) <= squared_distance(s, w, u)) return 0.0;
  return u;
}

/// Lowest point of f in [0, 1] where V = 0 lies inside and c <= 0; back is the segment walked the other way.
inline double lowest_two_sides(const SegmentRing& s, const Walk& w, const Walk& back) {
  const double u0 = -w.v * s.inv_ee;
  const HalfSlope end = half_slope(s, w, 1.0);
  if (end.h > 0.0) return convex_root(s, w, end, u0);
  if (u0 <= 0.5) return 1.0;
  const HalfSlope back_end = half_slope(s, back, 1.0);
  const double u = back_end.h > 0.0 ? convex_root(s, back, back_end, 1.0 - u0) : 1.0;
  return squared_distance(s, back, u) < squared_distance(s, w, 1.0) ? 1.0 - u : 1.0;
}

/// Closest points of a segment and a circle: the global minimum of f over 0 <= t <= 1.
inline CirclePoint segment_circle_exact(V3 a1, V3 a2, V3 center, V3 normal, double radius) {
  const V3 m = a2 - a1;
  const V3 d = a1 - center;
  const double nm = dot(normal, m);
  const double n1 = dot(normal, d);
  const V3 e = m - nm * normal;
  const V3 f = d - n1 * normal;
  double ee = dot(e, e);
  const double mm = ee + nm * nm;
  if (mm < 1e-200) return point_circle(a1, center, normal, radius);
  if (ee < 1e-30 * mm) ee = 0.0;  // parallel to the axis, but for rounding
  const double inv_ee = ee > 0.0 ? 1.0 / ee : 0.0;
  const V3 fe = cross(f, e);
  const SegmentRing s{radius, ee > 0.0 ? dot(fe, fe) * inv_ee : dot(f, f), ee, inv_ee, mm};
  const double v1 = ee > 0.0 ? dot(f, e) : 0.0;
  const Walk there{v1, n1, nm};
  const Walk back{-(v1 + ee), n1 + nm, -nm};
  double t;
  if (there.v >= 0.0) {
    t = lowest_one_side(s, there);
  } else if (back.v >= 0.0) {
    t = 1.0 - lowest_one_side(s, back);
  } else if (nm * (n1 - v1 * inv_ee * nm) <= 0.0) {  // c
    t = lowest_two_sides(s, there, back);
  } else {
    t = 1.0 - lowest_two_sides(s, back, there);
  }
  return segment_point_circle(a1, a2, t, center, normal, radius);
}

// ---- the paper's method

/// Golden-section search of eqs. (3)-(5) on [0, 1] until the interval is below 1e-8, where f no longer
/// resolves t. It finds one local minimum; of two, as on elements that are long beside the ring, it may
/// return the farther.
inline CirclePoint segment_circle_golden(V3 a1, V3 a2, V3 center, V3 normal, double radius) {
  const V3 m = a2 - a1;
  const V3 d = a1 - center;
  const V3 e = m - dot(normal, m) * normal;
  const V3 f = d - dot(normal, d) * normal;
  const double a6 = dot(m, m), a5 = 2.0 * dot(d, m), a4 = dot(d, d) + radius * radius;
  const double a3 = -2.0 * radius;
  const double a2_ = dot(e, e), a1_ = 2.0 * dot(e, f), a0 = dot(f, f);
  const auto squared = [=](double t) {
    const double rho2 = (a2_ * t + a1_) * t + a0;
    return (a6 * t + a5) * t + a4 + (rho2 > 0.0 ? a3 * std::sqrt(rho2) : 0.0);
  };
  const double ratio = 1.0 / 1.6180339887498949;
  double lo = 0.0, hi = 1.0;
  double x1 = hi - ratio * (hi - lo), x2 = lo + ratio * (hi - lo);
  double f1 = squared(x1), f2 = squared(x2);
  while (hi - lo > 1e-8) {
    if (f1 < f2) {
      hi = x2, x2 = x1, f2 = f1;
      x1 = hi - ratio * (hi - lo), f1 = squared(x1);
    } else {
      lo = x1, x1 = x2, f1 = f2;
      x2 = lo + ratio * (hi - lo), f2 = squared(x2);
    }
  }
  return segment_point_circle(a1, a2, 0.5 * (lo + hi), center, normal, radius);
}

}  // namespace cinch::CINCH_ISA
