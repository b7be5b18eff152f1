// Growth: a flying square net of n x n meshes, with one thread and with two. choose_threads
// (plan/simulation.cpp) takes its break-even from here.
#include <benchmark/benchmark.h>

#include "input/case_reader.hpp"
#include "plan/simulation.hpp"

namespace {

constexpr const char* net_case = R"(schema = 1
[time]
end_s = 100
step_s = 1e-6
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [1, 1]
mesh_m = 0.1
velocity_m_s = [0, 0, 1]
)";

void net(benchmark::State& state) {
  const double side = 0.1 * static_cast<double>(state.range(0));
  const std::string size = "[" + std::to_string(side) + ", " + std::to_string(side) + "]";
  const cinch::Scene scene = cinch::parse_case(net_case, "net.toml", {{"net.main.size_m", size}});
  const auto threads = static_cast<int>(state.range(1));
  cinch::Simulation simulation(scene, threads);
  simulation.advance_to(100);
  const std::int64_t batch = std::max<std::int64_t>(1, 1000000 / simulation.model().elements);
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const double updates =
      static_cast<double>(state.iterations() * batch) * static_cast<double>(simulation.model().elements);
  state.counters["elements"] = static_cast<double>(simulation.model().elements);
  state.counters["element_updates_per_second"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  state.counters["omp_threads"] = threads;
}

BENCHMARK(net)
    ->ArgsProduct({{10, 20, 40, 80, 160, 320}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
