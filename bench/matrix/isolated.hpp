// Runs something in a process of its own, so that a crash or a run without end is a verdict as well.
#pragma once
#include "cell.hpp"

namespace cinch::matrix {

/// What `run` gives; a failed outcome where it crashes, or is not done after so many seconds.
Outcome isolated(const std::function<Outcome()>& run, int seconds);

}  // namespace cinch::matrix
