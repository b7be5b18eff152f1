// The element update (spring, damper, reduction to nodes, integration) of one chain without contact, beside
// its yardstick, and of a small net. Time an element and step is the inverse of element_updates_per_second.
#include <benchmark/benchmark.h>

#include "bare_chain.hpp"
#include "counters.hpp"
#include "processor_time.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

constexpr std::int64_t batch = 500;  // steps between two readings of the clock

double updates(const benchmark::State& state) {
  return static_cast<double>(state.iterations() * batch * state.range(0));
}

void bare(benchmark::State& state) {
  BareChain chain(state.range(0));
  for (auto _ : state) {
    chain.advance(batch);
    benchmark::DoNotOptimize(chain.places());
    benchmark::ClobberMemory();
  }
  count_updates(state, updates(state));
}

// The yardstick is measured right before and after: the machine may be slower at other times than these.
void solver(benchmark::State& state, bool ledger) {
  const Scene scene = chain_scene(state.range(0), ledger);
  Simulation simulation(scene, step_by_step(prepare(scene)), 1);
  simulation.advance_to(batch);
  const double before = bare_rate(state.range(0)), begin = thread_seconds();
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const double rate = updates(state) / (thread_seconds() - begin), after = bare_rate(state.range(0));
  count_updates(state, updates(state));
  state.counters["fraction_of_yardstick"] = rate / (0.5 * (before + after));
}

void chain(benchmark::State& state) { solver(state, false); }
void chain_with_ledger(benchmark::State& state) { solver(state, true); }

// Mesh sides of several elements: short runs of elements in place of long ones.
void peers_net(benchmark::State& state, bool with_threads) {
  const Scene scene = peers_net_scene(with_threads);
  Simulation simulation(scene, step_by_step(prepare(scene)), 1);
  simulation.advance_to(batch);
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const double steps = static_cast<double>(state.iterations() * batch);
  const Model& model = simulation.model();
  count_updates(state, steps * model.elements);
  count_scene(state, model.nodes, model.elements, 1);
  count_simulated(state, steps * simulation.stepper().plan().dt);
}

BENCHMARK(bare)->Name("element/bare")->Arg(200)->Arg(2000);
BENCHMARK(chain)->Name("element/chain")->Arg(200)->Arg(2000);
BENCHMARK_CAPTURE(peers_net, alone, false)->Name("element/net_of_781_nodes");
BENCHMARK_CAPTURE(peers_net, with_threads, true)->Name("element/net_of_1737_nodes");
BENCHMARK(chain_with_ledger)->Name("element/chain_with_ledger")->Arg(200)->Arg(2000);

}  // namespace
}  // namespace cinch::bench
