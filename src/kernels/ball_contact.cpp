// Contact of thread elements with a fixed ball: the law of eqs. (6)-(9) between the element's closest point P
// and the ball's surface, penetration delta = R + r_A - |P - C|. Shared nodes are counted once as in
// ring_contact.cpp. A mass as a sphere is an element without length (a == b).
#include "kernels/contact_item.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::BallArguments;
using kernel::BallTally;
using kernel::Pair;

// Parameter of the segment's point closest to the centre.
inline double closest_on_segment(V3 a, V3 b, V3 center) {
  const V3 m = b - a;
  const double mm = dot(m, m);
  const double t = mm > 0 ? dot(center - a, m) / mm : 0.0;
  return t < 0 ? 0.0 : (t > 1 ? 1.0 : t);
}

// What one pair feels in one step.
struct BallSum {
  double potential = 0, power = 0, penetration = 0;
  V3 impulse{0, 0, 0}, moment{0, 0, 0};  // of the force: times dt
};

// Adds `weight` times the contact of the point at t, which lies `out` from the centre; the law's result for
// the watch.
inline ContactForce add_contact(const BallArguments& g, const Pair& c, V3 place, V3 out, double distance,
                                double t, double weight, EndLoads& loads, BallSum& sum) {
  const auto& k = g.contact;
  const V3 n = distance > 0 ? (1 / distance) * out : V3{0, 0, 1};
  const double rate = -dot(n, blend(at(k.vx, k.vy, k.vz, c.a), at(k.vx, k.vy, k.vz, c.b), t));
  const double penetration = c.contact_distance - distance;
  const ContactForce law = contact_law(penetration, rate, c.stiffness, k.alpha);
  const V3 force = (weight * law.force) * n;
  loads.a = loads.a + (1 - t) * force;
  loads.b = loads.b + t * force;
  sum.potential += weight * law.potential;
  sum.power += weight * (law.force - law.elastic) * rate;
  sum.impulse = sum.impulse + force;
  sum.moment = sum.moment + cross(place, force);
  sum.penetration = penetration > sum.penetration ? penetration : sum.penetration;
  return law;
}

// Takes off the share of an end node's own contact.
inline void take_off_node(const BallArguments& g, const Pair& c, V3 place, V3 center, double t, double weight,
                          EndLoads& loads, BallSum& sum) {
  if (weight == 0) return;
  const V3 out = place - center;
  const double distance = norm(out);
  if (distance < c.contact_distance) add_contact(g, c, place, out, distance, t, -weight, loads, sum);
}

inline void book(const BallArguments& g, const Pair& c, const BallSum& sum, double share, BallTally& tally) {
  const double dt = g.contact.dt;
  tally.potential = sum.potential;
  tally.dissipated += dt * sum.power;
  const double force[3] = {sum.impulse.x, sum.impulse.y, sum.impulse.z};
  const double moment[3] = {sum.moment.x, sum.moment.y, sum.moment.z};
  for (int d = 0; d < 3; ++d) {
    tally.impulse[d] += dt * force[d];
    tally.moment[d] += dt * moment[d];
  }
  if (sum.penetration > tally.max_penetration) tally.max_penetration = sum.penetration;
  if (tally.first_time < 0) tally.first_time = g.contact.time;
  if (share > tally.stiffest) {
    tally.stiffest = share;
    tally.stiffest_time = g.contact.time;
    tally.stiffest_element = c.element;
  }
}

// One pair in contact, at parameter t of its element.
inline void touch(const BallArguments& g, const Pair& c, V3 xa, V3 xb, V3 center, double t, BallTally* tally,
                  LoadWriter& out) {
  EndLoads loads;
  BallSum sum;
  const V3 place = blend(xa, xb, t), away = place - center;
  const ContactForce law = add_contact(g, c, place, away, norm(away), t, 1, loads, sum);
  take_off_node(g, c, xa, center, 0, c.weight_a, loads, sum);
  take_off_node(g, c, xb, center, 1, c.weight_b, loads, sum);
  if (tally != nullptr) book(g, c, sum, thread_share(g.contact, c, t, step_weight(g.contact, law)), *tally);
  out.add(c.a, loads.a);
  out.add(c.b, loads.b);
}

Index ball_contacts(const BallArguments& g, const Pair* pairs, const Index* near, Index count, double* gap,
                    kernel::Load* loads) {
  const auto& k = g.contact;
  LoadWriter out{loads};
  for (Index i = 0; i < count; ++i) {
    const Pair& c = pairs[near[i]];
    const double* const middle = g.centers + 3 * c.with;
    const V3 center{middle[0], middle[1], middle[2]};
    const V3 xa = at(k.x, k.y, k.z, c.a), xb = at(k.x, k.y, k.z, c.b);
    const double t = closest_on_segment(xa, xb, center);
    gap[i] = norm(blend(xa, xb, t) - center) - c.contact_distance;
    BallTally* const tally = g.tallies[near[i]];
    if (gap[i] < 0) touch(g, c, xa, xb, center, t, tally, out);
    else if (tally != nullptr) tally->potential = 0;
  }
  return static_cast<Index>(out.next - loads);
}

}  // namespace

void fill_ball_contact(KernelTable& table) { table.ball_contacts = ball_contacts; }

}  // namespace cinch::CINCH_ISA
