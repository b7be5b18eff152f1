// `cinch run`: a case file becomes a folder of results.
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <optional>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/resources.hpp"
#include "app/restart.hpp"
#include "app/result_folder.hpp"
#include "app/schedule.hpp"
#include "app/signals.hpp"
#include "base/error.hpp"
#include "output/folder_lock.hpp"
#include "output/recorder.hpp"
#include "output/result_reader.hpp"
#include "plan/case_warnings.hpp"
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

// One run: the loop over what is due, and the clocks.
class Run {
 public:
  // `from`: what it goes on from, or null.
  Run(const Scene& scene, int threads, ResultFolder& folder, bool quiet, Restart* from)
      : scene_(scene),
        folder_(folder),
        begin_(now()),
        account_(account_of(from)),
        before_(account_.run_time),
        simulation_(simulate(scene, threads, from)),
        recorder_(record_in(folder_, scene, simulation_, account_, from)),
        frames_(scene.output.frame_interval, simulation_.preparation().timeline),
        probes_(scene.output.sample_interval(), simulation_.preparation().timeline),
        checkpoints_(scene.output.checkpoint_interval, simulation_.preparation().timeline),
        progress_(scene.time.end, quiet, simulation_.time(), simulation_.step()),
        last_checkpoint_(now()) {
    checkpoints_.due(simulation_.step());
    if (from == nullptr) return;
    frames_.due(simulation_.step());
    probes_.due(simulation_.step());
    if (account_.frames > 0)  // it is there already, should this stop before its first step
      last_frame_ = from->earlier().frame_steps().at(static_cast<std::size_t>(account_.frames) - 1);
  }

  void warn() const {
    for (const std::string& warning : case_warnings(scene_, simulation_.preparation()))
      std::cerr << warning << "\n";
  }

  Summary go() {
    std::string status = "done", message;
    try {
      record();
      while (simulation_.step() < simulation_.end_step() && stop_signal() == 0) {
        advance(simulation_.end_step());
        record();
        if (keep_is_due()) keep_sound();
        recorder_.catch_up();
        progress_.update(simulation_.time(), simulation_.step());
      }
      if (stop_signal() != 0) require_sound();
    } catch (const NumericalError& error) {  // the frames so far and what led there are kept
      status = "failed";
      message = error.what();
    }
    if (status == "done" && stop_signal() != 0)
      status = stop_signal() == SIGTERM ? "terminated" : "interrupted";
    if (status != "failed" && scene_.output.checkpoint) keep();
    record_last_frame();
    progress_.finish();
    return finish(status, message);
  }

  /// Whether a restart could go on from where it has stopped, as far as the case asks for that.
  bool kept() const { return kept_; }
  /// The warning that has been told already, or empty.
  const std::string& not_kept() const { return not_kept_; }

 private:
  static Account account_of(Restart* from) {
    Account account;
    if (from != nullptr) account.transfer(from->archive());
    if (account.run_id.empty()) account.run_id = new_run_id();
    return account;
  }
  static Simulation simulate(const Scene& scene, int threads, Restart* from) {
    if (from == nullptr) return Simulation(scene, threads);
    return Simulation(scene, prepare(scene), threads, from->archive());
  }
  static Recorder record_in(ResultFolder& folder, const Scene& scene, const Simulation& simulation,
                            const Account& account, const Restart* from) {
    constexpr double patience = 0.25;  // s
    const Recorder::Options options{
        scene.output.compress, patience, std::llround(scene.time.end / scene.output.frame_interval) + 2,
        std::llround(scene.time.end / scene.output.sample_interval()) + 2, account.run_id};
    if (from != nullptr) from->require_later(simulation);
    folder.make();
    if (from == nullptr) return Recorder(folder.path(), simulation.result_model(), options);
    return Recorder(
        folder.path(), simulation.result_model(), options,
        {from->earlier(), static_cast<int>(account.frames), static_cast<std::size_t>(account.probe_rows)});
  }

  // A run that fails ends where all was well.
  template <class Work>
  void or_step_back(Work work) {
    try {
      work();
    } catch (const NumericalError&) {
      simulation_.step_back();
      throw;
    }
  }

  // To the next step at which something is due, but no longer than signals and checkpoints may wait: there it
  // pauses, as the clock decides.
  void advance(std::int64_t end) {
    constexpr double patience = 0.2;  // s
    const std::int64_t from = simulation_.step();
    const double t0 = now();
    const std::int64_t due = std::min({end, frames_.next(), probes_.next(), checkpoints_.next()});
    or_step_back([&] { simulation_.advance_towards(due, from + stretch_); });
    const double pace = static_cast<double>(simulation_.step() - from) / std::max(now() - t0, 1e-9);
    stretch_ =
        static_cast<std::int64_t>(std::clamp(pace * patience, 1.0, 2.0 * static_cast<double>(stretch_)));
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
      account_.observing += now() - t0;
      recorder_.probes(look.time(), row);
      account_.probe_rows += row.empty() ? 0 : 1;
    }
    if (frame_due) {
      write(simulation_.frame(look));
      ++account_.frames;
    }
    simulation_.check_energy(look);  // what showed it is kept
  }

  bool keep_is_due() {
    const OutputSpec& output = scene_.output;
    const bool by_step = checkpoints_.due(simulation_.step());
    const bool by_clock =
        output.checkpoint_run_time > 0 && now() - last_checkpoint_ >= output.checkpoint_run_time;
    return output.checkpoint && (by_step || by_clock) && now() >= next_try_;
  }

  // Where it pauses nothing has been looked at.
  void require_sound() {
    or_step_back([&] { simulation_.check_health(); });
  }

  void keep_sound() {
    require_sound();
    keep();
  }

  // What the checkpoint counts on is on the disk before it. One that cannot be written ends no run: it is
  // tried again, but ever more rarely, as each may cost a handle of the system.
  void keep() {
    const double t0 = now();
    recorder_.sync();
    account_.run_time = before_ + now() - begin_;
    kept_ = true;
    try {
      write_checkpoint(folder_.path(), {scene_.name, scene_.resolved_toml}, account_, simulation_);
    } catch (const FileError& error) {
      kept_ = false;
      pause_ = std::min(2 * pause_, 600.0);
      next_try_ = now() + pause_;
      tell_not_kept(error.what());
    }
    last_checkpoint_ = now();
    account_.writing += last_checkpoint_ - t0;
  }

  // Once, and at once: hours may be left in which to make room.
  void tell_not_kept(std::string why) {
    if (!not_kept_.empty()) return;
    if (const std::string prefix = "error: "; why.starts_with(prefix)) why.erase(0, prefix.size());
    char time[64];
    std::snprintf(time, sizeof time, "at t = %.6g s no checkpoint could be written: ", simulation_.time());
    not_kept_ = time + why;
    progress_.finish();
    std::cerr << "warning: " << not_kept_ << std::endl;
  }

  // Where it has stopped; it counts for no checkpoint.
  void record_last_frame() {
    if (simulation_.step() > last_frame_) write(simulation_.frame());
  }

  void write(const Frame& frame) {
    const double t0 = now();
    recorder_.frame(frame);
    last_frame_ = frame.step;
    account_.writing += now() - t0;
  }

  Summary finish(const std::string& status, const std::string& message) {
    Summary summary = simulation_.summary();
    summary.status = status;
    summary.message = message;
    if (status != "failed") summary.history.clear();
    if (const std::string overlap = simulation_.overlap_warning(); status != "failed" && !overlap.empty())
      summary.warnings.push_back(overlap);
    if (!not_kept_.empty()) summary.warnings.push_back(not_kept_);
    summary.host = host_name();
    summary.wall_seconds = before_ + now() - begin_;
    for (StageTime& stage : summary.stages) {
      if (stage.name == stage_name(StageId::observe)) stage.seconds = account_.observing;
      if (stage.name == stage_name(StageId::output)) stage.seconds = account_.writing;
    }
    recorder_.finish(summary);
    return summary;
  }

  const Scene& scene_;
  ResultFolder& folder_;
  double begin_;
  Account account_;
  double before_;  // s: run time of what it goes on from
  Simulation simulation_;
  Recorder recorder_;
  Schedule frames_, probes_, checkpoints_;
  Progress progress_;
  double last_checkpoint_, next_try_ = 0, pause_ = 1;  // s of run time
  bool kept_ = true;
  std::string not_kept_;
  std::int64_t stretch_ = 64, last_frame_ = -1;
};

int exit_code(const Summary& summary, bool kept) {
  if (summary.status == "failed") return static_cast<int>(ExitCode::numerical);
  if (summary.status == "interrupted") return static_cast<int>(ExitCode::interrupted);
  if (summary.status == "terminated") return static_cast<int>(ExitCode::terminated);
  return static_cast<int>(kept ? ExitCode::done : ExitCode::input_output);
}

struct Outcome {
  Summary summary;
  bool kept;         // see Run
  std::string told;  // a warning that has been told already
};

// Where what a run goes on from lies.
fs::path source_folder(const fs::path& restart) {
  std::error_code error;
  if (fs::is_directory(restart, error)) return restart;
  return restart.has_parent_path() ? restart.parent_path() : fs::path(".");
}

bool goes_on_in_place(const RunArguments& arguments) {
  std::error_code error;
  return !arguments.restart.empty() &&
         (arguments.out.empty() || fs::equivalent(arguments.out, source_folder(arguments.restart), error));
}

// Holds still what a run goes on from: another run may be at work there.
void lock_source(const RunArguments& arguments, std::optional<FolderLock>& lock) {
  const fs::path folder = source_folder(arguments.restart);
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;  // told by who opens it
  lock.emplace(folder);
  goes_on_in_place(arguments) ? lock->write() : lock->read();
}

ResultFolder folder_for(const RunArguments& arguments, const Scene& scene, const Restart* from) {
  if (!goes_on_in_place(arguments)) return ResultFolder(arguments, scene.name);
  if (!arguments.out.empty()) require_free(arguments.out, arguments.overwrite);
  return ResultFolder(from->folder());
}

}  // namespace

int run(const RunArguments& arguments) {
  std::optional<FolderLock> source;
  std::optional<Restart> from;
  if (!arguments.restart.empty()) {
    lock_source(arguments, source);
    from.emplace(arguments.restart);
  }
  const Scene scene = from ? from->scene(arguments.scene.overrides)
                           : read_case(arguments.scene.file, arguments.scene.overrides);
  ResultFolder folder = folder_for(arguments, scene, from ? &*from : nullptr);
  const std::string doubt = from && !arguments.quiet ? from->doubt() : "";
  if (!doubt.empty()) std::cerr << "warning: " << doubt << "\n";
  warn_of_threads(arguments.scene.threads);
  watch_signals();
  const Outcome outcome = with_memory_for(scene, [&] {
    Run one(scene, arguments.scene.threads, folder, arguments.quiet, from ? &*from : nullptr);
    if (!goes_on_in_place(arguments)) source.reset();  // copied
    if (!from) one.warn();
    Summary summary = one.go();
    return Outcome{std::move(summary), one.kept(), one.not_kept()};
  });
  const Summary& summary = outcome.summary;
  if (!summary.message.empty()) std::cerr << summary.message << "\n";
  for (const std::string& warning : summary.warnings)
    if (warning != outcome.told) std::cerr << "warning: " << warning << "\n";
  if (!arguments.quiet) print_verdict(Result(folder.path()), std::cout);
  std::cout << "results: " << folder.path().string() << "\n";
  return exit_code(summary, outcome.kept);
}

}  // namespace cinch::app
