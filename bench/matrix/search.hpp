// Random search for scenes in which the stable step is optimistic.
#pragma once
#include <string>
#include <vector>

#include "store/model.hpp"

namespace cinch::matrix {

/// What to draw: masses, stiffnesses, dampers and places at random.
enum class Family {
  graph,     ///< any nodes joined by any elements, over six decades
  chain,     ///< threads end to end
  junction,  ///< threads from one knot
  net        ///< a net with masses, supports, rings and a tether
};

struct Found {
  int trials = 0, counter_examples = 0;
  double worst = 0;   ///< greatest usage of the step that the solver calls stable; above one it is not
  unsigned seed = 0;  ///< of that scene
};

/// Draws as many scenes as told, each from a seed of its own.
Found search(Family family, int trials);

std::string name(Family family);

}  // namespace cinch::matrix
