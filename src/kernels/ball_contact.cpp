// Contact of thread elements with a fixed ball: the law of eqs. (6)-(9) between the element's closest point P
// and the ball's surface, penetration delta = R + r_A - |P - C|. How contacts at shared nodes count is in
// contact_item.hpp. A mass as a sphere is an element without length (a == b).
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

// A place on an element: its parameter, how it lies to the centre.
struct BallPoint {
  double t;
  V3 place, out;
  double distance;
};

inline BallPoint ball_point(V3 xa, V3 xb, V3 center, double t) {
  const V3 place = blend(xa, xb, t), out = place - center;
  return {t, place, out, norm(out)};
}

// Adds the contact of the point as far as it counts; returns the law's result for the watch.
inline ContactForce add_contact(const BallArguments& g, const Pair& c, const BallPoint& point,
                                ContactWeight weight, EndLoads& loads, BallSum& sum) {
  const auto& k = g.contact;
  const double t = point.t;
  const V3 n = point.distance > 0 ? (1 / point.distance) * point.out : V3{0, 0, 1};
  const double rate = -dot(n, blend(at(k.vx, k.vy, k.vz, c.a), at(k.vx, k.vy, k.vz, c.b), t));
  const double penetration = c.contact_distance - point.distance;
  const ContactForce law = contact_law(penetration, rate, c.stiffness, k.alpha);
  const double damper = weight.damper * (law.force - law.elastic);
  const V3 force = (weight.spring * law.elastic + damper) * n;
  loads.a = loads.a + (1 - t) * force;
  loads.b = loads.b + t * force;
  sum.potential += weight.spring * law.potential;
  sum.power += damper_power(damper, weight.damper * law.thickening, rate, k.step);
  sum.impulse = sum.impulse + force;
  sum.moment = sum.moment + cross(point.place, force);
  sum.penetration = penetration > sum.penetration ? penetration : sum.penetration;
  return law;
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

// One pair in contact at `point`.
inline void touch(const BallArguments& g, const Pair& c, V3 xa, V3 xb, V3 center, const BallPoint& point,
                  BallTally* tally, LoadWriter& out) {
  EndLoads loads;
  BallSum sum;
  const bool once = c.fraction_a > 0;
  const BallPoint end_a = ball_point(xa, xb, center, 0), end_b = ball_point(xa, xb, center, 1);
  const double depth_a = once ? c.contact_distance - end_a.distance : 0;
  const double depth_b = once ? c.contact_distance - end_b.distance : 0;
  const double depth = c.contact_distance - point.distance;
  const ContactWeights weights = contact_weights(c, depth, depth_a, depth_b);
  const ContactForce law = add_contact(g, c, point, weights.element, loads, sum);
  if (depth_a > 0) add_contact(g, c, end_a, weights.a, loads, sum);
  if (depth_b > 0) add_contact(g, c, end_b, weights.b, loads, sum);
  if (tally != nullptr) {
    const double kappa = step_weight(g.contact, law);
    const double share_a = multiplicity(c.fraction_a) * g.contact.node_share[c.a];
    const double share_b = multiplicity(c.fraction_b) * g.contact.node_share[c.b];
    const bool both = depth_a > 0 && depth_b > 0;
    const double use =
        both ? thread_share_of_both(c, kappa, point.t, depth, depth_a, depth_b, share_a, share_b)
             : thread_share(kappa, point.t, share_a, share_b);
    book(g, c, sum, use, *tally);
  }
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
    const BallPoint point = ball_point(xa, xb, center, closest_on_segment(xa, xb, center));
    gap[i] = point.distance - c.contact_distance;
    BallTally* const tally = g.tallies[near[i]];
    if (gap[i] < 0) touch(g, c, xa, xb, center, point, tally, out);
    else if (tally != nullptr) tally->potential = 0;
  }
  return static_cast<Index>(out.next - loads);
}

}  // namespace

void fill_ball_contact(KernelTable& table) { table.ball_contacts = ball_contacts; }

}  // namespace cinch::CINCH_ISA
