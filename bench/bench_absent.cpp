// What a feature costs a scene that lacks it: the solver beside a program stripped by hand (stripped.hpp), in
// time. bench/count counts the instructions of both.
#include <benchmark/benchmark.h>

#include "absent.hpp"
#include "counters.hpp"

namespace cinch::bench {
namespace {

constexpr std::int64_t batch = 500;

void solver(benchmark::State& state, const Features& has) {
  const Scene scene = net_scene(absent_knots, has);
  Simulation simulation(scene, step_by_step(prepare(scene)), 1);
  simulation.advance_to(batch);
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  count_updates(state, static_cast<double>(state.iterations() * batch * simulation.model().elements));
}

void stripped(benchmark::State& state, const Features& has) {
  StrippedNet net(has);
  net.advance(batch);
  for (auto _ : state) {
    net.advance(batch);
    benchmark::ClobberMemory();
  }
  count_updates(state, static_cast<double>(state.iterations() * batch * net.elements()));
}

[[maybe_unused]] const bool registered = [] {
  for (const AbsentFeature& feature : absent_features()) {
    const std::string name = "absent/" + feature.name;
    benchmark::RegisterBenchmark((name + "/with").c_str(), solver, feature.has);
    benchmark::RegisterBenchmark((name + "/without").c_str(), stripped, feature.has);
  }
  return true;
}();

}  // namespace
}  // namespace cinch::bench
