// Contact of threads with rings (paper Sec. 4.2). With P on the element, Q on the ring's centre line C + R e
// (e: unit radial vector), d = |PQ|, n = (P - Q)/d, penetration delta = r_A + r_B - d and N the ring's
// normal:
//   d(delta)/dt = -( n.(v_P - v_C) + R (n.N) e.dN/dt )       as dd/dN = R (n.N) e for unit N
//   F n on the element, shared to its ends by eq. (10); -F n on the ring's centre, half to each host end, eq.
//   (12)
// Eq. (12) stops there. The contact potential U(delta(P, C, N)) also turns the host: with G = -dU/dN = F R
// (n.N) e and N = (x_b - x_a)/L the host's ends take +G/L (b) and -G/L (a). That couple keeps angular
// momentum and energy; without it ("paper") its power G.dN/dt and torque N x G are booked; so is the torque
// on a ring that cannot turn. How contacts at shared nodes count is in contact_item.hpp.
//
// Pairs go through ring_lanes.hpp in batches. One whose nodes touch, or whose closest points need a branch of
// their own, goes through one_pair, which is also the plain reference of the batches.
#include "kernels/kernel_table.hpp"
#include "kernels/ring_lanes.hpp"
#include "kernels/ring_tally.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::Pair;
using kernel::RingArguments;
using kernel::RingGeometry;
using kernel::RingTally;

// What the contacts of one ring add up to in one step.
struct RingSum {
  V3 on_ring{0, 0, 0};  // force, N
  double potential = 0, power = 0;
  double couple_power = 0;              // of the couple that is not kept
  V3 torque{0, 0, 0};                   // of it, or of the one that a support takes, N m
  double penetration = 0;               // greatest, m
  double host_use = 0, thread_use = 0;  // shares of the stable step: summed on the host, greatest on a thread
  Index stiffest = -1;                  // element with that greatest share

  void note_use(const Pair& c, double depth, double on_host, double on_thread) {
    penetration = depth > penetration ? depth : penetration;
    host_use += on_host;
    stiffest = on_thread >= thread_use ? c.element : stiffest;
    thread_use = on_thread >= thread_use ? on_thread : thread_use;
  }
};

// ---- one pair at a time: the plain reference

// Where a ring is and how it moves.
struct RingMotion {
  V3 center, normal, velocity;
  V3 turn;                // dN/dt before projection: (v_b - v_a) / L; zero for a ring with a node of its own
  double inverse_length;  // 1 / L; zero for a ring with a node of its own
  bool held;              // has a node of its own and does not turn

  double half() const { return held ? 1.0 : 0.5; }
  double turn_length(const RingArguments& g) const { return held || !g.couple ? 0.0 : inverse_length; }
  // as RingLanes::turning
  double turning() const { return inverse_length > 0 || held ? inverse_length : HUGE_VAL; }
};

inline RingMotion ring_motion(const kernel::ContactArguments& c, const RingGeometry& ring) {
  const V3 xa = at(c.x, c.y, c.z, ring.a), va = at(c.vx, c.vy, c.vz, ring.a);
  if (ring.a == ring.b) return {xa, {ring.normal[0], ring.normal[1], ring.normal[2]}, va, {0, 0, 0}, 0, true};
  const V3 xb = at(c.x, c.y, c.z, ring.b), vb = at(c.vx, c.vy, c.vz, ring.b);
  const V3 along = xb - xa;
  const double length = norm(along);
  // a host folded to a point keeps a zero normal: no contact
  const double inverse = length > 0 ? 1 / length : 0.0;
  return {0.5 * (xa + xb), inverse * along, 0.5 * (va + vb), inverse * (vb - va), inverse, false};
}

// Forces that one pair puts on nodes, N.
struct PairLoads {
  V3 a{0, 0, 0}, b{0, 0, 0}, host_a{0, 0, 0}, host_b{0, 0, 0};
};

// Adds the contact of a point as far as it counts; returns the law's result for the watch.
inline ContactForce add_contact(const RingArguments& g, const RingMotion& ring, double radius, const Pair& c,
                                const CirclePoint& point, ContactWeight weight, PairLoads& loads,
                                RingSum& sum) {
  const auto& k = g.contact;
  const V3 gap = point.p - point.q;
  // on the wire's centre line itself the thread is pushed towards the ring's axis
  const V3 n = point.distance > 0 ? (1 / point.distance) * gap : -1.0 * point.radial;
  const double t = point.t;
  const V3 velocity = blend(at(k.vx, k.vy, k.vz, c.a), at(k.vx, k.vy, k.vz, c.b), t);
  const double lever = radius * dot(n, ring.normal);
  const double turning = lever * dot(point.radial, ring.turn);
  const double rate = -(dot(n, velocity - ring.velocity) + turning);
  const ContactForce law = contact_law(c.contact_distance - point.distance, rate, c.stiffness, k.alpha);
  const double damper = weight.damper * (law.force - law.elastic);
  const double counted = weight.spring * law.elastic + damper;
  const V3 force = counted * n;
  const V3 couple = (counted * lever) * point.radial;
  const V3 across = couple - dot(couple, ring.normal) * ring.normal, turn = ring.turn_length(g) * across;
  loads.a = loads.a + (1 - t) * force;
  loads.b = loads.b + t * force;
  loads.host_a = loads.host_a - ring.half() * force - turn;
  loads.host_b = loads.host_b - ring.half() * force + turn;
  sum.on_ring = sum.on_ring - force;
  sum.potential += weight.spring * law.potential;
  sum.power += damper_power(damper, weight.damper * law.thickening, rate, k.step);
  if (ring.held || !g.couple) {
    sum.couple_power += counted * turning;
    sum.torque = sum.torque + cross(ring.normal, across);
  }
  return law;
}

// Closest points of a pair: of the element, and of its ends where shared nodes are counted once.
struct PairPoints {
  CirclePoint element, end_a, end_b;
};

inline PairPoints pair_points(const RingArguments& g, const RingMotion& ring, double radius, const Pair& c) {
  const auto& k = g.contact;
  const V3 xa = at(k.x, k.y, k.z, c.a), xb = at(k.x, k.y, k.z, c.b);
  PairPoints p{g.golden ? segment_circle_golden(xa, xb, ring.center, ring.normal, radius)
                        : segment_circle_exact(xa, xb, ring.center, ring.normal, radius),
               point_circle(xa, ring.center, ring.normal, radius),
               point_circle(xb, ring.center, ring.normal, radius)};
  p.end_b.t = 1;
  if (c.fraction_a == 0) return p;
  if (p.end_a.distance < p.element.distance) p.element = p.end_a;  // golden section can miss an end
  if (p.end_b.distance < p.element.distance) p.element = p.end_b;
  return p;
}

// What one pair is away from a contact, m, and the motion up to which it needs no look.
struct PairGap {
  double gap, sleep;
};

// One pair. Rarely needed beside the batches: kept out of their way.
[[gnu::noinline, gnu::cold]] PairGap one_pair(const RingArguments& g, const Pair& c,
                                              const kernel::RingLane& lane, PairLoads& loads, RingSum& sum) {
  const RingMotion ring = ring_motion(g.contact, g.rings[c.with]);
  const double radius = g.rings[c.with].radius;
  const PairPoints p = pair_points(g, ring, radius, c);
  const CirclePoint& point = p.element;
  const double depth = c.contact_distance - point.distance;
  if (!(depth > 0)) return {-depth, ring_sleep(-depth, radius, ring.turning())};
  const bool once = c.fraction_a > 0;
  const double depth_a = once ? c.contact_distance - p.end_a.distance : 0;
  const double depth_b = once ? c.contact_distance - p.end_b.distance : 0;
  const ContactWeights weights = contact_weights(c, depth, depth_a, depth_b);
  const ContactForce law = add_contact(g, ring, radius, c, point, weights.element, loads, sum);
  if (depth_a > 0) add_contact(g, ring, radius, c, p.end_a, weights.a, loads, sum);
  if (depth_b > 0) add_contact(g, ring, radius, c, p.end_b, weights.b, loads, sum);
  const double kappa = step_weight(g.contact, law);
  const bool both = depth_a > 0 && depth_b > 0;
  const double lever =
      radius * dot(point.p - point.q, ring.normal) / (point.distance > 0 ? point.distance : 1.0);
  const double times = both ? std::fmax(1.0, c.fraction_a + c.fraction_b) : 1.0;
  sum.note_use(
      c, depth, times * host_use(kappa, ring.half(), ring.turn_length(g), lever, lane.host_share),
      both ? thread_share_of_both(c, kappa, point.t, depth, depth_a, depth_b, lane.share_a, lane.share_b)
           : thread_share(kappa, point.t, lane.share_a, lane.share_b));
  return {-depth, 0};
}

inline void write_loads(const kernel::RingLane& p, const PairLoads& loads, LoadWriter& out) {
  out.add(p.a, loads.a);
  out.add(p.b, loads.b);
  out.add(p.host_a, loads.host_a);
  if (!(p.held > 0)) out.add(p.host_b, loads.host_b);
}

// ---- what one ring feels

// What this step adds to the ring's tally.
inline void book(const RingArguments& g, Index r, const RingSum& sum, RingTally& tally) {
  const auto& k = g.contact;
  tally.force[0] = sum.on_ring.x;
  tally.force[1] = sum.on_ring.y;
  tally.force[2] = sum.on_ring.z;
  tally.potential = sum.potential;
  tally.dissipated += k.dt * sum.power;
  if (!g.couple || g.rings[r].a == g.rings[r].b) {
    tally.couple_work += k.dt * sum.couple_power;
    tally.couple_impulse[0] += k.dt * sum.torque.x;
    tally.couple_impulse[1] += k.dt * sum.torque.y;
    tally.couple_impulse[2] += k.dt * sum.torque.z;
  }
  note_force(tally, norm(sum.on_ring), k.time);
  if (sum.penetration > tally.max_penetration) tally.max_penetration = sum.penetration;
  const double share = sum.host_use + sum.thread_use;
  if (share > tally.stiffest) {
    tally.stiffest = share;
    tally.stiffest_time = k.time;
    tally.stiffest_element = sum.stiffest;
  }
}

// A ring that nothing is near to.
inline void release(RingTally& tally) {
  tally.force[0] = tally.force[1] = tally.force[2] = 0;
  tally.potential = 0;
  if (tally.state == 1) tally.state = 2;
}

// ---- batches

// Adds a lane in contact.
inline void take_lane(const RingArguments& g, const RingLanes& l, Index lane, const Pair& c, RingSum& sum) {
  sum.on_ring = sum.on_ring + get(l.on_ring, lane);
  sum.potential += l.potential.at[lane];
  sum.power += l.power.at[lane];
  if (!g.couple || l.held.at[lane] > 0) {
    sum.couple_power += l.couple_power.at[lane];
    sum.torque = sum.torque + get(l.torque, lane);
  }
  sum.note_use(c, -l.gap.at[lane], l.host_use.at[lane], l.thread_use.at[lane]);
}

// A pair that may touch, which stands in `lane`; returns the motion up to which it needs no look.
inline double take_pair(const RingArguments& g, const RingLanes& l, Index lane, const Pair& c,
                        const kernel::RingLane& p, RingSum& sum, LoadWriter& out) {
  if (l.circle.hard.at[lane] > 0) {
    PairLoads loads;
    const PairGap found = one_pair(g, c, p, loads, sum);
    if (found.gap < 0) write_loads(p, loads, out);
    return found.sleep;
  }
  if (!(l.gap.at[lane] < 0)) return l.sleep.at[lane];
  take_lane(g, l, lane, c, sum);
  write_loads(p, {get(l.on_a, lane), get(l.on_b, lane), get(l.on_host_a, lane), get(l.on_host_b, lane)}, out);
  return 0;
}

// Books what ring r has felt, and rings [released, r) that nothing touches.
inline void close_ring(const RingArguments& g, Index r, RingSum& sum, Index& released) {
  for (; released < r; ++released)
    if (RingTally* const tally = g.tallies[released];
        tally != nullptr && (tally->state == 1 || tally->potential != 0))
      release(*tally);
  if (r == g.ring_count) return;
  if (RingTally* const tally = g.tallies[r]) book(g, r, sum, *tally);
  sum = RingSum{};
  released = r + 1;
}

// The pairs of a batch that may touch, ring by ring.
inline void take_batch(const RingArguments& g, const RingLanes& lanes, const Pair* pairs, const Index* near,
                       Index count, double* sleep, Index& ring, RingSum& sum, Index& released,
                       LoadWriter& out) {
  for (Index i = 0; i < count; ++i) {
    sleep[i] = lanes.sleep.at[i];
    if (!(lanes.looked_at.at[i] > 0)) continue;
    const Pair& c = pairs[near[i]];
    if (c.with != ring) {
      if (ring >= 0) close_ring(g, ring, sum, released);
      ring = c.with;
    }
    sleep[i] = take_pair(g, lanes, i, c, g.lanes[near[i]], sum, out);
  }
}

Index ring_contacts(const RingArguments& g, const Pair* pairs, const Index* near, Index count, double* sleep,
                    kernel::Load* loads) {
  LoadWriter out{loads};
  RingLanes& lanes = *reinterpret_cast<RingLanes*>(g.scratch);
  RingSum sum;
  Index ring = -1, released = 0;
  for (Index i = 0; i < count; i += lane_capacity) {
    const Index batch = count - i < lane_capacity ? count - i : lane_capacity;
    fill_lanes(g, pairs, near + i, batch, lanes);
    take_batch(g, lanes, pairs, near + i, batch, sleep + i, ring, sum, released, out);
  }
  if (ring >= 0) close_ring(g, ring, sum, released);
  close_ring(g, g.ring_count, sum, released);
  return static_cast<Index>(out.next - loads);
}

}  // namespace

void fill_ring_contact(KernelTable& table) { table.ring_contacts = ring_contacts; }

}  // namespace cinch::CINCH_ISA
