// One contact of an element (or of its end node alone) with a ring or ball: what both kernels share.
#pragma once
#include "kernels/arguments.hpp"
#include "kernels/contact_law.hpp"

namespace cinch::CINCH_ISA {

inline V3 at(const double* x, const double* y, const double* z, Index i) { return {x[i], y[i], z[i]}; }

inline V3 blend(V3 a, V3 b, double t) { return (1 - t) * a + t * b; }

/// Forces that one pair puts on its two ends, N.
struct EndLoads {
  V3 a{0, 0, 0}, b{0, 0, 0};
};

/// dt^2/4 dF/dd + dt/2 dF/d(dd/dt) of one contact, kg: what it adds to the matrix of stable_step.hpp.
inline double step_weight(const kernel::ContactArguments& g, const ContactForce& law) {
  return 0.25 * g.step * g.step * law.stiffness + 0.5 * g.step * law.damping;
}

// Elements that meet in a node report its contact each. Counted once (contact.shared_node), the potential is
//   U = sum over nodes U_n + sum over elements (U_e - max(U_a, U_b)),
// U_e at the element's closest point, U_n at a node, a and b the element's ends: every node by itself, and
// what an element sinks in deeper than its ends. It is continuous in all positions, nothing in it is negative
// (U_e >= U_a, U_b), and where no element has both ends in contact it is that of inclusion and exclusion:
// cutting a straight element in two changes nothing. Each of the elements at a node carries U_n / degree.
// Dampers go with what is left of the elastic force at a place, alpha (F_e - max(F_a, F_b)) and alpha F_n, so
// that each takes energy.

/// By how much the spring and the damper of a contact count at one place.
struct ContactWeight {
  double spring, damper;
};

/// Weights at an element's closest point and at its ends.
struct ContactWeights {
  ContactWeight element, a, b;
};

/// Penetrations, m: of the closest point > 0, of the ends at most that, or <= 0 where they do not touch.
inline ContactWeights contact_weights(const kernel::Pair& c, double depth, double depth_a, double depth_b) {
  const bool a_first = depth_a >= depth_b;
  const double ratio = (a_first ? depth_a : depth_b) / depth;
  const double share = ratio > 0 ? ratio * std::sqrt(ratio) : 0.0;  // max(F_a, F_b) / F_e
  return {{1, share < 1 ? 1 - share : 0.0},
          {c.fraction_a - (a_first ? 1 : 0), c.fraction_a},
          {c.fraction_b - (a_first ? 0 : 1), c.fraction_b}};
}

/// How often one contact can load an end node: once where shared nodes are counted once, as its neighbours'
/// contacts there cancel; twice by the paper's rule.
inline double multiplicity(double fraction) { return fraction > 0 ? 1.0 : 2.0; }

/// Share of the stable step that a contact uses on the thread's side; shares 1/kg of the ends.
inline double thread_share(double kappa, double t, double share_a, double share_b) {
  return kappa * ((1 - t) * (1 - t) * share_a + t * t * share_b);
}

/// The same where both ends touch, at their depths. A node's own contact counts there, with its own
/// stiffness; the element has p p^T - e e^T besides, with p = (q, 1 - q) and e = (0, 1), the deeper end
/// second: its greatest eigenvalue is q (sqrt((1 - q)^2 + 1) - (1 - q)). What the deeper end leaves over
/// counts as a contact of its own.
inline double thread_share_of_both(const kernel::Pair& c, double kappa, double t, double depth,
                                   double depth_a, double depth_b, double share_a, double share_b) {
  const double a = std::sqrt(depth_a / depth),
               b = std::sqrt(depth_b / depth);  // stiffness goes with the root
  const double deep = a > b ? a : b, q = a > b ? t : 1 - t;
  const double turning = deep * q * (std::sqrt((1 - q) * (1 - q) + 1) - (1 - q));
  const double at_a = (a + turning / c.fraction_a) * share_a, at_b = (b + turning / c.fraction_b) * share_b;
  return kappa * (at_a > at_b ? at_a : at_b) + thread_share(kappa * (1 - deep), t, share_a, share_b);
}

/// Where a kernel puts the contact forces on nodes, in the order in which nodes take them.
struct LoadWriter {
  kernel::Load* next;

  void add(Index node, V3 force) { *next++ = {node, force.x, force.y, force.z}; }
};

}  // namespace cinch::CINCH_ISA
