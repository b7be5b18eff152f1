// Run time of whole steps: each case from a warmed-up state, with one thread and with two.
// minutes_per_simulated_second is the figure that the paper's run times translate into.
#include <benchmark/benchmark.h>

#include "input/case_reader.hpp"
#include "plan/simulation.hpp"

namespace {

using cinch::Override;

// A case in the phase that costs most: closing at once, some thousand steps in.
void step_case(benchmark::State& state, const char* name, const std::vector<Override>& overrides) {
  const auto threads = static_cast<int>(state.range(0));
  const cinch::Scene scene =
      cinch::read_case(std::string(CINCH_SOURCE_DIR "/cases/") + name + ".toml", overrides);
  cinch::Simulation simulation(scene, threads);
  simulation.advance_to(2000);
  constexpr std::int64_t batch = 500;
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const double steps = static_cast<double>(state.iterations() * batch);
  state.counters["element_updates_per_second"] = benchmark::Counter(
      steps * static_cast<double>(simulation.model().elements), benchmark::Counter::kIsRate);
  // simulated seconds x 60 over run time, inverted: run time in minutes over simulated seconds
  state.counters["minutes_per_simulated_second"] = benchmark::Counter(
      steps * simulation.preparation().dt * 60, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["omp_threads"] = threads;
}

void ring_pull(benchmark::State& state) { step_case(state, "ring_pull", {{"time.end_s", "100"}}); }
void edge_closure(benchmark::State& state) { step_case(state, "edge_closure", {{"time.end_s", "100"}}); }
void capture_deployment(benchmark::State& state) {
  step_case(state, "capture", {{"time.end_s", "100"}, {"closing.time_s", "99"}});
}
void capture_closing(benchmark::State& state) {
  step_case(state, "capture", {{"time.end_s", "100"}, {"closing.time_s", "0"}});
}
void large_capture(benchmark::State& state) {
  step_case(state, "large_capture", {{"time.end_s", "1"}, {"closing.time_s", "0"}});
}

BENCHMARK(ring_pull)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(edge_closure)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(capture_deployment)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(capture_closing)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(large_capture)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
