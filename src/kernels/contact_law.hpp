// Hunt-Crossley normal contact, eqs. (6)-(9), n = 1.5:
//   F = k_c d^1.5 + lambda d^1.5 dd/dt = k_c d^1.5 (1 + 1.5 alpha dd/dt),   never pulling
// d is the penetration, k_c = 4 / (3 pi) sqrt(r) / (h_1 + h_2), r = r_1 r_2 / (r_1 + r_2), h = (1 - nu^2) /
// (pi E). Potential 2/5 k_c d^2.5; the power (F - k_c d^1.5) dd/dt is dissipated.
//
// Central differences know the rate r of half a step before. The work of the damper D = lambda r in a step is
// that of the mean rate, D (r + r_next)/2 dt; what D r dt lacks, dt/2 D (r_next - r), sums up over a contact
// to
//   dt/4 sum lambda (r_next^2 - r^2) = -dt/4 sum r^2 (dlambda) = -dt^2/4 sum (dlambda/dd) r^3,
// as lambda begins and ends at zero. With that power the ledger is of second order with contacts, too.
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

struct ContactForce {
  double force;       ///< F, N
  double elastic;     ///< k_c d^1.5, N
  double potential;   ///< J
  double stiffness;   ///< dF/dd, N/m
  double damping;     ///< lambda = dF/d(dd/dt), N s/m
  double thickening;  ///< dlambda/dd, N s/m^2; 0 where the contact would pull
};

/// Penetration d > 0 in m, its rate in m/s.
inline ContactForce contact_law(double penetration, double rate, double k_c, double alpha) {
  const double slope = k_c * std::sqrt(penetration);
  const double elastic = slope * penetration;
  const double factor = 1 + 1.5 * alpha * rate;
  const double force = factor > 0 ? elastic * factor : 0.0;
  return {force,
          elastic,
          0.4 * elastic * penetration,
          1.5 * slope * (factor > 0 ? factor : 0.0),
          1.5 * alpha * elastic,
          factor > 0 ? 1.5 * alpha * (1.5 * slope) : 0.0};
}

/// Power that a damper takes, as the head of this file says: with its force in N, dlambda/dd, and the step in
/// s.
inline double damper_power(double damper, double thickening, double rate, double step) {
  return damper * rate - 0.25 * step * thickening * (rate * rate * rate);
}

/// k_c of eq. (7): radii in m, compliances h of eq. (8) in 1/Pa; N/m^1.5.
inline double contact_stiffness(double radius_1, double radius_2, double h_1, double h_2) {
  const double r = radius_1 * radius_2 / (radius_1 + radius_2);
  return 4.0 / (3.0 * 3.14159265358979323846) * std::sqrt(r) / (h_1 + h_2);
}

}  // namespace cinch::CINCH_ISA
