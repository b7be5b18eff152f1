// Growth: flying square nets of 10^3 to 10^6 knots, one element a mesh side. choose_threads
// (plan/simulation.cpp) takes its break-even from here. Bytes are the traffic that no solver can avoid as
// long as it goes through memory once a step: positions and velocities read and written, 96 bytes a knot; so
// the share of the triad may exceed 1.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "counters.hpp"
#include "resident.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

constexpr double bytes_a_node = 96;

// The same steps in every mode. Threads copy their pieces at both ends of a batch; a run does so as seldom.
std::int64_t batch_of(std::int64_t knots) {
  return std::max<std::int64_t>(knots < 1000 ? 256 : 50, 4'000'000 / (knots * knots));
}

void growth(benchmark::State& state, std::int64_t knots, int threads) {
  const double triad = triad_bytes_per_second(threads);
  static const Simulation first(net_scene(32), 1);  // brings what is made once in a process
  const Scene scene = net_scene(knots);
  const double before = resident_bytes_in_use();
  Simulation simulation(scene, step_by_step(prepare(scene)), threads);
  const double held = resident_bytes() - before;
  const std::int64_t batch = batch_of(knots);
  simulation.advance_to(batch);
  count_handover(state);
  const double begin = clock_seconds();
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const double wall = clock_seconds() - begin;
  const Model& model = simulation.model();
  const double steps = static_cast<double>(state.iterations() * batch);
  const double bytes = steps * bytes_a_node * model.nodes;
  count_updates(state, steps * model.elements);
  count_bytes(state, bytes);
  count_scene(state, model.nodes, model.elements, simulation.threads());
  state.counters["fraction_of_triad"] = bytes / wall / triad;
  state.counters["bytes_per_item"] = held / (model.nodes + model.elements);
}

[[maybe_unused]] const bool registered = [] {
  for (const std::int64_t knots : {32, 56, 100, 178, 316, 562, 1000})
    for (const int threads : thread_counts()) {
      const std::string name = "growth/" + std::to_string(knots * knots) + (knots < 1000 ? "" : "/long");
      benchmark::RegisterBenchmark((name + "/threads:" + std::to_string(threads)).c_str(), growth, knots,
                                   threads)
          ->Iterations(3)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  return true;
}();

}  // namespace
}  // namespace cinch::bench
