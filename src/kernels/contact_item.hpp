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

/// How often one contact can load an end node: once where shared nodes are taken off (weight > 0): next to
/// the node the neighbours' contacts cancel by inclusion and exclusion. Twice where they are not (the paper's
/// rule; thread ends).
inline double multiplicity(double weight) { return weight > 0 ? 1.0 : 2.0; }

/// Share of the stable step that a contact uses on the thread's side, with the mass that the elements leave
/// over (node_share).
inline double thread_share(const kernel::ContactArguments& g, const kernel::Pair& c, double t, double kappa) {
  return kappa * ((1 - t) * (1 - t) * multiplicity(c.weight_a) * g.node_share[c.a] +
                  t * t * multiplicity(c.weight_b) * g.node_share[c.b]);
}

/// Where a kernel puts the contact forces on nodes, in the order in which nodes take them.
struct LoadWriter {
  kernel::Load* next;

  void add(Index node, V3 force) { *next++ = {node, force.x, force.y, force.z}; }
};

}  // namespace cinch::CINCH_ISA
