// A look at a scene at one instant, without touching its motion: velocities at the full step, tensions,
// contact forces, energies.
//
// Positions and velocities are those of the same instant, v(n) = v(n-1/2) + 1/2 (v(n+1/2) - v(n-1/2)): a
// glance at what the next step would do gives the difference.
#pragma once
#include <optional>

#include "base/result.hpp"
#include "plan/stepper.hpp"

namespace cinch {

class Look {
 public:
  /// A pull on one element.
  struct Pull {
    double tension;  ///< N
    double strain;   ///< negative when slack
  };

  /// Looks at `state`, which must not change while the look is used; arrays are kept from look to look.
  /// `half_step` tells whether the velocities lie half a step back (running) or at the state's own time
  /// (start).
  void take(Stepper& stepper, State& state, const Assembly& assembly, bool half_step = true);

  std::int64_t step() const { return state_->step; }
  double time() const { return time_; }  ///< s
  const Assembly& assembly() const { return *assembly_; }
  const Model& model() const { return *model_; }

  /// In the user's numbering; threads that are not there before closing lie on what carries them.
  Vec3 position(Index node) const;       ///< m
  Vec3 velocity(Index node) const;       ///< m/s
  Vec3 gain(Index node) const;           ///< what the next step adds to the velocity, m/s
  Vec3 contact_force(Index node) const;  ///< N
  Pull pull(Index element) const;        ///< zero for elements that are not there yet
  bool present(Index element) const { return element < model_->elements; }
  Vec3 ring_center(Index ring) const;  ///< m
  Vec3 ring_normal(Index ring) const;
  Vec3 ring_force(Index ring) const;  ///< N

  /// Of joint j of `whole`, the model with all that the scene ever has: where its ring lies, at first before
  /// its thread is there, and where the thread goes through it, m.
  Index joint_element(const Model& whole, Index joint) const;
  Vec3 joint_waypoint(const Model& whole, Index joint) const;
  /// What the joints of this model stand at; none of threads that are not there yet.
  const std::vector<kernel::JointState>& joints() const { return state_->joints; }

  std::vector<Vec3> positions() const;
  std::vector<Vec3> ring_centers() const;
  std::vector<Vec3> contact_forces() const;
  double mouth_area() const;  ///< m^2, see scene/mouth.hpp; computed once

  /// Stored and dissipated; what the simulation books is zero here.
  const Energies& energy() const { return energy_; }
  std::size_t memory() const;  ///< bytes, see memory.hpp

 private:
  Vec3 speed(Index node) const;
  void sum_energies();
  /// The first ring that lies in an element, or null.
  const kernel::JointState* joint_in(Index element) const;

  const Model* model_ = nullptr;
  const State* state_ = nullptr;
  const Assembly* assembly_ = nullptr;
  double time_ = 0, share_ = 0, dt_ = 0;
  Glance glance_;
  Energies energy_;
  mutable std::optional<double> mouth_area_;
};

/// Sum of each term of the ledger that the kernels keep, J.
double dissipated_by_dampers(const State& state, double dt);
double dissipated_by_contacts(const State& state);
double couple_work(const State& state);

}  // namespace cinch
