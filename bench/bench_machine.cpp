// The machine's own limits: memory bandwidth and the time that threads take to hand over.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "counters.hpp"

namespace cinch::bench {
namespace {

void triad(benchmark::State& state, int threads) {
  Triad arrays(threads);
  for (auto _ : state) arrays.pass();
  count_bytes(state, static_cast<double>(state.iterations()) * arrays.bytes());
  state.counters["omp_threads"] = threads;
}

void handover(benchmark::State& state) {
  std::vector<double> ns;
  for (auto _ : state) ns.push_back(handover_ns());
  std::nth_element(ns.begin(), ns.begin() + static_cast<std::ptrdiff_t>(ns.size() / 2), ns.end());
  state.counters["handover_ns"] = ns[ns.size() / 2];
  if (ns.front() <= 0) state.SkipWithError("there is only one core");
}

[[maybe_unused]] const bool registered = [] {
  for (const int threads : thread_counts())
    benchmark::RegisterBenchmark(("machine/triad/threads:" + std::to_string(threads)).c_str(), triad, threads)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("machine/handover", handover)->UseRealTime()->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace cinch::bench
