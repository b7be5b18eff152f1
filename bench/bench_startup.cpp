// Start-up: from the text of a case until its first step could be taken.
#include <benchmark/benchmark.h>

#include <fstream>
#include <sstream>

#include "counters.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void startup(benchmark::State& state, const std::string& text) {
  for (auto _ : state) {
    const Simulation simulation(parse_case(text, "startup.toml"));
    benchmark::DoNotOptimize(simulation.state().x.data());
    const Model& whole = simulation.preparation().whole();
    count_scene(state, whole.nodes, whole.elements, simulation.threads());
  }
}

void startup_of_case(benchmark::State& state, const char* name) { startup(state, text_of(case_file(name))); }
void startup_of_net(benchmark::State& state, std::int64_t knots) { startup(state, net_text(knots)); }

[[maybe_unused]] const bool registered = [] {
  const auto add = [](const std::string& name, auto run, auto argument) {
    return benchmark::RegisterBenchmark(("startup/" + name).c_str(), run, argument)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  for (const char* name : {"ring_pull", "edge_closure", "capture", "large_capture"}) add(name, startup_of_case, name);
  add("net_1000000/long", startup_of_net, std::int64_t{1000})->Iterations(1);
  return true;
}();

}  // namespace
}  // namespace cinch::bench
