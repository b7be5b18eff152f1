// What a run leaves to compare with others: its probes over time, its nodes at the end.
#pragma once
#include <vector>

#include "plan/simulation.hpp"

namespace cinch {

struct RunTrack {
  std::vector<std::vector<double>> probes;  ///< a row for each sample, in the order of probe_columns
  std::vector<std::vector<Vec3>> nodes;     ///< of each part of the assembly, m
};

/// Runs a scene until time.end_s, whatever time.end_when says, and writes no files. Throws what Simulation
/// throws.
RunTrack follow(const Scene& scene, int threads, const Nudge& nudge = {});

}  // namespace cinch
