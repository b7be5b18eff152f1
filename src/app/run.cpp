// `cinch run`: a case file becomes a folder of results.
#include <omp.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/signals.hpp"
#include "base/error.hpp"
#include "output/recorder.hpp"
#include "output/result_reader.hpp"
#include "plan/simulation.hpp"
#include "report/report.hpp"

namespace cinch::app {
namespace {

namespace fs = std::filesystem;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string host_name() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

// Steps at which something is due: the k-th is the one nearest to k times the interval.
class Schedule {
 public:
  Schedule(double interval, double dt) : interval_(interval), dt_(dt) {}
  std::int64_t next() const { return std::llround(static_cast<double>(count_) * interval_ / dt_); }
  bool due(std::int64_t step) {
    if (step < next()) return false;
    while (next() <= step) ++count_;
    return true;
  }

 private:
  double interval_, dt_;
  std::int64_t count_ = 0;
};

// Never writes into a result that is already there, unless asked to.
fs::path result_folder(const RunArguments& arguments, const std::string& case_name) {
  const auto taken = [](const fs::path& folder) { return fs::exists(folder / "run.vtkhdf"); };
  if (!arguments.out.empty()) {
    if (taken(arguments.out) && !arguments.overwrite)
      throw FileError("error: " + arguments.out.string() +
                      " holds a result already; give another --out, or --overwrite to replace it");
    return arguments.out;
  }
  const fs::path base = fs::path("results") / case_name;
  if (arguments.overwrite || !taken(base)) return base;
  for (int k = 2;; ++k)
    if (const fs::path next = base.string() + "-" + std::to_string(k); !taken(next)) return next;
}

// One run: the loop over what is due, and the clocks.
class Run {
 public:
  Run(const Scene& scene, int threads, const fs::path& folder, bool quiet)
      : simulation_(scene, threads),
        recorder_(folder, simulation_.result_model(), scene.output.compress),
        frames_(scene.output.frame_interval, simulation_.preparation().dt),
        probes_(scene.output.probe_interval > 0 ? scene.output.probe_interval : scene.output.frame_interval,
                simulation_.preparation().dt),
        progress_(scene.time.end, quiet),
        begin_(now()) {}

  Summary go() {
    std::string status = "done", message;
    const std::int64_t end = simulation_.preparation().end_step;
    try {
      record();
      while (simulation_.step() < end && stop_signal() == 0) {
        simulation_.advance_to(next_stop(end));
        record();
        progress_.update(simulation_.time(), simulation_.step());
      }
    } catch (const NumericalError& error) {  // the frames so far and what led there are kept
      status = "failed";
      message = error.what();
    }
    if (stop_signal() != 0) status = stop_signal() == SIGTERM ? "terminated" : "interrupted";
    if (status != "failed") record_frame();
    progress_.finish();
    return finish(status, message);
  }

 private:
  static constexpr std::int64_t longest_stretch = 20000;  ///< steps between two looks at signals

  std::int64_t next_stop(std::int64_t end) const {
    return std::min({end, frames_.next(), probes_.next(), simulation_.step() + longest_stretch});
  }

  void record() {
    const std::int64_t step = simulation_.step();
    const bool frame_due = frames_.due(step), probe_due = probes_.due(step);
    if (!frame_due && !probe_due) return;
    const double t0 = now();
    const Look& look = simulation_.look();
    if (probe_due) {
      simulation_.note_events(look);
      const std::vector<double> row = simulation_.probe_row(look);
      observing_ += now() - t0;
      recorder_.probes(look.time(), row);
    }
    if (frame_due) write(simulation_.frame(look));
    simulation_.check_energy(look);  // what showed it is kept
  }

  void record_frame() {
    if (simulation_.step() != last_frame_) write(simulation_.frame());
  }

  void write(const Frame& frame) {
    const double t0 = now();
    recorder_.frame(frame);
    last_frame_ = frame.step;
    writing_ += now() - t0;
  }

  Summary finish(const std::string& status, const std::string& message) {
    Summary summary = simulation_.summary();
    summary.status = status;
    summary.message = message;
    summary.host = host_name();
    summary.wall_seconds = now() - begin_;
    for (StageTime& stage : summary.stages) {
      if (stage.name == stage_name(StageId::observe)) stage.seconds = observing_;
      if (stage.name == stage_name(StageId::output)) stage.seconds = writing_;
    }
    recorder_.finish(summary);
    return summary;
  }

  Simulation simulation_;
  Recorder recorder_;
  Schedule frames_, probes_;
  Progress progress_;
  double begin_, observing_ = 0, writing_ = 0;
  std::int64_t last_frame_ = -1;
};

int exit_code(const Summary& summary) {
  if (summary.status == "failed") return static_cast<int>(ExitCode::numerical);
  if (summary.status == "interrupted") return static_cast<int>(ExitCode::interrupted);
  if (summary.status == "terminated") return static_cast<int>(ExitCode::terminated);
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int run(const RunArguments& arguments) {
  const Scene scene = read_case(arguments.scene.file, arguments.scene.overrides);
  const fs::path folder = result_folder(arguments, scene.name);
  watch_signals();
  Run one(scene, arguments.scene.threads, folder, arguments.quiet);
  const Summary summary = one.go();
  if (!summary.message.empty()) std::cerr << summary.message << "\n";
  for (const std::string& warning : summary.warnings) std::cerr << "warning: " << warning << "\n";
  if (!arguments.quiet) print_verdict(Result(folder), std::cout);
  std::cout << "results: " << folder.string() << "\n";
  return exit_code(summary);
}

}  // namespace cinch::app
