// The way of a thread through the rings of one of its elements, found ring by ring.
#pragma once
#include "kernels/contact_item.hpp"
#include "kernels/shortest_path.hpp"

namespace cinch::CINCH_ISA {

using kernel::JointState;
using kernel::SlidingArguments;
using kernel::SlidingThread;

// Where a ring is and how it moves.
struct Host {
  Opening opening;
  V3 velocity, turn;      // m/s; dN/dt before projection, 1/s: zero for a ring with a node of its own
  double inverse_length;  // of the host, 1/m; zero for a ring with a node of its own
};

// The way through the rings of one element.
struct Way {
  Leg before_it;  // from the last waypoint (or node) to the joint's
  // of the first joint in an element:
  Leg last, direct;              // from the last waypoint to the node; from node to node
  double length;                 // of the whole way, m
  double damper, direct_damper;  // forces of the dampers along both, N
  bool straight;                 // leads straight from node to node
  bool idle;                     // its rings change nothing of its pull
};

// What a call works on, for each joint.
struct Work {
  Host host;
  Way way;
  V3 force;         // on the ring, N
  JointState old;   // as it stood before nodes passed
  JointState kept;  // as it stood before a passing was tried
  Way kept_way;
};
static_assert(sizeof(Work) <= kernel::joint_scratch * sizeof(double));

inline V3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

inline void put(V3 v, double (&to)[3]) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

constexpr double no_limit = HUGE_VAL;  // none

inline V3 place_ahead(const SlidingArguments& g, Index node) {
  const kernel::ContactArguments& c = g.contact;
  return at(c.x, c.y, c.z, node) + g.ahead * at(c.vx, c.vy, c.vz, node);
}

// One thread in one step.
struct Slide {
  const SlidingArguments& g;
  const SlidingThread& thread;
  Work* work;  // joint

  JointState& state(Index j) const { return g.states[j]; }
  Index node(Index k) const { return g.nodes[thread.node_begin + k]; }
  // g of axial_law.hpp for element k, straight and for a step between two evaluations.
  double give(Index k) const {
    const double* const ends = g.mobility + thread.node_begin + k;
    return g.contact.step * g.contact.step * (ends[0] + ends[1]);
  }
  V3 place(Index k) const { return place_ahead(g, node(k)); }
  V3 speed(Index k) const { return at(g.contact.vx, g.contact.vy, g.contact.vz, node(k)); }
  V3 waypoint(Index j) const { return work[j].host.opening.center + vec(state(j).offset); }
  // How much longer than its thread an element is, for a length of its way.
  double stretch(double length) const {
    return length > thread.rest_length ? length - thread.rest_length : 0.0;
  }
  // The first joint behind those that lie in the element of joint j.
  Index behind(Index j) const {
    const Index element = state(j).element;
    while (j < thread.joint_end && state(j).element == element) ++j;
    return j;
  }
  // Squared lift between two rings of one element.
  double lift2(Index j) const {
    const double lift = (work[j].host.opening.radius + work[j + 1].host.opening.radius) / 32;
    return lift * lift;
  }
};

inline Host host_of(const SlidingArguments& g, const kernel::Joint& joint) {
  const kernel::ContactArguments& c = g.contact;
  const V3 xa = place_ahead(g, joint.host_a), va = at(c.vx, c.vy, c.vz, joint.host_a);
  if (joint.host_a == joint.host_b) return {{xa, vec(joint.normal), joint.opening}, va, {0, 0, 0}, 0};
  const V3 xb = place_ahead(g, joint.host_b), vb = at(c.vx, c.vy, c.vz, joint.host_b);
  const V3 along = xb - xa;
  const double length = norm(along), inverse = length > 0 ? 1 / length : 0.0;
  return {{0.5 * (xa + xb), inverse * along, joint.opening}, 0.5 * (va + vb), inverse * (vb - va), inverse};
}

// ---- the way through the rings of one element

// Joints [first, last) in an element.
struct RingGroup {
  Index element, first, last;
};

inline RingGroup group_of(const Slide& s, Index first) {
  return {s.state(first).element, first, s.behind(first)};
}

// One round over the waypoints of several joints; returns the greatest squared change of one.
inline double round_of_waypoints(const Slide& s, const RingGroup& group, V3 a, V3 b) {
  double change = 0;
  for (Index j = group.first; j < group.last; ++j) {
    const Neighbour from = j == group.first ? Neighbour{a, 0} : Neighbour{s.waypoint(j - 1), s.lift2(j - 1)};
    const Neighbour to = j + 1 == group.last ? Neighbour{b, 0} : Neighbour{s.waypoint(j + 1), s.lift2(j)};
    const V3 old = vec(s.state(j).offset),
             now = shortest_passage(s.work[j].host.opening, from, to, old).offset;
    const V3 d = now - old;
    put(now, s.state(j).offset);
    change = dot(d, d) > change ? dot(d, d) : change;
  }
  return change;
}

// No way of a group is shorter than this. The length is convex in all waypoints: it lies above its tangent at
// those that there are, which is least where each waypoint goes to the rim against its slope.
inline double least_length(const Slide& s, const RingGroup& group, V3 a, V3 b) {
  V3 from = a, in{0, 0, 0};
  double least = 0;
  for (Index j = group.first; j <= group.last; ++j) {
    const bool ends = j == group.last;
    const V3 to = ends ? b : s.waypoint(j);
    const Leg out = leg(from, to, ends || j == group.first ? 0.0 : s.lift2(j - 1));
    least += out.length;
    if (j > group.first) {
      const Opening& o = s.work[j - 1].host.opening;
      const V3 slope = in - out.unit, flat = slope - dot(slope, o.normal) * o.normal;
      least -= dot(slope, vec(s.state(j - 1).offset)) + o.radius * norm(flat);
    }
    from = to, in = out.unit;
  }
  return least;
}

// Returns whether it came to an end: not if the way turned out to be no shorter than `limit`.
inline bool find_waypoints(const Slide& s, const RingGroup& group, V3 a, V3 b, double limit) {
  constexpr int most_rounds = 1000;  // a dozen do, but where rings lie at one place at first
  const double close = way_close * s.work[group.first].host.opening.radius;
  double last = 0;
  for (int i = 0; i < most_rounds; ++i) {
    if (i > 0 && limit < no_limit && least_length(s, group, a, b) >= limit) return false;
    const double change = std::sqrt(round_of_waypoints(s, group, a, b));
    if (at_rest(change, last, close)) break;
    last = change;
  }
  return true;
}

// The length of the way through the rings' centres: never shorter than the shortest one.
inline double length_by_centers(const Slide& s, const RingGroup& group) {
  V3 from = s.place(group.element);
  double length = 0;
  for (Index j = group.first; j < group.last; ++j) {
    const V3 to = s.work[j].host.opening.center, d = to - from;
    length += std::sqrt(dot(d, d) + (j == group.first ? 0.0 : s.lift2(j - 1)));
    from = to;
  }
  return length + norm(s.place(group.element + 1) - from);
}

// What is known of a way once its legs are. Where a node lies in its waypoint the leg between them has no
// direction: the ring does not feel it, and the node is drawn along the next one.
inline void set_way(const Slide& s, const RingGroup& group, const Leg& direct, const Leg& last,
                    double length) {
  Way& first = s.work[group.first].way;
  first.direct = direct;
  first.last = last;
  first.length = first.straight ? direct.length : length;
  const bool one = group.last == group.first + 1;
  if (first.straight) first.before_it.unit = first.last.unit = direct.unit;
  else if (!has_direction(first.before_it))
    first.before_it.unit = one ? first.last.unit : s.work[group.first + 1].way.before_it.unit;
  else if (!has_direction(last)) first.last.unit = s.work[group.last - 1].way.before_it.unit;
}

// Finds legs and length of a group from its waypoints.
inline void measure_way(const Slide& s, const RingGroup& group, V3 a, V3 b) {
  V3 from = a;
  double length = 0;
  for (Index j = group.first; j < group.last; ++j) {
    const V3 to = s.waypoint(j);
    s.work[j].way.before_it = leg(from, to, j == group.first ? 0.0 : s.lift2(j - 1));
    length += s.work[j].way.before_it.length;
    from = to;
  }
  const Leg last = leg(from, b, 0);
  set_way(s, group, leg(a, b, 0), last, length + last.length);
}

// Whether the dampers of the last step took other than those of a straight element: then power is still due.
inline bool owes_power(const Slide& s, const RingGroup& group) {
  const JointState& first = s.state(group.first);
  return first.rings > 0 && first.damper != first.straight_damper;
}

// In a step, nobody asks for the way of a group that is straight or, by the rings' centres, slack: it pulls
// as without rings, and to lose one would free no energy.
inline bool may_idle(const Slide& s, const RingGroup& group) {
  return s.g.contact.dt > 0 && !owes_power(s, group);
}

// Whether a group is idle by the rings' centres.
inline bool rest_way(const Slide& s, const RingGroup& group) {
  Way& first = s.work[group.first].way;
  first.straight = false;
  first.idle = may_idle(s, group) && length_by_centers(s, group) <= s.thread.rest_length;
  return first.idle;
}

// Finds the way of a group that does not rest. Returns false, and leaves it half done, if it is no shorter
// than `limit`.
inline bool find_taut_way(const Slide& s, const RingGroup& group, double limit = no_limit) {
  const V3 a = s.place(group.element), b = s.place(group.element + 1);
  if (limit < no_limit && least_length(s, group, a, b) >= limit) return false;
  Way& first = s.work[group.first].way;
  if (group.last == group.first + 1) {
    const Passage passage =
        shortest_passage(s.work[group.first].host.opening, {a, 0}, {b, 0}, vec(s.state(group.first).offset));
    put(passage.offset, s.state(group.first).offset);
    first.straight = passage.straight;
  } else if (!find_waypoints(s, group, a, b, limit)) {
    return false;
  }
  first.idle = first.straight && may_idle(s, group);
  if (!first.idle) measure_way(s, group, a, b);
  return true;
}

inline bool find_way(const Slide& s, const RingGroup& group, double limit = no_limit) {
  return rest_way(s, group) || find_taut_way(s, group, limit);
}

}  // namespace cinch::CINCH_ISA
