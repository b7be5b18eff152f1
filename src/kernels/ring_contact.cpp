// Contact of threads with rings (paper Sec. 4.2). With P on the element, Q on the ring's centre line C + R e
// (e: unit radial vector), d = |PQ|, n = (P - Q)/d, penetration delta = r_A + r_B - d and N the ring's
// normal:
//   d(delta)/dt = -( n.(v_P - v_C) + R (n.N) e.dN/dt )       as dd/dN = R (n.N) e for unit N
//   F n on the element, shared to its ends by eq. (10); -F n on the ring's centre, half to each host end, eq.
//   (12)
// Eq. (12) stops there. The contact potential U(delta(P, C, N)) also turns the host: with G = -dU/dN = F R
// (n.N) e and N = (x_b - x_a)/L the host's ends take +G/L (b) and -G/L (a). That couple keeps angular
// momentum and energy; without it ("paper") its power G.dN/dt and torque N x G are booked; so is the torque
// on a ring that cannot turn. Neighbouring elements report the same contact at their shared node: it is
// counted once by inclusion and exclusion, sum over elements minus (degree - 1) times the contact of each
// shared node, which is continuous in all positions.
//
// Pairs go through ring_lanes.hpp in batches. One whose nodes touch, or whose closest points need a branch of
// their own, goes through one_pair, which is also the plain reference of the batches.
#include "kernels/kernel_table.hpp"
#include "kernels/ring_lanes.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::Pair;
using kernel::RingArguments;
using kernel::RingGeometry;
using kernel::RingTally;

// Adds `weight` times the contact of the point at t; returns the law's result for the watch.
inline ContactForce add_contact(const RingArguments& g, const RingMotion& ring, const Pair& c,
                                const CirclePoint& point, double t, double weight, EndLoads& loads,
                                RingSum& sum) {
  const auto& k = g.contact;
  const V3 gap = point.p - point.q;
  // on the wire's centre line itself the thread is pushed towards the ring's axis
  const V3 n = point.distance > 0 ? (1 / point.distance) * gap : -1.0 * point.radial;
  const V3 velocity = blend(at(k.vx, k.vy, k.vz, c.a), at(k.vx, k.vy, k.vz, c.b), t);
  const double lever = ring.radius * dot(n, ring.normal);
  const double turning = lever * dot(point.radial, ring.turn);
  const double rate = -(dot(n, velocity - ring.velocity) + turning);
  const ContactForce law = contact_law(c.contact_distance - point.distance, rate, c.stiffness, k.alpha);
  const V3 force = (weight * law.force) * n;
  loads.a = loads.a + (1 - t) * force;
  loads.b = loads.b + t * force;
  sum.on_ring = sum.on_ring - force;
  sum.couple = sum.couple + (weight * law.force * lever) * point.radial;
  sum.potential += weight * law.potential;
  sum.power += weight * (law.force - law.elastic) * rate;
  sum.couple_power += weight * law.force * turning;
  return law;
}

// Takes off the share of an end node's own contact (count each contact once).
inline void take_off_node(const RingArguments& g, const RingMotion& ring, const Pair& c, V3 place, double t,
                          double weight, EndLoads& loads, RingSum& sum) {
  if (weight == 0) return;
  const CirclePoint point = point_circle(place, ring.center, ring.normal, ring.radius);
  if (point.distance < c.contact_distance) add_contact(g, ring, c, point, t, -weight, loads, sum);
}

// One pair; returns the distance left to a contact.
inline double one_pair(const RingArguments& g, const RingMotion& ring, const Pair& c, EndLoads& loads,
                       RingSum& sum) {
  const auto& k = g.contact;
  const V3 xa = at(k.x, k.y, k.z, c.a), xb = at(k.x, k.y, k.z, c.b);
  const CirclePoint point = g.golden ? segment_circle_golden(xa, xb, ring.center, ring.normal, ring.radius)
                                     : segment_circle_exact(xa, xb, ring.center, ring.normal, ring.radius);
  const double penetration = c.contact_distance - point.distance;
  if (!(penetration > 0)) return -penetration;
  const ContactForce law = add_contact(g, ring, c, point, point.t, 1, loads, sum);
  take_off_node(g, ring, c, xa, 0, c.weight_a, loads, sum);
  take_off_node(g, ring, c, xb, 1, c.weight_b, loads, sum);
  const double kappa = step_weight(k, law);
  const double lever =
      ring.radius * dot(point.p - point.q, ring.normal) / (point.distance > 0 ? point.distance : 1.0);
  note_use(sum, c, penetration, host_use(g, ring, kappa, lever), thread_share(k, c, point.t, kappa));
  return -penetration;
}

// Peak, first contact and its first release.
inline void note_force(RingTally& tally, double force, double time) {
  if (force > tally.peak_force) {
    tally.peak_force = force;
    tally.peak_time = time;
  }
  if (tally.state == 0 && force > 0) {
    tally.state = 1;
    tally.first_time = time;
  }
  if (tally.state == 1) {
    if (force > tally.first_peak) tally.first_peak = force;
    if (!(force > 0)) tally.state = 2;
  }
}

// What this step adds to the ring's tally.
inline void book(const RingArguments& g, const RingMotion& ring, const RingSum& sum, V3 couple,
                 RingTally& tally) {
  const auto& k = g.contact;
  tally.force[0] = sum.on_ring.x;
  tally.force[1] = sum.on_ring.y;
  tally.force[2] = sum.on_ring.z;
  tally.potential = sum.potential;
  tally.dissipated += k.dt * sum.power;
  if (ring.held || !g.couple) {  // a ring that cannot turn: its support takes the couple, without work
    const V3 torque = cross(ring.normal, couple);
    tally.couple_work += k.dt * sum.couple_power;
    tally.couple_impulse[0] += k.dt * torque.x;
    tally.couple_impulse[1] += k.dt * torque.y;
    tally.couple_impulse[2] += k.dt * torque.z;
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

// Forces on the host's ends.
inline void finish_ring(const RingArguments& g, Index r, const RingMotion& ring, const RingSum& sum,
                        LoadWriter& out) {
  const V3 couple = sum.couple - dot(sum.couple, ring.normal) * ring.normal;
  if (RingTally* tally = g.tallies[r]) book(g, ring, sum, couple, *tally);
  if (!sum.touched) return;
  if (ring.held) return out.add(g.rings[r].a, sum.on_ring);
  const V3 turn = g.couple ? ring.inverse_length * couple : V3{0, 0, 0};
  out.add(g.rings[r].a, 0.5 * sum.on_ring - turn);
  out.add(g.rings[r].b, 0.5 * sum.on_ring + turn);
}

// A ring that nothing is near to.
inline void release(RingTally& tally) {
  tally.force[0] = tally.force[1] = tally.force[2] = 0;
  tally.potential = 0;
  if (tally.state == 1) tally.state = 2;
}

// The pairs near[begin, end) of one ring that lie in lanes [0, end - begin) of a batch.
inline void take_lanes(const RingArguments& g, const RingMotion& ring, const RingLanes& lanes,
                       const Pair* pairs, const Index* near, Index begin, Index end, Index first_lane,
                       double* gap, RingSum& sum, LoadWriter& out) {
  for (Index i = begin; i < end; ++i) {
    const Pair& c = pairs[near[i]];
    const Index lane = first_lane + i - begin;
    if (lanes.circle.hard.at[lane] > 0) {
      EndLoads loads;
      gap[i] = one_pair(g, ring, c, loads, sum);
      if (!(gap[i] < 0)) continue;
      sum.touched = true;
      out.add(c.a, loads.a);
      out.add(c.b, loads.b);
      continue;
    }
    gap[i] = lanes.gap.at[lane];
    if (!(gap[i] < 0)) continue;
    take_lane(lanes, lane, c, sum);
    out.add(c.a, {lanes.on_a.x[lane], lanes.on_a.y[lane], lanes.on_a.z[lane]});
    out.add(c.b, {lanes.on_b.x[lane], lanes.on_b.y[lane], lanes.on_b.z[lane]});
  }
}

Index ring_contacts(const RingArguments& g, const Pair* pairs, const Index* near, Index count, double* gap,
                    kernel::Load* loads) {
  LoadWriter out{loads};
  RingLanes lanes;
  Index next = 0, batch_begin = 0, batch_end = 0;
  for (Index r = 0; r < g.ring_count; ++r) {
    const Index begin = next;
    while (next < count && pairs[near[next]].with == r) ++next;
    if (begin == next) {
      if (RingTally* tally = g.tallies[r]; tally != nullptr && (tally->state == 1 || tally->potential != 0))
        release(*tally);
      continue;
    }
    const RingMotion ring = ring_motion(g, g.rings[r]);
    RingSum sum;
    for (Index i = begin; i < next;) {
      if (i == batch_end) {  // the next batch of pairs, whatever their rings
        batch_begin = i;
        batch_end = count - i < lane_capacity ? count : i + lane_capacity;
        fill_lanes(g, pairs, near + i, batch_end - i, lanes);
      }
      const Index end = next < batch_end ? next : batch_end;
      take_lanes(g, ring, lanes, pairs, near, i, end, i - batch_begin, gap, sum, out);
      i = end;
    }
    finish_ring(g, r, ring, sum, out);
  }
  return static_cast<Index>(out.next - loads);
}

}  // namespace

void fill_ring_contact(KernelTable& table) { table.ring_contacts = ring_contacts; }

}  // namespace cinch::CINCH_ISA
