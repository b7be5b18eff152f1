// The counters that bench/dashboard.py reads, under its names.
#pragma once
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

#include "machine_speed.hpp"
#include "plan/simulation.hpp"

namespace cinch::bench {

/// `updates`: elements x steps of the whole measurement.
inline void count_updates(benchmark::State& state, double updates) {
  state.counters["element_updates_per_second"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
}

/// `bytes` of the whole measurement.
inline void count_bytes(benchmark::State& state, double bytes) {
  state.counters["bytes_per_second"] = benchmark::Counter(bytes, benchmark::Counter::kIsRate);
}

inline void count_scene(benchmark::State& state, Index nodes, Index elements, int threads) {
  state.counters["nodes"] = nodes;
  state.counters["elements"] = elements;
  state.counters["omp_threads"] = threads;
}

/// `seconds` of the whole measurement, in the scene's own time.
inline void count_simulated(benchmark::State& state, double seconds) {
  state.counters["minutes_per_simulated_second"] =
      benchmark::Counter(60 * seconds, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// `steps` of the whole measurement, of which `flown` many at once (plan/free_flight.hpp): only where next to
/// none are does a step's length say what elements and threads cost.
inline void count_steps(benchmark::State& state, const Model& model, double steps, double flown) {
  state.counters["steps_per_second"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
  state.counters["flown_share"] = flown / steps;
  if (flown < 0.01 * steps) count_updates(state, steps * model.elements);
}

/// What the state has come to: the same for any number of threads. The page compares it.
inline void tell_bits(benchmark::State& state, std::uint64_t state_hash) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(state_hash));
  state.SetLabel(text);
}

/// Stages of the step's own clock as shares of the `wall` seconds they were measured in. That clock samples,
/// so a short measurement may add up to more than there was.
inline void count_shares(benchmark::State& state, const StageSeconds& seconds, double wall) {
  double sum = 0;
  for (const double stage : seconds) sum += stage;
  for (std::size_t s = 0; s < stage_count; ++s) {
    std::string name = stage_name(static_cast<StageId>(s));
    std::replace(name.begin(), name.end(), ' ', '_');
    state.counters["share_" + name] = seconds[s] / std::max(wall, sum);
  }
}

/// Virtual machines move between states within minutes, so the hand-over is measured beside each figure that
/// it explains.
inline void count_handover(benchmark::State& state) {
  if (const double ns = handover_ns(); ns > 0) state.counters["handover_ns"] = ns;
}

}  // namespace cinch::bench
