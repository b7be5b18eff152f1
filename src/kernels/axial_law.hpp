// Tension-only spring and damper of one thread element, eq. (1) with model.md's rule:
//   T = S + c dl/dt,   S = k s,   s = l - l0,   where l > l0, never negative; T = 0 otherwise.
// Positive T pulls the ends together. The damper's force is T - S, and its power (T - S) dl/dt is what the
// element dissipates.
//
// Central differences change the energy where an element turns taut or slack within a step. From l0 + s - h
// to l0 + s at the rate h/dt, half of each end's force does the work (0 + k s) h/2, but k s^2/2 is stored: k
// s (h - s)/2 is lost whenever an element turns taut, and won whenever it turns slack. Damped threads turn
// slack more slowly than taut and lose, undamped ones blow up far below the linear bound. Where s < h the
// spring therefore pulls with
//   S = k s (1 + s/h)/2,   h = |dl/dt| dt.
// Both steps beside it then do the work S h in place of k s h, which makes up for that: at a constant rate no
// energy is lost or won. S is continuous, and k s for smaller steps.
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

struct Axial {
  double tension;     ///< N
  double per_length;  ///< T / l, N/m: the force on end a is this times (x_b - x_a)
  double rate;        ///< dl/dt, m/s; of a slack element l/l0 times that
  double damper;      ///< T - S, N
  double energy;      ///< stored, J
  double spare;       ///< s - h of a taut element, m: below zero it turns taut or slack about now
};

/// S for the stretch s >= 0; h as above. Where s >= h it is k s to the last bit: no branch is needed.
inline double spring_at_switch(double k, double stretch, double h) {
  const double longer = h > stretch ? h : stretch;
  return k * stretch * (0.5 * (1.0 + stretch / (longer > 0 ? longer : 1.0)));
}

/// One element from r . r and r . v, r its ends' relative position and v their velocity, in steps of dt.
/// Where `switching` is false, S = k s. Takes and gives plain numbers, as loops over small structs are not
/// vectorised by every compiler.
template <bool switching = true>
inline Axial axial_law(double rr, double rv, double k, double c, double l0, double dt) {
  const double length = std::sqrt(rr);
  const double taut = length > l0 ? length : l0;  // a slack element may have length zero, l0 is none
  const double inverse = 1.0 / taut;
  const double stretch = taut - l0;
  const double rate = rv * inverse, h = std::fabs(rate) * dt;
  const double spare = stretch > 0 ? stretch - h : 0.0;
  const double spring = switching ? spring_at_switch(k, stretch, h) : k * stretch;
  const double pull = spring + (stretch > 0 ? c * rate : 0.0);
  const double tension = pull > 0 ? pull : 0.0;
  return {tension, tension * inverse, rate, tension - spring, 0.5 * k * stretch * stretch, spare};
}

}  // namespace cinch::CINCH_ISA
