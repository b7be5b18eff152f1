// Batches of thread-ring pairs on arrays: what ring_contact.cpp derives, for many pairs at once.
#pragma once
#include "kernels/contact_item.hpp"
#include "kernels/segment_circle_lanes.hpp"

namespace cinch::CINCH_ISA {

/// Where a ring is and how it moves.
struct RingMotion {
  V3 center, normal, velocity;
  V3 turn;  ///< dN/dt before projection: (v_b - v_a) / L; zero for a ring with a node of its own
  double radius;
  double inverse_length;
  double host_share;  ///< sum of node_share over the host's nodes
  bool held;          ///< has a node of its own and does not turn
};

inline RingMotion ring_motion(const kernel::RingArguments& g, const kernel::RingGeometry& ring) {
  const auto& c = g.contact;
  const V3 xa = at(c.x, c.y, c.z, ring.a), va = at(c.vx, c.vy, c.vz, ring.a);
  if (ring.a == ring.b)
    return {xa,
            {ring.normal[0], ring.normal[1], ring.normal[2]},
            va,
            {0, 0, 0},
            ring.radius,
            0,
            c.node_share[ring.a],
            true};
  const V3 xb = at(c.x, c.y, c.z, ring.b), vb = at(c.vx, c.vy, c.vz, ring.b);
  const V3 along = xb - xa;
  const double length = norm(along);
  const double inverse =
      length > 0 ? 1 / length : 0.0;  // a host folded to a point keeps a zero normal: no contact
  return {0.5 * (xa + xb),
          inverse * along,
          0.5 * (va + vb),
          inverse * (vb - va),
          ring.radius,
          inverse,
          c.node_share[ring.a] + c.node_share[ring.b],
          false};
}

/// Sums over one ring's contacts in one step.
struct RingSum {
  V3 on_ring{0, 0, 0};  ///< force, N
  V3 couple{0, 0, 0};   ///< G, N m
  double potential = 0, power = 0, couple_power = 0;
  double penetration = 0;  ///< greatest, m
  double host_use = 0,
         thread_use = 0;  ///< shares of the stable step: summed on the host, greatest on a thread
  Index stiffest = -1;    ///< element with that greatest share
  bool touched = false;
};

inline void note_use(RingSum& sum, const kernel::Pair& c, double penetration, double host_use,
                     double thread_use) {
  sum.penetration = penetration > sum.penetration ? penetration : sum.penetration;
  sum.host_use += host_use;
  if (thread_use >= sum.thread_use) {
    sum.thread_use = thread_use;
    sum.stiffest = c.element;
  }
}

/// The contact's share of the stable step on the ring's side: half the force to each end, and the couple's
/// +-lever / L where it is kept.
inline double host_use(const kernel::RingArguments& g, const RingMotion& ring, double kappa, double lever) {
  if (ring.held) return kappa * ring.host_share;
  const double turn = g.couple ? lever * ring.inverse_length : 0.0;
  const double most = 0.5 + std::fabs(turn);  // of |n / 2 +- turn e|
  return kappa * most * most * ring.host_share;
}

struct RingLanes {
  CircleLanes circle;
  // in
  Lane3 velocity_a, velocity_b;  // of the element's ends, less the ring's
  Lane3 turn;
  Lane1 contact_distance, stiffness;
  Lane1 touch_a, touch_b;               // squared distance below which an end's own contact counts, or 0
  Lane1 share_a, share_b;               // node_share times multiplicity
  Lane1 host_share, half, turn_length;  // half: 1/2, or 1 on a ring that is held; inverse host length or 0
  // out
  Lane3 on_a, on_b, on_ring, couple;
  Lane1 gap, potential, power, couple_power, penetration, host_use, thread_use;
};

/// One pair into one lane.
inline void gather_lane(const kernel::RingArguments& g, const RingMotion& ring, const kernel::Pair& c,
                        Index lane, RingLanes& l) {
  const auto& k = g.contact;
  const auto put = [lane](Lane3& to, V3 v) { to.x[lane] = v.x, to.y[lane] = v.y, to.z[lane] = v.z; };
  const V3 xa = at(k.x, k.y, k.z, c.a), xb = at(k.x, k.y, k.z, c.b);
  put(l.circle.start, xa - ring.center);
  put(l.circle.along, xb - xa);
  put(l.circle.normal, ring.normal);
  l.circle.radius.at[lane] = ring.radius;
  put(l.velocity_a, at(k.vx, k.vy, k.vz, c.a) - ring.velocity);
  put(l.velocity_b, at(k.vx, k.vy, k.vz, c.b) - ring.velocity);
  put(l.turn, ring.turn);
  l.contact_distance.at[lane] = c.contact_distance;
  l.stiffness.at[lane] = c.stiffness;
  // a little more than the contact distance: rounding must not hide an end that touches
  const double touch = c.contact_distance * c.contact_distance * (1 + 1e-9);
  l.touch_a.at[lane] = c.weight_a != 0 ? touch : 0;
  l.touch_b.at[lane] = c.weight_b != 0 ? touch : 0;
  l.share_a.at[lane] = multiplicity(c.weight_a) * k.node_share[c.a];
  l.share_b.at[lane] = multiplicity(c.weight_b) * k.node_share[c.b];
  l.host_share.at[lane] = ring.host_share;
  l.half.at[lane] = ring.held ? 1.0 : 0.5;
  l.turn_length.at[lane] = ring.held || !g.couple ? 0.0 : ring.inverse_length;
}

/// Forces, energies and shares of all lanes, as add_contact and its callers in ring_contact.cpp.
inline void contact_lanes(const kernel::RingArguments& g, RingLanes& l, Index count) {
  const double slope_rate = 1.5 * g.contact.alpha;
  const double quarter = 0.25 * g.contact.step * g.contact.step, half_step = 0.5 * g.contact.step;
  CircleLanes& c = l.circle;
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const double t = c.t.at[i], s = 1 - t, distance = c.distance.at[i], dc = l.contact_distance.at[i];
    const double inverse = 1 / distance;
    const double nx = inverse * (c.p.x[i] - c.q.x[i]), ny = inverse * (c.p.y[i] - c.q.y[i]),
                 nz = inverse * (c.p.z[i] - c.q.z[i]);
    const double lever = c.radius.at[i] * (nx * c.normal.x[i] + ny * c.normal.y[i] + nz * c.normal.z[i]);
    const double turning =
        lever * (c.radial.x[i] * l.turn.x[i] + c.radial.y[i] * l.turn.y[i] + c.radial.z[i] * l.turn.z[i]);
    const double closing = nx * (s * l.velocity_a.x[i] + t * l.velocity_b.x[i]) +
                           ny * (s * l.velocity_a.y[i] + t * l.velocity_b.y[i]) +
                           nz * (s * l.velocity_a.z[i] + t * l.velocity_b.z[i]);
    const double rate = -(closing + turning);
    const double gap = distance - dc;
    const double penetration = gap < 0 ? dc - distance : 0.0;
    const double slope = l.stiffness.at[i] * std::sqrt(penetration);
    const double elastic = slope * penetration;
    const double factor = 1 + slope_rate * rate;
    const double pushed = factor > 0 ? factor : 0.0;
    const double force = elastic * pushed;
    const double fx = force * nx, fy = force * ny, fz = force * nz;
    const double bend = force * lever;
    const double kappa = quarter * (1.5 * slope * pushed) + half_step * (slope_rate * elastic);
    const double most = l.half.at[i] + std::fabs(lever * l.turn_length.at[i]);
    const double end_touches = c.end_squared.at[i] < l.touch_b.at[i] ? 1.0 : 0.0;
    const double ends = c.start_squared.at[i] < l.touch_a.at[i] ? 1.0 : end_touches;
    l.on_a.x[i] = s * fx, l.on_a.y[i] = s * fy, l.on_a.z[i] = s * fz;
    l.on_b.x[i] = t * fx, l.on_b.y[i] = t * fy, l.on_b.z[i] = t * fz;
    l.on_ring.x[i] = fx, l.on_ring.y[i] = fy, l.on_ring.z[i] = fz;
    l.couple.x[i] = bend * c.radial.x[i], l.couple.y[i] = bend * c.radial.y[i],
    l.couple.z[i] = bend * c.radial.z[i];
    l.potential.at[i] = 0.4 * elastic * penetration;
    l.power.at[i] = (force - elastic) * rate;
    l.couple_power.at[i] = force * turning;
    l.gap.at[i] = gap;
    l.penetration.at[i] = penetration;
    l.host_use.at[i] = kappa * most * most * l.host_share.at[i];
    l.thread_use.at[i] = kappa * (s * s * l.share_a.at[i] + t * t * l.share_b.at[i]);
    c.hard.at[i] += gap < 0 ? ends : 0.0;
    c.hard.at[i] += distance > 0 ? 0.0 : 1.0;
  }
}

/// The pairs pairs[near[i]], i < count <= lane_capacity; whole vectors of lanes are filled up with the last
/// one.
inline void fill_lanes(const kernel::RingArguments& g, const kernel::Pair* pairs, const Index* near,
                       Index count, RingLanes& l) {
  if (g.golden) {
    for (Index i = 0; i < count; ++i) l.circle.hard.at[i] = 1;
    return;
  }
  const Index padded = (count + kernel::lanes - 1) / kernel::lanes * kernel::lanes;
  RingMotion ring{};
  for (Index i = 0, with = -1; i < padded; ++i) {
    const kernel::Pair& c = pairs[near[i < count ? i : count - 1]];
    if (c.with != with) ring = ring_motion(g, g.rings[with = c.with]);
    gather_lane(g, ring, c, i, l);
  }
  segment_circle_lanes(l.circle, padded);
  contact_lanes(g, l, padded);
}

/// Adds a lane in contact to its ring's sums.
inline void take_lane(const RingLanes& l, Index lane, const kernel::Pair& c, RingSum& sum) {
  sum.touched = true;
  sum.on_ring = sum.on_ring - V3{l.on_ring.x[lane], l.on_ring.y[lane], l.on_ring.z[lane]};
  sum.couple = sum.couple + V3{l.couple.x[lane], l.couple.y[lane], l.couple.z[lane]};
  sum.potential += l.potential.at[lane];
  sum.power += l.power.at[lane];
  sum.couple_power += l.couple_power.at[lane];
  note_use(sum, c, l.penetration.at[lane], l.host_use.at[lane], l.thread_use.at[lane]);
}

}  // namespace cinch::CINCH_ISA
