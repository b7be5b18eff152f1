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

/// Turns the unit in-plane vector e to where the way over the rim point c e is shortest. Newton's method
/// where the way is convex in the angle, else the angle that Weiszfeld's rule gives (no step of it makes the
/// way longer).
inline V3 turn_on_rim(const Opening& o, const Seen& q, const Seen& r, V3 e) {
  constexpr int most_turns = 50;       // reached only where the way is flat in the angle
  constexpr double close_turn = 1e-3;  // Newton squares it
  for (int i = 0; i < most_turns; ++i) {
    const V3 t = cross(o.normal, e), p = o.radius * e;
    const double iq = inverse_distance(q, p), ir = inverse_distance(r, p);
    const V3 w = iq * q.across + ir * r.across;
    const double slope = dot(t, w), steep = dot(e, w);
    const double tq = iq * dot(t, q.across), tr = ir * dot(t, r.across);
    const double curve = steep - o.radius * (tq * tq * iq + tr * tr * ir);
    if (curve > 0.1 * std::fabs(steep) && std::fabs(slope) < curve) {
      const double turn = slope / curve;
      e = inverse_root(1 + turn * turn) * (e + turn * t);
      if (std::fabs(turn) < close_turn) break;
    } else {
      const double length = norm(w);
      if (!(length > 0)) break;
      e = (1 / length) * w;  // in the plane, as both parts are
    }
  }
  return e;
}

/// A direction from which the rim point of the shortest way is found: walks through the disc by Weiszfeld's
/// rule, each step of which goes to the least of a paraboloid above the way's length.
[[gnu::cold]] inline V3 walk_to_rim(const Opening& o, const Seen& q, const Seen& r, V3 guess) {
  V3 p{0, 0, 0};
  double out = 0;
  for (int i = 0; i < 200; ++i) {
    const double iq = inverse_distance(q, p), ir = inverse_distance(r, p);
    if (!(iq + ir > 0)) break;
    p = (1 / (iq + ir)) * (iq * q.across + ir * r.across);
    out = norm(p);
    if (out > o.radius) p = (o.radius / out) * p;
  }
  return out > 0 ? (1 / norm(p)) * p : guess;
}

/// Whether the way gets no shorter when its rim point c e moves inwards: then, as the way is convex, there is
/// no shorter one; along the rim alone there may be.
inline bool leads_outwards(const Opening& o, const Seen& q, const Seen& r, V3 e) {
  const V3 p = o.radius * e;
  const double iq = inverse_distance(q, p), ir = inverse_distance(r, p);
  return dot(e, iq * q.across + ir * r.across) >= o.radius * (iq + ir) * (1 - 1e-4);
}

inline V3 rim_point(const Opening& o, const Seen& q, const Seen& r, V3 guess) {
  const V3 e = turn_on_rim(o, q, r, guess);
  return o.radius * (leads_outwards(o, q, r, e) ? e : turn_on_rim(o, q, r, walk_to_rim(o, q, r, e)));
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
  return {rim_point(o, q, r, (1 / std::sqrt(out2)) * nearest), false};
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
  return {rim_point(o, q, r, good ? inverse_root(size2) * e : (1 / std::sqrt(out2)) * x), false};
}

}  // namespace cinch::CINCH_ISA
