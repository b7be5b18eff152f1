// Tension-only spring and damper of one thread element, eq. (1) with model.md's rule:
//   T = k (l - l0) + c dl/dt  where l > l0, never negative; T = 0 otherwise.
// Positive T pulls the ends together. The damper's power (T - k (l - l0)) dl/dt is what the element
// dissipates.
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

struct Axial {
  double tension;     ///< N
  double per_length;  ///< T / l, N/m: the force on end a is this times (x_b - x_a)
  double power;       ///< dissipated, W
  double energy;      ///< stored, J
};

/// One element from r . r and r . v, r its ends' relative position and v their velocity. Takes and gives
/// plain numbers, as loops over small structs are not vectorised by every compiler.
inline Axial axial_law(double rr, double rv, double k, double c, double l0) {
  const double length = std::sqrt(rr);
  const double taut = length > l0 ? length : l0;  // a slack element may have length zero, l0 is none
  const double inverse = 1.0 / taut;
  const double stretch = taut - l0;
  const double rate = stretch > 0 ? rv * inverse : 0.0;
  const double spring = k * stretch;
  const double pull = spring + c * rate;
  const double tension = pull > 0 ? pull : 0.0;
  return {tension, tension * inverse, (tension - spring) * rate, 0.5 * spring * stretch};
}

}  // namespace cinch::CINCH_ISA
