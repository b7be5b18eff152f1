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
#include "kernels/contact_item.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/segment_circle.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::Candidate;
using kernel::RingArguments;
using kernel::RingGeometry;
using kernel::RingTally;

// Where a ring is and how it moves.
struct RingMotion {
  V3 center, normal, velocity;
  V3 turn;  // dN/dt before projection: (v_b - v_a) / L; zero for a ring with a node of its own
  double inverse_length;
  double host_share;  // sum of node_share over the host's nodes
};

inline RingMotion ring_motion(const RingArguments& g, const RingGeometry& ring) {
  const auto& c = g.contact;
  const V3 xa = at(c.x, c.y, c.z, ring.a), va = at(c.vx, c.vy, c.vz, ring.a);
  if (ring.a == ring.b)
    return {xa, {ring.normal[0], ring.normal[1], ring.normal[2]}, va, {0, 0, 0}, 0, c.node_share[ring.a]};
  const V3 xb = at(c.x, c.y, c.z, ring.b), vb = at(c.vx, c.vy, c.vz, ring.b);
  const V3 along = xb - xa;
  const double length = norm(along);
  const double inverse =
      length > 0 ? 1 / length : 0.0;  // a host folded to a point keeps a zero normal: no contact
  return {0.5 * (xa + xb),     inverse * along, 0.5 * (va + vb),
          inverse * (vb - va), inverse,         c.node_share[ring.a] + c.node_share[ring.b]};
}

// Sums over one ring's contacts in one step.
struct RingSum {
  V3 on_ring{0, 0, 0};  // force, N
  V3 couple{0, 0, 0};   // G, N m
  double potential = 0, power = 0, couple_power = 0;
  double host_use = 0, thread_use = 0;  // shares of the stable step: summed on the host, greatest on a thread
  Index stiffest = -1;                  // element with that greatest share
};

// The contact's share on the ring's side: half the force to each end, and the couple's +-lever / L where it
// is kept.
inline double host_use(const RingArguments& g, const RingMotion& ring, double kappa, double lever) {
  if (ring.inverse_length == 0) return kappa * ring.host_share;
  const double turn = g.couple ? lever * ring.inverse_length : 0.0;
  const double most = 0.5 + std::fabs(turn);  // of |n / 2 +- turn e|
  return kappa * most * most * ring.host_share;
}

// Adds `weight` times the contact of the point at t; returns the law's result for the watch.
inline ContactForce add_contact(const RingArguments& g, const RingMotion& ring, const RingGeometry& shape,
                                const Candidate& c, const CirclePoint& point, double t, double weight,
                                EndLoads& loads, RingSum& sum) {
  const auto& k = g.contact;
  const V3 gap = point.p - point.q;
  // on the wire's centre line itself the thread is pushed towards the ring's axis
  const V3 n = point.distance > 0 ? (1 / point.distance) * gap : -1.0 * point.radial;
  const V3 velocity = blend(at(k.vx, k.vy, k.vz, c.a), at(k.vx, k.vy, k.vz, c.b), t);
  const double lever = shape.radius * dot(n, ring.normal);
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
inline void take_off_node(const RingArguments& g, const RingMotion& ring, const RingGeometry& shape,
                          const Candidate& c, V3 place, double t, double weight, EndLoads& loads,
                          RingSum& sum) {
  if (weight == 0) return;
  const CirclePoint point = point_circle(place, ring.center, ring.normal, shape.radius);
  if (point.distance < c.contact_distance) add_contact(g, ring, shape, c, point, t, -weight, loads, sum);
}

// One candidate; returns what it puts on its ends.
inline EndLoads candidate_contact(const RingArguments& g, const RingMotion& ring, const RingGeometry& shape,
                                  const Candidate& c, RingSum& sum, RingTally& tally) {
  const auto& k = g.contact;
  EndLoads loads;
  const V3 xa = at(k.x, k.y, k.z, c.a), xb = at(k.x, k.y, k.z, c.b);
  if (segment_circle_lower_bound(xa, xb, ring.center, ring.normal, shape.radius) >= c.contact_distance)
    return loads;
  const CirclePoint point = g.golden ? segment_circle_golden(xa, xb, ring.center, ring.normal, shape.radius)
                                     : segment_circle_exact(xa, xb, ring.center, ring.normal, shape.radius);
  const double penetration = c.contact_distance - point.distance;
  if (!(penetration > 0)) return loads;
  const ContactForce law = add_contact(g, ring, shape, c, point, point.t, 1, loads, sum);
  take_off_node(g, ring, shape, c, xa, 0, c.weight_a, loads, sum);
  take_off_node(g, ring, shape, c, xb, 1, c.weight_b, loads, sum);
  tally.max_penetration = penetration > tally.max_penetration ? penetration : tally.max_penetration;
  const double kappa = step_weight(k, law);
  const double lever =
      shape.radius * dot(point.p - point.q, ring.normal) / (point.distance > 0 ? point.distance : 1.0);
  sum.host_use += host_use(g, ring, kappa, lever);
  const double use = thread_share(k, c, point.t, kappa);
  if (use >= sum.thread_use) {
    sum.thread_use = use;
    sum.stiffest = c.element;
  }
  return loads;
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

inline void put_load(const kernel::ContactArguments& g, Index slot, V3 force) {
  g.load_x[slot] = force.x;
  g.load_y[slot] = force.y;
  g.load_z[slot] = force.z;
}

// Forces on the host's ends, and what this step adds to the ring's tally.
inline void finish_ring(const RingArguments& g, const RingMotion& ring, Index r, const RingSum& sum) {
  const auto& k = g.contact;
  RingTally& tally = g.tallies[r];
  const V3 couple = sum.couple - dot(sum.couple, ring.normal) * ring.normal;
  const V3 turn = g.couple ? ring.inverse_length * couple : V3{0, 0, 0};
  if (g.rings[r].a == g.rings[r].b) {
    put_load(k, g.host_slot + 2 * r, sum.on_ring);
    put_load(k, g.host_slot + 2 * r + 1, {0, 0, 0});
  } else {
    put_load(k, g.host_slot + 2 * r, 0.5 * sum.on_ring - turn);
    put_load(k, g.host_slot + 2 * r + 1, 0.5 * sum.on_ring + turn);
  }
  tally.force[0] = sum.on_ring.x;
  tally.force[1] = sum.on_ring.y;
  tally.force[2] = sum.on_ring.z;
  tally.potential = sum.potential;
  tally.dissipated += k.dt * sum.power;
  const bool held =
      g.rings[r].a == g.rings[r].b;  // a ring that cannot turn: its support takes the couple, without work
  if (held || !g.couple) {
    const V3 torque = cross(ring.normal, couple);
    tally.couple_work += k.dt * sum.couple_power;
    tally.couple_impulse[0] += k.dt * torque.x;
    tally.couple_impulse[1] += k.dt * torque.y;
    tally.couple_impulse[2] += k.dt * torque.z;
  }
  note_force(tally, norm(sum.on_ring), k.time);
  const double share = sum.host_use + sum.thread_use;
  if (share > tally.stiffest) {
    tally.stiffest = share;
    tally.stiffest_time = k.time;
    tally.stiffest_element = sum.stiffest;
  }
}

void ring_contacts(const RingArguments& g, Index begin, Index end) {
  for (Index r = begin; r < end; ++r) {
    if (g.candidate_begin[r] == g.candidate_begin[r + 1])
      continue;  // its loads were zeroed when the list was made
    const RingMotion ring = ring_motion(g, g.rings[r]);
    RingSum sum;
    for (Index i = g.candidate_begin[r]; i < g.candidate_begin[r + 1]; ++i) {
      const EndLoads loads =
          candidate_contact(g, ring, g.rings[r], g.contact.candidates[i], sum, g.tallies[r]);
      put_load(g.contact, 2 * i, loads.a);
      put_load(g.contact, 2 * i + 1, loads.b);
    }
    finish_ring(g, ring, r, sum);
  }
}

}  // namespace

void fill_ring_contact(KernelTable& table) { table.ring_contacts = ring_contacts; }

}  // namespace cinch::CINCH_ISA
