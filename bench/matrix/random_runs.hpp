// Random scenes under watch: the search for a run that goes wrong and does not tell.
#pragma once
#include "cell.hpp"

namespace cinch::matrix {

/// Runs so many scenes with rings, joints, a ball, gravity and random speeds and steps. Failed, with its
/// seed, where one is neither held nor stopped.
Outcome random_runs(int count);

}  // namespace cinch::matrix
