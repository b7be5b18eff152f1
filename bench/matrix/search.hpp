// Random search for scenes in which the stable step is optimistic.
#pragma once
#include "draw.hpp"

namespace cinch::matrix {

struct Found {
  int trials = 0, counter_examples = 0;
  double worst = 0;   ///< greatest usage of the step that the solver calls stable; above one it is not
  unsigned seed = 0;  ///< of that scene
};

/// Draws as many scenes as told, each from a seed of its own.
Found search(Family family, int trials);

}  // namespace cinch::matrix
