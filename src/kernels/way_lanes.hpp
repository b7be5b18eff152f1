// The shortest ways through the rings of eight elements at once: shortest_path.hpp and the rounds of
// sliding_way.hpp, one element in each lane. One way is a chain of roots and divisions that wait for each
// other; those of eight go side by side.
//
// The few that need a branch of their own are marked hard and left to sliding_way.hpp.
#pragma once
#include "kernels/eight.hpp"
#include "kernels/shortest_path.hpp"

namespace cinch::CINCH_ISA {

constexpr int way_lanes = 8;
constexpr int lane_rings = 8;  ///< of one element, at most

using Eights = Triple<Eight>;

inline V3 at(const Eights& v, int i) { return {v.x[i], v.y[i], v.z[i]}; }
inline void put(V3 v, Eights& to, int i) { to.x.put(i, v.x), to.y.put(i, v.y), to.z.put(i, v.z); }

/// Element i has rings[i] rings; places are its first node, the waypoints and its second node.
struct WayLanes {
  // in
  OpeningOf<Eight> opening[lane_rings];
  Eights offset[lane_rings];  ///< of waypoints from the openings' centres, m: guesses; then as found
  Eights place[lane_rings + 2];
  Eight lift2[lane_rings + 1];  ///< from place to place, m^2: see shortest_path.hpp
  Eights end;                   ///< the second node once more: its number among places differs
  Eight rings;                  ///< 0: a lane without an element
  // out
  LegOf<Eight> leg[lane_rings + 1], direct;  ///< from place to place; from node to node
  Eight length;                              ///< of all legs, m
  Eight straight;                            ///< 1: leads straight through, if through one ring only
  Eight hard;                                ///< 1: what is said of this lane is void
};

/// 1 / sqrt(x) where `needed`; as inverse_root where `near` holds.
inline Eight inverse_root(Eight x, Flags near, Flags needed) {
  const Flags next = near && next_to_one(x);
  const Eight root = root_next_to_one(x);
  return any(needed && ~next) ? pick(next, root, 1 / square_root(x)) : root;
}

struct PassageLanes {
  Eights offset;
  Flags straight, hard;
};

/// As shortest_passage, in the lanes in which `active` holds.
inline PassageLanes find_passages(const WayLanes& l, int k, Flags active) {
  constexpr int most_turns = 6;
  const OpeningOf<Eight>& o = l.opening[k];
  const Crossing<Eight> c = crossing<Eight>(o, {l.place[k], l.lift2[k]}, {l.place[k + 2], l.lift2[k + 1]});
  const FirstDirection<Eight> first = first_direction(o, l.offset[k], c.x);
  const Flags rim = active && c.over;
  Eights e = inverse_root(first.square, first.by_guess, rim) * first.along;
  Flags open = rim, lost = ~(c.sum > 0);
  for (int n = 0; n < most_turns && any(open); ++n) {
    const NewtonTurn<Eight> turn = newton_turn(at_rim(o, c.q, c.r, e), e);
    const Flags good = open && turn.good;
    e = pick(good, inverse_root(turn.square, good, good) * turn.to, e);
    lost = lost || (open && ~turn.good);
    open = good && ~turn.last;
  }
  const Flags found = ~rim || dot(e, c.x) > o.radius * c.sum;  // see rim_point
  return {pick(rim, o.radius * e, (1 / c.sum) * c.x), ~c.over && c.q.axial * c.r.axial <= 0,
          lost || open || ~found};
}

/// Rounds over the waypoints until each way has come to rest, as find_waypoints.
inline void find_waypoint_lanes(WayLanes& l, int most) {
  constexpr int most_rounds = 30;
  const Eight close = way_close * l.opening[0].radius;
  const Flags shared = l.rings > 1;
  Flags open = l.rings > 0, hard = ~open, straight = open;
  Eight last = 0;
  for (int n = 0; n < most_rounds && any(open); ++n) {
    Eight change2 = 0;
    for (int k = 0; k < most; ++k) {
      const Flags active = open && l.rings > k;
      const PassageLanes p = find_passages(l, k, active);
      const Eights d = p.offset - l.offset[k];
      const Eight moved = dot(d, d);
      change2 = pick(active && moved > change2, moved, change2);
      l.offset[k] = pick(active, p.offset, l.offset[k]);
      l.place[k + 1] = pick(active, l.opening[k].center + p.offset, l.place[k + 1]);
      hard = hard || (active && p.hard);
      straight = straight && (p.straight || ~active);
    }
    const Eight change = square_root(change2);
    open = open && shared && ~hard && ~at_rest(change, last, close);
    last = change;
  }
  l.hard = pick(hard || open, Eight(1), Eight(0));
  l.straight = pick(straight, Eight(1), Eight(0));
}

/// Legs and lengths of ways with up to `most` rings, as measure_way.
inline void measure_way_lanes(WayLanes& l, int most) {
  l.direct = leg(l.place[0], l.end, 0);
  l.length = 0;
  for (int k = 0; k <= most; ++k) {
    l.leg[k] = leg(l.place[k], l.place[k + 1], l.lift2[k]);
    l.length = pick(l.rings < k, l.length, l.length + l.leg[k].length);
  }
}

/// Finds the ways of all lanes.
inline void find_way_lanes(WayLanes& l) {
  int most = 0;
  for (int i = 0; i < way_lanes; ++i) most = l.rings[i] > most ? static_cast<int>(l.rings[i]) : most;
  find_waypoint_lanes(l, most);
  measure_way_lanes(l, most);
}

}  // namespace cinch::CINCH_ISA
