// What a look at a state needs of the machinery that steps it.
#pragma once
#include <vector>

#include "base/aligned.hpp"
#include "kernels/arguments.hpp"

namespace cinch {

/// The forces of one instant, as what the next step would do with them.
struct Glance {
  AlignedVector<double> gain[3];  ///< node: added to vx, vy, vz by a step, supports included, m/s
  AlignedVector<double> elastic;  ///< ledger row x lanes: elastic energy, J
  AlignedVector<double> due;      ///< ledger row x lanes: damper power up to now, W; empty if none is booked
  std::vector<kernel::Load> loads;  ///< contact forces, in the user's numbers
};

}  // namespace cinch
