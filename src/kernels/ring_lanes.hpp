// Batches of thread-ring pairs on arrays: what ring_contact.cpp derives, for many pairs at once.
#pragma once
#include "kernels/contact_item.hpp"
#include "kernels/ring_sleep.hpp"
#include "kernels/segment_circle_lanes.hpp"

namespace cinch::CINCH_ISA {

/// The contact's share of the stable step on the ring's side: half the force to each end, and the couple's
/// +-lever / L where it is kept; all of it on a ring with a node of its own.
inline double host_use(double kappa, double half, double turn_length, double lever, double host_share) {
  const double most = half + std::fabs(lever * turn_length);  // of |n / 2 +- turn e|
  return kappa * most * most * host_share;
}

struct RingLanes {
  CircleLanes circle;
  // in
  Lane3 place_a, place_b, host_a, host_b;  // nodes of the element and of the host
  Lane3 speed_a, speed_b, host_speed_a, host_speed_b;
  Lane1 held, contact_distance, stiffness, touch_a, touch_b, share_a, share_b, host_share;  // as RingLane
  // between
  Lane3 speed, along_speed, turn;  // of the element's first end and from there to the second, less the ring's
  Lane1 inverse_length, turning;   // 1 / L of the host; of one that turns its ring, infinite at a point
  // out
  Lane3 on_a, on_b, on_host_a, on_host_b, on_ring, torque;
  Lane1 gap, sleep, potential, power, couple_power, host_use, thread_use;
  Lane1 looked_at;  // 1: touches or is hard
};
static_assert(sizeof(RingLanes) <= sizeof(double) * kernel::ring_scratch);

inline void put(Lane3& to, Index lane, V3 v) { to.x[lane] = v.x, to.y[lane] = v.y, to.z[lane] = v.z; }
inline V3 get(const Lane3& from, Index lane) { return {from.x[lane], from.y[lane], from.z[lane]}; }

/// One pair into one lane. A ring that does not turn gets a host of length 1 along its normal.
inline void gather_lane(const kernel::ContactArguments& k, const kernel::RingLane& p,
                        const double (&normal)[3], Index lane, RingLanes& l) {
  const auto place = [&](Index node) { return at(k.x, k.y, k.z, node); };
  const auto speed = [&](Index node) { return at(k.vx, k.vy, k.vz, node); };
  put(l.place_a, lane, place(p.a));
  put(l.place_b, lane, place(p.b));
  put(l.host_a, lane, place(p.host_a));
  put(l.host_b, lane, place(p.host_b));
  if (p.held > 0) {
    const V3 along{0.5 * normal[0], 0.5 * normal[1], 0.5 * normal[2]};
    put(l.host_a, lane, place(p.host_a) - along);
    put(l.host_b, lane, place(p.host_b) + along);
  }
  put(l.speed_a, lane, speed(p.a));
  put(l.speed_b, lane, speed(p.b));
  put(l.host_speed_a, lane, speed(p.host_a));
  put(l.host_speed_b, lane, speed(p.host_b));
  l.held.at[lane] = p.held;
  l.circle.radius.at[lane] = p.radius;
  l.contact_distance.at[lane] = p.contact_distance;
  l.stiffness.at[lane] = p.stiffness;
  l.touch_a.at[lane] = p.touch_a;
  l.touch_b.at[lane] = p.touch_b;
  l.share_a.at[lane] = p.share_a;
  l.share_b.at[lane] = p.share_b;
  l.host_share.at[lane] = p.host_share;
}

/// How the rings lie and move, and the elements as seen from them; as ring_motion in ring_contact.cpp.
inline void motion_lanes(RingLanes& l, Index count) {
  CircleLanes& c = l.circle;
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const double hx = l.host_b.x[i] - l.host_a.x[i], hy = l.host_b.y[i] - l.host_a.y[i],
                 hz = l.host_b.z[i] - l.host_a.z[i];
    const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
    const double reciprocal = 1 / length;
    const double inverse = length > 0 ? reciprocal : 0.0;  // a host folded to a point: no normal, no contact
    l.inverse_length.at[i] = inverse;
    l.turning.at[i] = l.held.at[i] > 0 ? 0.0 : reciprocal;
    c.normal.x[i] = inverse * hx, c.normal.y[i] = inverse * hy, c.normal.z[i] = inverse * hz;
    c.start.x[i] = l.place_a.x[i] - 0.5 * (l.host_a.x[i] + l.host_b.x[i]);
    c.start.y[i] = l.place_a.y[i] - 0.5 * (l.host_a.y[i] + l.host_b.y[i]);
    c.start.z[i] = l.place_a.z[i] - 0.5 * (l.host_a.z[i] + l.host_b.z[i]);
    c.along.x[i] = l.place_b.x[i] - l.place_a.x[i];
    c.along.y[i] = l.place_b.y[i] - l.place_a.y[i];
    c.along.z[i] = l.place_b.z[i] - l.place_a.z[i];
    l.speed.x[i] = l.speed_a.x[i] - 0.5 * (l.host_speed_a.x[i] + l.host_speed_b.x[i]);
    l.speed.y[i] = l.speed_a.y[i] - 0.5 * (l.host_speed_a.y[i] + l.host_speed_b.y[i]);
    l.speed.z[i] = l.speed_a.z[i] - 0.5 * (l.host_speed_a.z[i] + l.host_speed_b.z[i]);
    l.along_speed.x[i] = l.speed_b.x[i] - l.speed_a.x[i];
    l.along_speed.y[i] = l.speed_b.y[i] - l.speed_a.y[i];
    l.along_speed.z[i] = l.speed_b.z[i] - l.speed_a.z[i];
    l.turn.x[i] = inverse * (l.host_speed_b.x[i] - l.host_speed_a.x[i]);
    l.turn.y[i] = inverse * (l.host_speed_b.y[i] - l.host_speed_a.y[i]);
    l.turn.z[i] = inverse * (l.host_speed_b.z[i] - l.host_speed_a.z[i]);
  }
}

/// Forces, energies and shares of all lanes, as in ring_contact.cpp.
inline void contact_lanes(const kernel::RingArguments& g, RingLanes& l, Index count) {
  const double slope_rate = 1.5 * g.contact.alpha, kept = g.couple ? 1.0 : 0.0;
  const double quarter = 0.25 * g.contact.step * g.contact.step, half_step = 0.5 * g.contact.step;
  CircleLanes& c = l.circle;
#pragma omp simd
  for (Index i = 0; i < count; ++i) {
    const double t = c.t.at[i], s = 1 - t, distance = c.distance.at[i];
    const double inverse = 1 / distance;
    const double nx = inverse * (c.p.x[i] - c.q.x[i]), ny = inverse * (c.p.y[i] - c.q.y[i]),
                 nz = inverse * (c.p.z[i] - c.q.z[i]);
    const double ax = c.normal.x[i], ay = c.normal.y[i], az = c.normal.z[i];
    const double ex = c.radial.x[i], ey = c.radial.y[i], ez = c.radial.z[i];
    const double lever = c.radius.at[i] * (nx * ax + ny * ay + nz * az);
    const double turning = lever * (ex * l.turn.x[i] + ey * l.turn.y[i] + ez * l.turn.z[i]);
    const double leaving = nx * (l.speed.x[i] + t * l.along_speed.x[i]) +
                           ny * (l.speed.y[i] + t * l.along_speed.y[i]) +
                           nz * (l.speed.z[i] + t * l.along_speed.z[i]);
    const double rate = -(leaving + turning);
    const double gap = distance - l.contact_distance.at[i];
    const double penetration = gap < 0 ? -gap : 0.0;
    const double slope = l.stiffness.at[i] * std::sqrt(penetration);
    const double elastic = slope * penetration;
    const double factor = 1 + slope_rate * rate;
    const double pushed = factor > 0 ? factor : 0.0;
    const double force = elastic * pushed;
    const double fx = force * nx, fy = force * ny, fz = force * nz;
    // the couple G = F R (n.N) e, of which the host's ends take what is normal to N, over its length
    const double bend = force * lever, along = bend * (ex * ax + ey * ay + ez * az);
    const double gx = bend * ex - along * ax, gy = bend * ey - along * ay, gz = bend * ez - along * az;
    const double held = l.held.at[i], half = held > 0 ? 1.0 : 0.5;
    const double turn_length = held > 0 ? 0.0 : kept * l.inverse_length.at[i];
    const double lost = held > 0 ? 1.0 : 1.0 - kept;
    const double kappa = quarter * (1.5 * slope * pushed) + half_step * (slope_rate * elastic);
    const double most = half + std::fabs(lever * turn_length);
    const double end_touches = c.end_squared.at[i] < l.touch_b.at[i] ? 1.0 : 0.0;
    const double ends = c.start_squared.at[i] < l.touch_a.at[i] ? 1.0 : end_touches;
    l.on_a.x[i] = s * fx, l.on_a.y[i] = s * fy, l.on_a.z[i] = s * fz;
    l.on_b.x[i] = t * fx, l.on_b.y[i] = t * fy, l.on_b.z[i] = t * fz;
    l.on_ring.x[i] = -fx, l.on_ring.y[i] = -fy, l.on_ring.z[i] = -fz;
    l.on_host_a.x[i] = -half * fx - turn_length * gx;
    l.on_host_a.y[i] = -half * fy - turn_length * gy;
    l.on_host_a.z[i] = -half * fz - turn_length * gz;
    l.on_host_b.x[i] = -half * fx + turn_length * gx;
    l.on_host_b.y[i] = -half * fy + turn_length * gy;
    l.on_host_b.z[i] = -half * fz + turn_length * gz;
    l.torque.x[i] = lost * (ay * gz - az * gy);
    l.torque.y[i] = lost * (az * gx - ax * gz);
    l.torque.z[i] = lost * (ax * gy - ay * gx);
    l.potential.at[i] = 0.4 * elastic * penetration;
    const double thickening = factor > 0 ? slope_rate * (1.5 * slope) : 0.0;
    l.power.at[i] = damper_power(force - elastic, thickening, rate, g.contact.step);
    l.couple_power.at[i] = lost * (force * turning);
    l.gap.at[i] = gap;
    l.sleep.at[i] = ring_sleep(gap, c.radius.at[i], l.turning.at[i]);
    l.host_use.at[i] = kappa * most * most * l.host_share.at[i];
    l.thread_use.at[i] = thread_share(kappa, t, l.share_a.at[i], l.share_b.at[i]);
    const double hard = c.hard.at[i] + (gap < 0 ? ends : 0.0) + (distance > 0 ? 0.0 : 1.0);
    c.hard.at[i] = hard;
    l.looked_at.at[i] = gap < 0 ? 1.0 : hard;
  }
}

/// The pairs pairs[near[i]], i < count <= lane_capacity. What whole groups of lanes have besides is old.
inline void fill_lanes(const kernel::RingArguments& g, const kernel::Pair* pairs, const Index* near,
                       Index count, RingLanes& l) {
  if (g.golden) {
    for (Index i = 0; i < count; ++i) l.circle.hard.at[i] = l.looked_at.at[i] = 1;
    return;
  }
  for (Index i = 0; i < count; ++i)
    gather_lane(g.contact, g.lanes[near[i]], g.rings[pairs[near[i]].with].normal, i, l);
  const Index padded = (count + kernel::lanes - 1) / kernel::lanes * kernel::lanes;
  motion_lanes(l, padded);
  segment_circle_lanes(l.circle, padded);
  contact_lanes(g, l, padded);
}

}  // namespace cinch::CINCH_ISA
