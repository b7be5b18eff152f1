// One contact of an element (or of its end node alone) with a ring or ball: what both kernels share.
#pragma once
#include "kernels/arguments.hpp"
#include "kernels/contact_law.hpp"

namespace cinch::CINCH_ISA {

inline V3 at(const double* x, const double* y, const double* z, Index i) { return {x[i], y[i], z[i]}; }

inline V3 blend(V3 a, V3 b, double t) { return (1 - t) * a + t * b; }

/// Forces that one candidate puts on its two ends, N.
struct EndLoads {
  V3 a{0, 0, 0}, b{0, 0, 0};
};

/// Share of the stable step that a contact uses: the largest eigenvalue of dt^2/4 K + dt/2 C over M for the
/// contact as an element of its own, coupling the point at t to a host of compliance host_share, with the
/// masses that the thread elements leave over (stable_step.hpp).
inline double step_share(const kernel::ContactArguments& g, const kernel::Candidate& c, double t,
                         double host_share, const ContactForce& law) {
  const double kappa = 0.25 * g.step * g.step * law.stiffness + 0.5 * g.step * law.damping;
  return kappa * ((1 - t) * (1 - t) * g.node_share[c.a] + t * t * g.node_share[c.b] + host_share);
}

}  // namespace cinch::CINCH_ISA
