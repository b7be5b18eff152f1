// Output: what a run leaves behind, and the page that is made of it.
#include <benchmark/benchmark.h>

#include "counters.hpp"
#include "output/recorder.hpp"
#include "output/result_reader.hpp"
#include "report/report.hpp"
#include "scenes.hpp"
#include "temporary_folder.hpp"

namespace cinch::bench {
namespace {

constexpr int frames = 20, rows_a_frame = 200;  // as capture has them

/// Capture at its start, recorded over and over.
class Recorded {
 public:
  Recorded() : simulation_(read_case(case_file("capture"))), frame_(simulation_.frame()) {}
  Recorder open(const TemporaryFolder& folder) {
    return Recorder(folder.path(), simulation_.result_model(), {});
  }
  void frame(Recorder& recorder) {
    frame_.time += 0.02;
    frame_.step += 20000;
    recorder.frame(frame_);
  }
  void run(const TemporaryFolder& folder) {
    Recorder recorder = open(folder);
    const std::vector<double> row(simulation_.probe_columns().size(), 1.0);
    for (int f = 0; f < frames; ++f) {
      for (int r = 0; r < rows_a_frame; ++r) recorder.probes(frame_.time + 1e-4 * r, row);
      frame(recorder);
    }
    Summary summary = simulation_.summary();
    summary.status = "done";
    recorder.finish(summary);
  }

 private:
  Simulation simulation_;
  Frame frame_;
};

void one_frame(benchmark::State& state) {
  const TemporaryFolder folder;
  Recorded recorded;
  Recorder recorder = recorded.open(folder);
  recorded.frame(recorder);
  const double before = folder.bytes();
  for (auto _ : state) recorded.frame(recorder);
  count_bytes(state, folder.bytes() - before);
}

void short_run(benchmark::State& state) {
  const TemporaryFolder folder;
  Recorded recorded;
  for (auto _ : state) recorded.run(folder);
  count_bytes(state, static_cast<double>(state.iterations()) * folder.bytes());
}

void report(benchmark::State& state) {
  const TemporaryFolder folder;
  Recorded().run(folder);
  const std::filesystem::path page = folder.path() / "report.html";
  for (auto _ : state) {
    std::vector<Result> results;
    results.emplace_back(folder.path());
    write_report(results, page);
  }
  count_bytes(
      state, static_cast<double>(state.iterations()) * static_cast<double>(std::filesystem::file_size(page)));
}

BENCHMARK(one_frame)->Name("output/frame")->Iterations(100)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(short_run)
    ->Name("output/run_of_20_frames")
    ->Iterations(5)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(report)->Name("output/report")->Iterations(3)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cinch::bench
