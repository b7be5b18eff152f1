// Hunt-Crossley normal contact, eqs. (6)-(9), n = 1.5:
//   F = k_c d^1.5 + lambda d^1.5 dd/dt = k_c d^1.5 (1 + 1.5 alpha dd/dt),   never pulling
// d is the penetration, k_c = 4 / (3 pi) sqrt(r) / (h_1 + h_2), r = r_1 r_2 / (r_1 + r_2), h = (1 - nu^2) /
// (pi E). Potential 2/5 k_c d^2.5; the power (F - k_c d^1.5) dd/dt is dissipated.
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

struct ContactForce {
  double force;      ///< F, N
  double elastic;    ///< k_c d^1.5, N
  double potential;  ///< J
  double stiffness;  ///< dF/dd, N/m
  double damping;    ///< dF/d(dd/dt), N s/m
};

/// Penetration d > 0 in m, its rate in m/s.
inline ContactForce contact_law(double penetration, double rate, double k_c, double alpha) {
  const double slope = k_c * std::sqrt(penetration);
  const double elastic = slope * penetration;
  const double factor = 1 + 1.5 * alpha * rate;
  const double force = factor > 0 ? elastic * factor : 0.0;
  return {force, elastic, 0.4 * elastic * penetration, 1.5 * slope * (factor > 0 ? factor : 0.0),
          1.5 * alpha * elastic};
}

/// k_c of eq. (7): radii in m, compliances h of eq. (8) in 1/Pa; N/m^1.5.
inline double contact_stiffness(double radius_1, double radius_2, double h_1, double h_2) {
  const double r = radius_1 * radius_2 / (radius_1 + radius_2);
  return 4.0 / (3.0 * 3.14159265358979323846) * std::sqrt(r) / (h_1 + h_2);
}

}  // namespace cinch::CINCH_ISA
