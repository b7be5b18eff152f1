// The books of a run: energy from the start to now, and momentum less what the outside has put in.
//
//   initial = kinetic + elastic + contact + gravity + dissipated - work put in + booked terms + residual
// Gravity counts from its value at the start. The residual is taken relative to the largest of: the initial
// energy, the work put in by separations, and the greatest change of gravitational energy (gravity's work).
#pragma once
#include "base/archive.hpp"
#include "plan/look.hpp"

namespace cinch {

struct Momentum {
  Vec3 linear = Vec3::Zero();   ///< kg m/s
  Vec3 angular = Vec3::Zero();  ///< kg m^2/s about the origin
};

/// Momentum of a state at its half-step velocities, about the origin: central differences keep both exactly
/// but for rounding, with x(n) x v(n-1/2) as angular momentum.
Momentum half_step_momentum(const Model& model, const State& state);

/// Impulses that supports and targets have given, and the torque impulse that `paper` rings have dropped.
Momentum outside_impulse(const State& state);

class Ledger {
 public:
  /// Opens the books with the state at t = 0; `work` has been put in just before (separation at t = 0), J.
  void open(const Energies& start, const Model& model, const State& state, double work);
  /// Books the laying of the closing threads and the separation: three looks at the same instant.
  void book_closing(const Energies& before, const State& state_before, const Energies& laid,
                    const Energies& separated, const State& state_after, const Model& model_before,
                    const Model& model_after);
  /// Impulse that supports gave when they stopped a node at the closing time; or that what acts from outside
  /// gave between two instants half a step back, where the step changes.
  void book_outside(const Momentum& impulse);
  /// All terms at the time of a look that saw `now`.
  Energies energies(const Energies& now);

  double initial() const { return initial_; }
  double scale() const;
  /// Change of momentum that nothing accounts for.
  Momentum drift(const Model& model, const State& state, double time) const;
  /// Saves or restores the books.
  void transfer(Archive& archive);

 private:
  double initial_ = 0, gravity_zero_ = 0, gravity_change_ = 0;
  double work_ = 0, booked_activation_ = 0;
  double carried_damper_ = 0;  ///< J, of the phase before closing
  Momentum start_, carried_outside_, booked_;
};

}  // namespace cinch
