// Everything that changes while a scene is stepped.
#pragma once
#include <cstdint>
#include <vector>

#include "store/model.hpp"

namespace cinch {

constexpr Index ball_chunk =
    32;  ///< candidates on a ball that share one tally; depends on nothing but the list

struct State {
  std::int64_t step = 0;  ///< positions are those of time step * dt, velocities of half a step earlier

  AlignedVector<double> x, y, z;     ///< node, m
  AlignedVector<double> vx, vy, vz;  ///< node, m/s, at (step - 1/2) dt

  AlignedVector<double> dissipated;                   ///< element block x lanes, J: by the elements' dampers
  std::vector<kernel::RingTally> rings;               ///< ring
  std::vector<std::vector<kernel::BallTally>> balls;  ///< ball, chunk of candidates
  std::vector<kernel::Reaction> reactions;            ///< constraint

  /// Allocates for `model`; all zero, tallies as never touched.
  explicit State(const Model& model);
  State() = default;
};

/// A state as the assembly describes it at t = 0 (velocities not yet half a step back).
State initial_state(const Model& model, const Assembly& assembly);

}  // namespace cinch
