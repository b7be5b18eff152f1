// Rings that slide on threads without friction and without a search for contacts.
//
// A ring lies inside one element of its thread. The element's length l is that of the shortest way between
// its nodes through the openings of all its rings (shortest_path.hpp), its tension T = k (l - l0) + c dl/dt,
// never negative, is the same on both sides of a ring, and all forces are -T dl/dx: by the envelope theorem
// the waypoints p need not be differentiated. With unit vectors u along the way, from node a over p_1 .. p_m
// to node b,
//   T u_1 on a,   T (u_i+1 - u_i) on ring i at p_i,   -T u_m+1 on b.
// A ring moves rigidly: dp = dC - N (p - C).dN. Its force F goes half to each end of the host, and turns the
// host by G = -(F.N) (p - C), which the host's ends take as +G/L (b) and -G/L (a), as in ring_contact.cpp.
//
// A node passes a ring when the energy of the two elements beside it is lower with the ring on its other
// side. The stored energy is thus the least of those of neighbouring threadings: it is continuous, and no
// passing creates any. Its slope jumps, though, somewhere between two steps: at the share s of the step in
// which the energies cross, by a straight line through them. Central differences take the force at the step's
// end for half a step before it; with the old force for the share s - 1/2 of the new one the work is right to
// second order. That holds where the old force at the step's end is about what it was: not where the node
// went by so near to the waypoint that its leg has turned round within the step, as on a taut thread that
// leads straight through a ring. There the new force is taken alone: the old one would pull the ring with
// twice the tension, where none did.
//
// Elements are computed as straight ones with all the others. What is added here is the difference.
//
// Its forces may hold for several steps of the scheme, m dt = H in all: threads and rings move slowly beside
// what a stiff net allows. They are evaluated where nodes will be in the middle of those steps, (m - 1) dt /
// 2 ahead, if they keep their speed. For nodes that nothing else pulls at this is
//   x_1/2 = x + H/2 v,   v' = v + H f(x_1/2) / m,   x' = x_1/2 + H/2 v',
// central differences again, of step H, and as these do not lag behind no energy is won or lost to first
// order in H. (To kick nodes once with H f would shake them.)
#include "kernels/axial_law.hpp"
#include "kernels/contact_item.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/ring_body.hpp"
#include "kernels/ring_tally.hpp"
#include "kernels/way_queue.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::RingTally;

// Where forces go.
struct SlidingWriter {
  LoadWriter threads, hosts;
};

// ---- nodes that pass

inline double length_of(const Slide& s, const RingGroup& group) {
  if (group.first < group.last && !s.work[group.first].way.idle) return s.work[group.first].way.length;
  return norm(s.place(group.element + 1) - s.place(group.element));
}

// The joints of the elements beside that of a group.
inline RingGroup next_group(const Slide& s, const RingGroup& group) {
  const bool filled = group.last < s.thread.joint_end && s.state(group.last).element == group.element + 1;
  return {group.element + 1, group.last, filled ? s.behind(group.last) : group.last};
}
inline RingGroup last_group(const Slide& s, const RingGroup& group) {
  Index first = group.first;
  while (first > s.thread.joint_begin && s.state(first - 1).element == group.element - 1) --first;
  return {group.element - 1, first, group.first};
}

// No way through ring j and from end to end of the element is shorter than this.
inline double least_through(const Slide& s, Index element, Index j) {
  const V3 a = s.place(element), b = s.place(element + 1);
  const Opening& o = s.work[j].host.opening;
  const double way = distance(o, a) + distance(o, b), straight = norm(b - a);
  return way > straight ? way : straight;
}

// Ring j, at the end of `from`, goes to `to`.
struct Passing {
  RingGroup from, to;
  Index j;
  bool onward() const { return to.element > from.element; }
  RingGroup left() const {
    return {from.element, onward() ? from.first : from.first + 1, onward() ? j : from.last};
  }
  RingGroup entered() const { return {to.element, onward() ? j : to.first, onward() ? to.last : j + 1}; }
  Index first() const { return onward() ? from.first : to.first; }
  Index last() const { return onward() ? to.last : from.last; }
};

// Lets the ring pass. Returns false, and leaves it half done, if the element that it enters is no shorter
// than `limit`, or if the stretches of both, of whose squares the energy goes with the sum, are no less than
// `now`.
inline bool pass(const Slide& s, const Passing& p, double limit, double now) {
  s.state(p.j).element = p.to.element;
  const RingGroup left = p.left(), entered = p.entered();
  if (!find_way(s, entered, limit)) return false;
  if (left.first < left.last) find_way(s, left);
  const double out = s.stretch(length_of(s, left)), in = s.stretch(length_of(s, entered));
  return std::sqrt(out * out + in * in) < now;
}

// Takes the passing if it lowers the energy.
bool try_passing(const Slide& s, const Passing& p) {
  const double out = s.stretch(length_of(s, p.from)),
               least = s.stretch(s.work[p.from.first].way.direct.length);
  if (!(out > least)) return false;  // it would free nothing
  const double in = s.stretch(length_of(s, p.to)), now = out * out + in * in;
  const V3 far = s.place(p.onward() ? p.to.element + 1 : p.to.element) - s.work[p.j].host.opening.center;
  const double reach = s.thread.rest_length + out + in + s.work[p.j].host.opening.radius;
  // the way there is no shorter than |far| less the opening, nor may it be than the rest length, out and in:
  // a cheap forerunner of the test below, by which most go
  if (dot(far, far) >= reach * reach) return false;
  // the element that it leaves stays at least as long as a straight one
  const double limit = s.thread.rest_length + std::sqrt(now - least * least);
  if (least_through(s, p.to.element, p.j) >= limit) return false;
  for (Index i = p.first(); i < p.last(); ++i)
    s.work[i].kept = s.state(i), s.work[i].kept_way = s.work[i].way;
  if (pass(s, p, limit, std::sqrt(now))) {
    ++s.state(p.j).passes;
    return true;
  }
  for (Index i = p.first(); i < p.last(); ++i)
    s.state(i) = s.work[i].kept, s.work[i].way = s.work[i].kept_way;
  return false;
}

// The first passing that lowers the energy.
bool pass_one(const Slide& s) {
  for (Index first = s.thread.joint_begin; first < s.thread.joint_end;) {
    const RingGroup group = group_of(s, first);
    if (!s.work[first].way.idle && s.stretch(s.work[first].way.length) > 0) {
      if (group.element + 1 < s.thread.elements &&
          try_passing(s, {group, next_group(s, group), group.last - 1}))
        return true;
      if (group.element > 0 && try_passing(s, {group, last_group(s, group), group.first})) return true;
    }
    first = group.last;
  }
  return false;
}

// Passes nodes until no passing lowers the energy; returns whether one did. What a step leaves over is done
// by the next.
bool pass_nodes(const Slide& s) {
  const Index most = 4 * (s.thread.joint_end - s.thread.joint_begin) + 4;
  Index count = 0;
  while (count < most && pass_one(s)) ++count;
  return count > 0;
}

// ---- forces

// What an element with rings, or the same element as a straight one, pulls with: the law of axial_law.hpp
// for the length of its way.
struct Pull {
  double tension = 0, damper = 0, rate = 0;  // N, N, m/s
  double energy = 0, storing = 0;            // J; W, of the energy

  Pull(const Slide& s, double length, double length_rate, double give) : rate(length_rate) {
    const double stretch = s.stretch(length);
    if (!(stretch > 0)) return;
    const double full = s.thread.stiffness * stretch, change = rate * s.g.contact.step;
    const double drag = drag_at_switch(stretch, change, s.thread.damping * rate, give);
    const double spring = spring_at_switch(s.thread.stiffness, stretch, change, drag, give);
    tension = spring + drag > 0 ? spring + drag : 0.0;
    damper = tension - spring;
    energy = 0.5 * full * stretch;
    storing = full * rate;
  }
};

// How a group pulls, and how its element would without rings.
struct Pulls {
  Pull with, without;
};

// The first joint of a group, if its element had the same rings when joints were last evaluated in a step.
// Else, as where a node has passed, dampers are booked as if they had pulled as now.
inline const JointState* last_step(const Slide& s, const RingGroup& group) {
  const JointState& first = s.state(group.first);
  return first.damped == group.element && first.rings == group.last - group.first ? &first : nullptr;
}

// What some elements with rings have beyond straight ones.
struct Beyond {
  double energy = 0, storing = 0, taken = 0;  // J; W, of the energy; J, by dampers: see kernel::Book

  // Dampers take the mean of their forces, then and now, over what the length has changed.
  void add(const Slide& s, const RingGroup& group, const Pulls& pulls, double weight) {
    energy += weight * (pulls.with.energy - pulls.without.energy);
    storing += weight * (pulls.with.storing - pulls.without.storing);
    const JointState* const before = last_step(s, group);
    const Way& way = s.work[group.first].way;
    const bool measured = before && before->last_length >= 0;
    const double longer = measured ? way.length - before->last_length : s.g.since * pulls.with.rate;
    const double straight =
        measured ? way.direct.length - before->last_straight : s.g.since * pulls.without.rate;
    taken += weight * 0.5 *
             ((pulls.with.damper + (before ? before->damper : pulls.with.damper)) * longer -
              (pulls.without.damper + (before ? before->straight_damper : pulls.without.damper)) * straight);
  }
};

// The unit vector with which the way leaves the waypoint of joint j in `group`.
inline V3 onward_direction(const Slide& s, const RingGroup& group, Index j) {
  return j + 1 == group.last ? s.work[group.first].way.last.unit : s.work[j + 1].way.before_it.unit;
}

// dp/dt of a point of the opening that moves with the ring.
inline V3 waypoint_velocity(const Host& host, V3 offset) {
  return host.velocity - dot(offset, host.turn) * host.opening.normal;
}

inline double length_rate(const Slide& s, const RingGroup& group) {
  V3 in = s.work[group.first].way.before_it.unit;
  double rate = -dot(in, s.speed(group.element));
  for (Index j = group.first; j < group.last; ++j) {
    const V3 out = onward_direction(s, group, j);
    rate += dot(in - out, waypoint_velocity(s.work[j].host, vec(s.state(j).offset)));
    in = out;
  }
  return rate + dot(in, s.speed(group.element + 1));
}

// The force of joint j on its ring and on the ring's host.
inline void load_ring(const Slide& s, Index j, V3 force, SlidingWriter& out) {
  const kernel::Joint& joint = s.g.joints[j];
  const Host& host = s.work[j].host;
  const V3 couple = -dot(force, host.opening.normal) * vec(s.state(j).offset);
  s.work[j].force = s.work[j].force + force;
  if (joint.host_a == joint.host_b) {
    out.hosts.add(joint.host_a, force);
    if (RingTally* const tally = s.g.tallies[joint.ring]) {  // the support takes the couple
      const V3 torque = s.g.contact.dt * cross(host.opening.normal, couple);
      tally->couple_impulse[0] += torque.x, tally->couple_impulse[1] += torque.y;
      tally->couple_impulse[2] += torque.z;
    }
    return;
  }
  const V3 turn = host.inverse_length * couple;
  out.hosts.add(joint.host_a, 0.5 * force - turn);
  out.hosts.add(joint.host_b, 0.5 * force + turn);
}

inline Pulls pulls_of(const Slide& s, const RingGroup& group) {
  Way& way = s.work[group.first].way;
  const double rate = dot(way.direct.unit, s.speed(group.element + 1) - s.speed(group.element));
  const double give = s.give(group.element);  // of both: a way may be straight. Rings give way, too, but less
  const Pulls pulls{Pull(s, way.length, length_rate(s, group), give), Pull(s, way.direct.length, rate, give)};
  way.damper = pulls.with.damper, way.direct_damper = pulls.without.damper;
  return pulls;
}

// Keeps the dampers' forces for the next step. Of an idle group those are known that are slack.
void keep_dampers(const Slide& s, const RingGroup& group) {
  JointState& first = s.state(group.first);
  const Way& way = s.work[group.first].way;
  first.damped = group.element;
  first.rings = way.idle && way.straight ? 0 : group.last - group.first;
  first.damper = way.idle ? 0.0 : way.damper;
  first.straight_damper = way.idle || way.straight ? first.damper : way.direct_damper;
  first.last_length = way.idle ? -1.0 : way.length;
  first.last_straight = way.idle ? -1.0 : way.direct.length;
  for (Index j = group.first + 1; j < group.last; ++j) s.state(j).rings = 0;
}

// What a look wants to know of the rings of a group. Thread is stretched evenly between its nodes.
void note_group(const Slide& s, const RingGroup& group, const Pulls& pulls) {
  const double length = s.work[group.first].way.length, share = length > 0 ? 1 / length : 0.0;
  double way = 0;
  for (Index j = group.first; j < group.last; ++j) {
    way += share * s.work[j].way.before_it.length;
    s.state(j).along = s.thread.rest_length * (group.element + (way < 1 ? way : 1.0));
    s.state(j).length = length;
    s.state(j).tension = pulls.with.tension;
    const double spare = short_host(s.g.contact, s.g.joints[j]).spare, pressed = spare < 0 ? spare : 0.0;
    s.state(j).energy = 0.5 * s.g.joints[j].host_stiffness * pressed * pressed;
    if (j == group.first) s.state(j).energy += pulls.with.energy - pulls.without.energy;
  }
}

// Adds `weight` times the forces of a group, as its joints stand.
void load_group(const Slide& s, const RingGroup& group, double weight, Beyond& beyond, SlidingWriter& out) {
  if (s.work[group.first].way.idle) return;
  const Pulls pulls = pulls_of(s, group);
  const double tension = pulls.with.tension;
  beyond.add(s, group, pulls, weight);
  if (!(s.g.contact.dt > 0)) note_group(s, group, pulls);
  if (!(tension > 0 || pulls.without.tension > 0)) return;
  const V3 straight = pulls.without.tension * s.work[group.first].way.direct.unit;
  V3 in = s.work[group.first].way.before_it.unit;
  out.threads.add(s.node(group.element), weight * (tension * in - straight));
  for (Index j = group.first; j < group.last; ++j) {
    const V3 next = onward_direction(s, group, j);
    load_ring(s, j, (weight * tension) * (next - in), out);
    in = next;
  }
  out.threads.add(s.node(group.element + 1), weight * (straight - tension * in));
}

void load_thread(const Slide& s, double weight, Beyond& beyond, SlidingWriter& out) {
  for (Index j = s.thread.joint_begin; j < s.thread.joint_end; j = s.behind(j))
    load_group(s, group_of(s, j), weight, beyond, out);
}

Beyond beyond_straight(const Slide& s) {
  Beyond sum;
  for (Index j = s.thread.joint_begin; j < s.thread.joint_end; j = s.behind(j)) {
    if (s.work[j].way.idle) continue;
    const RingGroup group = group_of(s, j);
    const Pulls pulls = pulls_of(s, group);
    sum.add(s, group, pulls, 1);
  }
  return sum;
}

// Exchanges the threading of this step with that before nodes passed.
inline void swap_threadings(const Slide& s) {
  for (Index j = s.thread.joint_begin; j < s.thread.joint_end; ++j) {
    const JointState now = s.state(j);
    s.state(j) = s.work[j].old;
    s.work[j].old = now;
  }
  for (Index j = s.thread.joint_begin; j < s.thread.joint_end; j = s.behind(j)) find_way(s, group_of(s, j));
}

// Whether a node that ring j has let pass was nearer to the waypoint than it moves in a step. Joints stand as
// before that.
bool turned_round(const Slide& s, Index j) {
  const Index here = s.state(j).element, there = s.work[j].old.element;
  if (here == there) return false;
  const Index k = there > here ? here + 1 : here;
  const V3 apart = s.place(k) - s.waypoint(j);
  const V3 speed = s.speed(k) - waypoint_velocity(s.work[j].host, vec(s.state(j).offset));
  const double step = s.g.contact.step;
  return dot(apart, apart) < step * step * dot(speed, speed);
}

bool any_turned_round(const Slide& s) {
  for (Index j = s.thread.joint_begin; j < s.thread.joint_end; ++j)
    if (turned_round(s, j)) return true;
  return false;
}

// Nodes have passed since the last step: mixes the forces of both threadings as the head of this file says.
void load_passing_thread(const Slide& s, Beyond& beyond, SlidingWriter& out) {
  const Beyond now = beyond_straight(s);
  swap_threadings(s);
  const Beyond then = beyond_straight(s);
  const double gap = now.energy - then.energy, change = s.g.contact.step * (now.storing - then.storing);
  double share = change < 0 ? 1 - gap / change : 0.5;  // of the step, where the gap was zero
  share = share > 0 ? share < 1 ? share : 1.0 : 0.0;
  const double old = any_turned_round(s) ? 0.0 : share - 0.5;
  if (old != 0) load_thread(s, old, beyond, out);
  swap_threadings(s);
  load_thread(s, 1 - old, beyond, out);
}

// ---- a step

// Passings and forces of one thread. Without a step (dt = 0) no node passes.
void slide_thread(const SlidingArguments& g, const SlidingThread& thread, Work* work, SlidingWriter& out) {
  const Slide s{g, thread, work};
  for (Index j = thread.joint_begin; j < thread.joint_end; ++j) s.work[j].old = s.state(j);
  Beyond beyond;
  if (g.contact.dt > 0 && pass_nodes(s)) load_passing_thread(s, beyond, out);
  else load_thread(s, 1, beyond, out);
  if (g.contact.dt > 0) s.state(thread.joint_begin).dissipated += beyond.taken;
  else s.state(thread.joint_begin).due = beyond.taken;
  for (Index j = thread.joint_begin; g.contact.dt > 0 && j < thread.joint_end; j = s.behind(j))
    keep_dampers(s, group_of(s, j));
}

void note_forces(const SlidingArguments& g, const Work* work) {
  const auto for_each_tally = [&](auto&& visit) {
    for (Index t = 0; t < g.thread_count; ++t)
      for (Index j = g.threads[t].joint_begin; j < g.threads[t].joint_end; ++j)
        if (RingTally* const tally = g.tallies[g.joints[j].ring]) visit(*tally, work[j].force);
  };
  for_each_tally([](RingTally& tally, V3) { tally.force[0] = tally.force[1] = tally.force[2] = 0; });
  for_each_tally(
      [](RingTally& tally, V3 f) { tally.force[0] += f.x, tally.force[1] += f.y, tally.force[2] += f.z; });
  for_each_tally([&](RingTally& tally, V3) { note_force(tally, norm(vec(tally.force)), g.contact.time); });
}

void set_hosts(const SlidingArguments& g, Work* work) {
  for (Index t = 0; t < g.thread_count; ++t)
    for (Index j = g.threads[t].joint_begin; j < g.threads[t].joint_end; ++j) {
      work[j].host = host_of(g, g.joints[j]);
      work[j].force = {0, 0, 0};
    }
}

void sliding_joints(const SlidingArguments& g, kernel::Load* on_threads, kernel::Load* on_hosts) {
  WayLanes* const lanes = reinterpret_cast<WayLanes*>(g.scratch);
  Work* const work = reinterpret_cast<Work*>(g.scratch + kernel::sliding_scratch);
  set_hosts(g, work);
  find_ways(g, work, lanes);
  SlidingWriter out{{on_threads}, {on_hosts}};
  for (Index t = 0; t < g.thread_count; ++t) {
    slide_thread(g, g.threads[t], work, out);
    g.ends[t] = {static_cast<Index>(out.threads.next - on_threads),
                 static_cast<Index>(out.hosts.next - on_hosts)};
  }
  note_forces(g, work);
}

}  // namespace

void fill_sliding_joint(KernelTable& table) { table.sliding_joints = sliding_joints; }

}  // namespace cinch::CINCH_ISA
