// The force reduction: the ways of force_sums.hpp, and the solver on the same net, whose kernels do more
// (dampers that switch, whole steps) and whose structure spares the index arrays.
#include <benchmark/benchmark.h>

#include "counters.hpp"
#include "force_sums.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

std::int64_t batch_of(std::int64_t knots) { return 400'000 / (knots * knots); }

void reduction(benchmark::State& state, SumWay way, std::int64_t knots, int threads) {
  SummedNet net(knots, way, threads);
  const std::int64_t batch = batch_of(knots);
  net.advance(batch);
  for (auto _ : state) net.advance(batch);
  count_updates(state, static_cast<double>(state.iterations() * batch * net.elements()));
  count_scene(state, net.nodes(), net.elements(), threads);
}

void solver(benchmark::State& state, std::int64_t knots, int threads) {
  const Scene scene = net_scene(knots, {.ledger = false});
  Simulation simulation(scene, step_by_step(prepare(scene)), threads);
  const std::int64_t batch = batch_of(knots);
  simulation.advance_to(batch);
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const Model& model = simulation.model();
  count_updates(state, static_cast<double>(state.iterations() * batch * model.elements));
  count_scene(state, model.nodes, model.elements, threads);
}

template <class Run, class... Arguments>
void add(const std::string& way, std::int64_t knots, int threads, Run run, Arguments... arguments) {
  benchmark::RegisterBenchmark(
      ("reduction/" + way + "/" + std::to_string(knots * knots) + "/threads:" + std::to_string(threads))
          .c_str(),
      run, arguments..., knots, threads)
      ->Iterations(10)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool registered = [] {
  for (const std::int64_t knots : {32, 316})
    for (const int threads : thread_counts()) {
      add("gather", knots, threads, reduction, SumWay::gather);
      add("coloured_scatter", knots, threads, reduction, SumWay::coloured_scatter);
      add("private_sums", knots, threads, reduction, SumWay::private_sums);
      add("solver", knots, threads, solver);
    }
  return true;
}();

}  // namespace
}  // namespace cinch::bench
