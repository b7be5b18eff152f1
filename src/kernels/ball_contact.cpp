// Contact of thread elements with a fixed ball: the law of eqs. (6)-(9) between the element's closest point P
// and the ball's surface, penetration delta = R + r_A - |P - C|. Shared nodes are counted once as in
// ring_contact.cpp. A mass as a sphere is an element without length (a == b).
#include "kernels/contact_item.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::BallArguments;
using kernel::BallTally;
using kernel::Candidate;

// Parameter of the segment's point closest to the centre.
inline double closest_on_segment(V3 a, V3 b, V3 center) {
  const V3 m = b - a;
  const double mm = dot(m, m);
  const double t = mm > 0 ? dot(center - a, m) / mm : 0.0;
  return t < 0 ? 0.0 : (t > 1 ? 1.0 : t);
}

// Adds `weight` times the contact of the point at t, if there is one; the law's result for the watch.
inline ContactForce add_contact(const BallArguments& g, const Candidate& c, V3 place, double t, double weight,
                                EndLoads& loads, BallTally& tally) {
  const auto& k = g.contact;
  const V3 out = place - V3{g.center[0], g.center[1], g.center[2]};
  const double distance = norm(out);
  if (!(distance < c.contact_distance)) return {0, 0, 0, 0, 0};
  const V3 n = distance > 0 ? (1 / distance) * out : V3{0, 0, 1};
  const double rate = -dot(n, blend(at(k.vx, k.vy, k.vz, c.a), at(k.vx, k.vy, k.vz, c.b), t));
  const double penetration = c.contact_distance - distance;
  const ContactForce law = contact_law(penetration, rate, c.stiffness, k.alpha);
  const V3 force = (weight * law.force) * n;
  loads.a = loads.a + (1 - t) * force;
  loads.b = loads.b + t * force;
  tally.potential += weight * law.potential;
  tally.dissipated += k.dt * (weight * (law.force - law.elastic) * rate);
  const V3 moment = cross(place, force);
  const double impulse[3] = {k.dt * force.x, k.dt * force.y, k.dt * force.z};
  const double turned[3] = {k.dt * moment.x, k.dt * moment.y, k.dt * moment.z};
  for (int d = 0; d < 3; ++d) {
    tally.impulse[d] += impulse[d];
    tally.moment[d] += turned[d];
  }
  if (penetration > tally.max_penetration) tally.max_penetration = penetration;
  return law;
}

inline EndLoads candidate_contact(const BallArguments& g, const Candidate& c, BallTally& tally) {
  const auto& k = g.contact;
  EndLoads loads;
  const V3 center{g.center[0], g.center[1], g.center[2]};
  const V3 xa = at(k.x, k.y, k.z, c.a), xb = at(k.x, k.y, k.z, c.b);
  const double t = closest_on_segment(xa, xb, center);
  const ContactForce law = add_contact(g, c, blend(xa, xb, t), t, 1, loads, tally);
  if (!(law.elastic > 0)) return loads;
  if (c.weight_a != 0) add_contact(g, c, xa, 0, -c.weight_a, loads, tally);
  if (c.weight_b != 0) add_contact(g, c, xb, 1, -c.weight_b, loads, tally);
  if (tally.first_time < 0) tally.first_time = k.time;
  const double share = thread_share(k, c, t, step_weight(k, law));
  if (share > tally.stiffest) {
    tally.stiffest = share;
    tally.stiffest_time = k.time;
    tally.stiffest_element = c.element;
  }
  return loads;
}

void ball_contacts(const BallArguments& g, Index begin, Index end, BallTally& tally) {
  tally.potential = 0;
  for (Index i = begin; i < end; ++i) {
    const EndLoads loads = candidate_contact(g, g.contact.candidates[i], tally);
    const Index slot = g.first_slot + 2 * i;
    const V3 ends[2] = {loads.a, loads.b};
    for (int s = 0; s < 2; ++s) {
      g.contact.load_x[slot + s] = ends[s].x;
      g.contact.load_y[slot + s] = ends[s].y;
      g.contact.load_z[slot + s] = ends[s].z;
    }
  }
}

}  // namespace

void fill_ball_contact(KernelTable& table) { table.ball_contacts = ball_contacts; }

}  // namespace cinch::CINCH_ISA
