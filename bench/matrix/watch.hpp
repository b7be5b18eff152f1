// Runs a scene under books of its own, kept apart from the solver's ledger.
#pragma once
#include "cell.hpp"
#include "plan/simulation.hpp"

namespace cinch::matrix {

struct Watch {
  std::int64_t steps = 20000;
  int looks = 50;  ///< spread evenly; each checks the energy as `cinch run` does at frames
  int threads = 1;
};

using SceneMaker = std::function<Scene()>;

/// Held: all numbers finite, no more energy than began or was put in, dissipation never negative. Stopped: by
/// an error of the case, or by a numerical one that tells item, time and likely cause. Failed: all else.
Outcome watch(const SceneMaker& make, const Watch& how);

/// What is wrong with the message of a numerical error, or nothing.
std::string flaw_of_message(const std::string& message);

}  // namespace cinch::matrix
