// The shortest way of a thread through the openings of rings.
//
// An opening is the disc in which the thread's centre line can pass: centre C, unit normal N, radius
// c = R_B - r_A - r_B. The way |q - p| + |p - r| by a point p of one disc is convex in p. With the axial
// places z_q = N.(q - C), z_r and the in-plane places w_q, w_r, unfolding the way at the disc's plane makes
// it a straight line, which meets the plane at
//   x = (|z_r| w_q + |z_q| w_r) / (|z_q| + |z_r|);
// that is p if |x| <= c: the thread does not touch the wire (it lies on the line from q to r unless both are
// on one side). Else p = c e lies on the rim, where the way has no slope along the rim. With t = N x e,
// D_q = |q - p| and W = w_q/D_q + w_r/D_r that is t.W = 0; the slope -c t.W changes with the angle by
//   c (e.W - c ((t.w_q)^2/D_q^3 + (t.w_r)^2/D_r^3)).
//
// Two rings of one element may come so close that their waypoints coincide, where |q - p| has no slope.
// Between rings the distance is therefore sqrt(|q - p|^2 + lift^2): that of points which lie `lift` apart
// across all directions. All of the above holds with |z| replaced by sqrt(z^2 + lift^2).
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

/// Where the thread's centre line can pass through a ring.
struct Opening {
  V3 center, normal;  ///< m; unit
  double radius;      ///< m
};

/// A neighbour of a waypoint along the thread: a node, or a waypoint of another ring.
struct Neighbour {
  V3 place;      ///< m
  double lift2;  ///< squared lift of the distance to it, m^2
};

/// A neighbour as the opening sees it.
struct Seen {
  V3 across;      ///< in-plane place relative to the centre, m
  double height;  ///< sqrt(z^2 + lift^2), m
  double axial;   ///< z, m
};

inline Seen seen_from(const Opening& o, const Neighbour& n) {
  const V3 d = n.place - o.center;
  const double z = dot(o.normal, d);
  return {d - z * o.normal, n.lift2 > 0 ? std::sqrt(z * z + n.lift2) : std::fabs(z), z};
}

inline double seen_distance(const Seen& s, V3 offset) {
  const V3 d = s.across - offset;
  return std::sqrt(dot(d, d) + s.height * s.height);
}

/// A neighbour in the waypoint itself pulls it in no direction.
inline double inverse_distance(const Seen& s, V3 offset) {
  const double d = seen_distance(s, offset);
  return d > 1e-12 ? 1 / d : 0.0;
}

/// The point of the segment from p to q that is nearest to the origin.
inline V3 nearest_to_origin(V3 p, V3 q) {
  const V3 m = q - p;
  const double mm = dot(m, m);
  double t = mm > 0 ? -dot(p, m) / mm : 0.0;
  t = t < 0 ? 0.0 : t > 1 ? 1.0 : t;
  return p + t * m;
}

/// 1 / sqrt(x), for x that is mostly next to 1: there without root and division, which wait for each other.
inline double inverse_root(double x) {
  const double d = x - 1;
  if (!(std::fabs(d) < 1e-4)) return 1 / std::sqrt(x);
  return 1 - d * (0.5 - d * (0.375 - d * (0.3125 - d * 0.2734375)));
}

/// The rim point c e, how the way changes along the rim there, and how near the neighbours are.
struct RimPoint {
  V3 along;             ///< t
  V3 pull;              ///< W
  double slope, curve;  ///< t.W, and what it loses for a turn by one
  double near;          ///< c (1/D_q + 1/D_r): how many times a turn by one is the distance to a neighbour
};

inline RimPoint at_rim(const Opening& o, const Seen& q, const Seen& r, V3 e) {
  const V3 t = cross(o.normal, e), p = o.radius * e;
  const double iq = inverse_distance(q, p), ir = inverse_distance(r, p);
  const V3 w = iq * q.across + ir * r.across;
  const double tq = iq * dot(t, q.across), tr = ir * dot(t, r.across);
  return {t, w, dot(t, w), dot(e, w) - o.radius * (tq * tq * iq + tr * tr * ir), o.radius * (iq + ir)};
}

constexpr double close_turn = 1e-3;  // Newton squares it

/// Turns the unit in-plane vector e to where the way over the rim point c e has no slope. Newton's method
/// where the way is convex in the angle, else the angle that Weiszfeld's rule gives (no step of it makes the
/// way longer). Returns whether it came to an end.
inline bool turn_on_rim(const Opening& o, const Seen& q, const Seen& r, V3& e) {
  constexpr int most_turns = 12;
  for (int i = 0; i < most_turns; ++i) {
    const RimPoint p = at_rim(o, q, r, e);
    if (p.curve > 0.1 * std::fabs(dot(e, p.pull)) && std::fabs(p.slope) < p.curve) {
      const double turn = p.slope / p.curve;
      e = inverse_root(1 + turn * turn) * (e + turn * p.along);
      if (std::fabs(turn) * (1 + p.near) < close_turn) return true;
    } else {
      const double length = norm(p.pull);
      if (!(length > 0)) return false;
      e = (1 / length) * p.pull;  // in the plane, as both parts are
    }
  }
  return false;
}

/// The same within the arc of the rim that is seen from x, by Newton's method where it more than halves the
/// step, else by halving the arc: comes to an end wherever the neighbours are.
[[gnu::cold, gnu::noinline]] inline V3 search_rim(const Opening& o, const Seen& q, const Seen& r, V3 x,
                                                  double cosine) {
  const V3 middle = (1 / norm(x)) * x, side = cross(o.normal, middle);
  const double sine = cosine < 1 ? std::sqrt(1 - cosine * cosine) : 0.0;
  V3 low = cosine * middle - sine * side, high = cosine * middle + sine * side, e = middle;
  for (double last = 2 * sine; last > 1e-14;) {
    const RimPoint p = at_rim(o, q, r, e);
    (p.slope > 0 ? low : high) = e;
    const double turn = p.curve > 0 ? p.slope / p.curve : 2.0;
    const V3 newton = (1 / std::sqrt(1 + turn * turn)) * (e + turn * p.along), half = low + high;
    const bool good = std::fabs(turn) < 0.5 * last && dot(o.normal, cross(low, newton)) > 0 &&
                      dot(o.normal, cross(newton, high)) > 0;
    e = good ? newton : (1 / norm(half)) * half;
    if (good && std::fabs(turn) * (1 + p.near) < close_turn) break;
    last = good ? std::fabs(turn) : 0.5 * norm(high - low);
  }
  return e;
}

/// x: where the way would meet the plane if it could, times `scale`. The way is convex, so from its shortest
/// rim point it falls towards x, which then lies outwards; and on the arc from which x is seen, every place
/// without slope is such a point. So there is one only, and a place beyond the arc is none.
inline V3 rim_point(const Opening& o, const Seen& q, const Seen& r, V3 x, double scale, V3 guess) {
  const double limit = o.radius * scale;
  V3 e = guess;
  const bool found = turn_on_rim(o, q, r, e) && dot(e, x) > limit;
  return o.radius * (found ? e : search_rim(o, q, r, x, limit / norm(x)));
}

/// Where the thread passes through one opening.
struct Passage {
  V3 offset;      ///< of the waypoint from the centre, m
  bool straight;  ///< touches nothing and does not turn back: no force on the ring
};

/// The same where the way does not lead over the rim; x is the place in the plane times the sum of heights.
inline Passage passage_within(const Opening& o, const Seen& q, const Seen& r, V3 x, double sum) {
  if (sum > 0) return {(1 / sum) * x, q.axial * r.axial <= 0};
  const V3 nearest = nearest_to_origin(q.across, r.across);  // both in the plane
  const double out2 = dot(nearest, nearest);
  if (!(out2 > o.radius * o.radius)) return {nearest, true};
  return {rim_point(o, q, r, nearest, 1, (1 / std::sqrt(out2)) * nearest), false};
}

/// The waypoint that makes the way from q to r shortest; `guess` is an offset to begin with, of any size.
inline Passage shortest_passage(const Opening& o, const Neighbour& from, const Neighbour& to, V3 guess) {
  const Seen q = seen_from(o, from), r = seen_from(o, to);
  const double sum = q.height + r.height, limit = o.radius * sum;
  const V3 x = r.height * q.across + q.height * r.across;  // times the sum
  const double out2 = dot(x, x);
  if (!(sum > 0) || !(out2 > limit * limit)) return passage_within(o, q, r, x, sum);
  // the last waypoint on the rim is a good guess, if it is one and lies on the side to which the way leads
  const double inverse = 1 / o.radius;
  const V3 flat = guess - dot(o.normal, guess) * o.normal;
  const V3 e = inverse * flat;
  const double size2 = dot(e, e);
  const bool good = size2 > 0.8 && dot(e, x) > 0;
  const V3 first = good ? inverse_root(size2) * e : (1 / std::sqrt(out2)) * x;
  return {rim_point(o, q, r, x, sum, first), false};
}

}  // namespace cinch::CINCH_ISA
