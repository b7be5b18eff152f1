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

// What has no branches is written for one number or for eight (eight.hpp).

/// Where the thread's centre line can pass through a ring.
template <class N>
struct OpeningOf {
  Triple<N> center, normal;  ///< m; unit
  N radius;                  ///< m
};
using Opening = OpeningOf<double>;

/// A neighbour of a waypoint along the thread: a node, or a waypoint of another ring.
template <class N>
struct NeighbourOf {
  Triple<N> place;  ///< m
  N lift2;          ///< squared lift of the distance to it, m^2
};
using Neighbour = NeighbourOf<double>;

/// A neighbour as the opening sees it.
template <class N>
struct SeenAs {
  Triple<N> across;  ///< in-plane place relative to the centre, m
  N height;          ///< sqrt(z^2 + lift^2), m
  N axial;           ///< z, m
};
using Seen = SeenAs<double>;

template <class N>
inline SeenAs<N> seen_from(const OpeningOf<N>& o, const NeighbourOf<N>& n) {
  const Triple<N> d = n.place - o.center;
  const N z = dot(o.normal, d);
  return {d - z * o.normal, pick(n.lift2 > 0, square_root(z * z + n.lift2), magnitude(z)), z};
}

constexpr double no_length = 1e-12;  ///< m: places so near to each other are one

/// A neighbour in the waypoint itself pulls it in no direction.
template <class N>
inline N inverse_distance(const SeenAs<N>& s, Triple<N> offset) {
  const Triple<N> across = s.across - offset;
  const N d = square_root(dot(across, across) + s.height * s.height);
  return pick(d > no_length, 1 / d, N(0));
}

/// From a place to the nearest point of the opening, m.
inline double distance(const Opening& o, V3 place) {
  const V3 d = place - o.center;
  const double z = dot(o.normal, d);
  const double beyond = norm(d - z * o.normal) - o.radius, out = beyond > 0 ? beyond : 0.0;
  return std::sqrt(out * out + z * z);
}

/// The point of the segment from p to q that is nearest to the origin.
inline V3 nearest_to_origin(V3 p, V3 q) {
  const V3 m = q - p;
  const double mm = dot(m, m);
  double t = mm > 0 ? -dot(p, m) / mm : 0.0;
  t = t < 0 ? 0.0 : t > 1 ? 1.0 : t;
  return p + t * m;
}

/// 1 / sqrt(x) for x next to 1: without root and division, which wait for each other.
template <class N>
inline auto next_to_one(N x) {
  return magnitude(x - 1) < 1e-4;
}
template <class N>
inline N root_next_to_one(N x) {
  const N d = x - 1;
  return 1 - d * (0.5 - d * (0.375 - d * (0.3125 - d * 0.2734375)));
}

/// 1 / sqrt(x), for x that is mostly next to 1.
inline double inverse_root(double x) { return next_to_one(x) ? root_next_to_one(x) : 1 / std::sqrt(x); }

/// The rim point c e, how the way changes along the rim there, and how near the neighbours are.
template <class N>
struct RimPoint {
  Triple<N> along;  ///< t
  Triple<N> pull;   ///< W
  N slope, curve;   ///< t.W, and what it loses for a turn by one
  N near;           ///< c (1/D_q + 1/D_r): how many times a turn by one is the distance to a neighbour
};

template <class N>
inline RimPoint<N> at_rim(const OpeningOf<N>& o, const SeenAs<N>& q, const SeenAs<N>& r, Triple<N> e) {
  const Triple<N> t = cross(o.normal, e), p = o.radius * e;
  const N iq = inverse_distance(q, p), ir = inverse_distance(r, p);
  const Triple<N> w = iq * q.across + ir * r.across;
  const N tq = iq * dot(t, q.across), tr = ir * dot(t, r.across);
  return {t, w, dot(t, w), dot(e, w) - o.radius * (tq * tq * iq + tr * tr * ir), o.radius * (iq + ir)};
}

constexpr double close_turn = 1e-3;  // Newton squares it

/// Newton's step from a rim point to where the way has no slope.
template <class N>
struct NewtonTurn {
  Triple<N> to;              ///< the direction that it leads to
  N square;                  ///< ... squared, next to 1
  decltype(N() > N()) good;  ///< the way is convex in the angle here, and the step small
  decltype(N() > N()) last;  ///< small enough
};

template <class N>
inline NewtonTurn<N> newton_turn(const RimPoint<N>& p, Triple<N> e) {
  const N turn = p.slope / p.curve;
  return {e + turn * p.along, 1 + turn * turn,
          p.curve > 0.1 * magnitude(dot(e, p.pull)) && magnitude(p.slope) < p.curve,
          magnitude(turn) * (1 + p.near) < close_turn};
}

/// Turns the unit in-plane vector e to where the way over the rim point c e has no slope. Newton's method
/// where the way is convex in the angle, else the angle that Weiszfeld's rule gives (no step of it makes the
/// way longer). Returns whether it came to an end.
inline bool turn_on_rim(const Opening& o, const Seen& q, const Seen& r, V3& e) {
  constexpr int most_turns = 12;
  for (int i = 0; i < most_turns; ++i) {
    const RimPoint<double> p = at_rim(o, q, r, e);
    const NewtonTurn<double> turn = newton_turn(p, e);
    if (turn.good) {
      e = inverse_root(turn.square) * turn.to;
      if (turn.last) return true;
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
  constexpr int most_halvings = 100;  // 50 do, but where a folded host gives no normal
  const V3 middle = (1 / norm(x)) * x, side = cross(o.normal, middle);
  const double sine = cosine < 1 ? std::sqrt(1 - cosine * cosine) : 0.0;
  V3 low = cosine * middle - sine * side, high = cosine * middle + sine * side, e = middle;
  double last = 2 * sine;
  for (int i = 0; i < most_halvings && last > 1e-14; ++i) {
    const RimPoint<double> p = at_rim(o, q, r, e);
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

/// A vector that points where a search on the rim begins.
template <class N>
struct FirstDirection {
  Triple<N> along;
  N square;                      ///< its own
  decltype(N() > N()) by_guess;  ///< then next to 1
};

/// The last waypoint on the rim is a good guess, if it is one and lies on the side to which the way leads: x.
template <class N>
inline FirstDirection<N> first_direction(const OpeningOf<N>& o, Triple<N> guess, Triple<N> x) {
  const N inverse = 1 / o.radius;
  const Triple<N> flat = guess - dot(o.normal, guess) * o.normal;
  const Triple<N> e = inverse * flat;
  const N size2 = dot(e, e);
  const auto good = size2 > 0.8 && dot(e, x) > 0;
  return {pick(good, e, x), pick(good, size2, dot(x, x)), good};
}

/// Where the way would meet the plane of the opening if it could.
template <class N>
struct Crossing {
  SeenAs<N> q, r;
  Triple<N> x;               ///< the place in the plane times `sum`
  N sum;                     ///< of both heights, m
  decltype(N() > N()) over;  ///< the rim
};

template <class N>
inline Crossing<N> crossing(const OpeningOf<N>& o, const NeighbourOf<N>& from, const NeighbourOf<N>& to) {
  const SeenAs<N> q = seen_from(o, from), r = seen_from(o, to);
  const N sum = q.height + r.height, limit = o.radius * sum;
  const Triple<N> x = r.height * q.across + q.height * r.across;
  return {q, r, x, sum, sum > 0 && dot(x, x) > limit * limit};
}

/// The waypoint that makes the way from q to r shortest; `guess` is an offset to begin with, of any size.
inline Passage shortest_passage(const Opening& o, const Neighbour& from, const Neighbour& to, V3 guess) {
  const Crossing<double> c = crossing(o, from, to);
  if (!c.over) return passage_within(o, c.q, c.r, c.x, c.sum);
  const FirstDirection<double> first = first_direction(o, guess, c.x);
  const double root = first.by_guess ? inverse_root(first.square) : 1 / std::sqrt(first.square);
  return {rim_point(o, c.q, c.r, c.x, c.sum, root * first.along), false};
}

// The rings of one element: in rounds, waypoint after waypoint is moved to where it makes the way shortest.
// Each round shortens a function that is convex in all of them. A waypoint that stays behind by e makes the
// length wrong by e^2 over that of a leg, but forces by e: they act like friction.
constexpr double way_close = 1e-5;  ///< of the first opening's radius: so near waypoints come to their places

/// Whether a round that moved waypoints by up to `change`, the one before it by up to `last`, was the last
/// one. Rounds change less and less at about the same ratio: what is left is the sum of all to come.
template <class N>
inline auto at_rest(N change, N last, N close) {
  return change <= close || (change < last && change * change <= close * (last - change));
}

/// A straight piece of a way.
template <class N>
struct LegOf {
  Triple<N> unit;  ///< its direction
  N length;        ///< m
};
using Leg = LegOf<double>;

template <class N>
inline LegOf<N> leg(Triple<N> from, Triple<N> to, As<N> lift2) {
  const Triple<N> d = to - from;
  const N length = square_root(dot(d, d) + lift2);
  return {pick(length > no_length, 1 / length, N(0)) * d, length};
}

/// Else its direction is zero.
inline bool has_direction(const Leg& leg) { return leg.length > no_length; }

}  // namespace cinch::CINCH_ISA
