// Everything that changes while a scene is stepped.
#pragma once
#include <cstdint>
#include <vector>

#include "store/model.hpp"

namespace cinch {

/// Forces of sliding joints that hold for some steps, in the user's numbers.
struct HeldLoads {
  std::vector<kernel::Load> loads;          ///< joint x kernel::joint_loads, of which are used:
  std::vector<kernel::SlidingLoads> count;  ///< sliding thread: so many on its nodes and on hosts

  HeldLoads() = default;
  explicit HeldLoads(const Model& model);
  /// Those of a thread that has the joints [begin, end): at most as many as there is room for.
  kernel::Load* on_threads(Index begin) { return loads.data() + kernel::joint_loads * begin; }
  kernel::Load* on_hosts(Index begin, Index end) {
    return on_threads(begin) + kernel::joint_thread_loads * (end - begin);
  }
};

struct State {
  std::int64_t step =
      0;  ///< positions are those of its time (plan/timeline.hpp), velocities of half a step earlier

  AlignedVector<double> x, y, z;     ///< node, m
  AlignedVector<double> vx, vy, vz;  ///< node, m/s, half a step earlier

  AlignedVector<double> dissipated;      ///< ledger row x lanes, W: damper power summed over the steps
  std::vector<kernel::RingTally> rings;  ///< ring
  std::vector<std::vector<kernel::BallTally>>
      balls;                                ///< ball: of pairs that are over, then of each present pair
  std::vector<kernel::JointState> joints;   ///< joint
  HeldLoads held;                           ///< of the joints
  std::vector<kernel::Reaction> reactions;  ///< constraint

  /// Allocates for `model`; all zero, tallies as never touched.
  explicit State(const Model& model);
  State() = default;
};

/// Turns velocities of -0 into +0.
void drop_negative_zeros(State& state);

/// A state as the assembly describes it at t = 0 (velocities not yet half a step back).
State initial_state(const Model& model, const Assembly& assembly);

}  // namespace cinch
