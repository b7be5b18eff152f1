// Looks at a state without touching its motion: velocities at the full step, tensions, contact forces,
// energies, momenta.
//
// Plain loops over the user's elements, independent of the kernels' gather: positions and velocities are
// those of the same instant, v(n) = v(n-1/2) + dt/2 a(n).
#pragma once
#include <vector>

#include "base/result.hpp"
#include "plan/stepper.hpp"

namespace cinch {

struct Momentum {
  Vec3 linear = Vec3::Zero();   ///< kg m/s
  Vec3 angular = Vec3::Zero();  ///< kg m^2/s about the origin
};

struct Observation {
  double time = 0;                                         ///< s
  std::vector<Vec3> position, velocity;                    ///< node, m, m/s
  std::vector<Vec3> acceleration;                          ///< node, m/s^2, supports included
  std::vector<Vec3> contact_force;                         ///< node, N
  std::vector<double> tension, strain;                     ///< element in the user's numbering, N, -
  std::vector<Vec3> ring_center, ring_normal, ring_force;  ///< ring, m, -, N
  Energies energy;  ///< stored and dissipated terms; what the simulation books is zero here
  Momentum momentum;
};

/// `half_step` tells whether the state's velocities lie half a step back (running) or at the state's own time
/// (start).
Observation observe(Stepper& stepper, State& state, bool half_step = true);

/// Sum of each term of the ledger that the kernels keep, J.
double dissipated_by_dampers(const State& state, double dt);
double dissipated_by_contacts(const State& state);
double couple_work(const State& state);

}  // namespace cinch
