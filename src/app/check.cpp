// `cinch check`: what a case would do, without doing it.
#include <chrono>
#include <cstdio>
#include <iostream>

#include "app/commands.hpp"
#include "app/error_table.hpp"
#include "app/progress.hpp"
#include "app/resources.hpp"
#include "base/error.hpp"
#include "input/nearest_key.hpp"
#include "plan/case_warnings.hpp"
#include "plan/simulation.hpp"

namespace cinch::app {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print_counts(const Scene& scene, const Preparation& p) {
  std::printf("case             %s: %s\n", scene.name.c_str(), scene.title.c_str());
  std::printf(
      "scene            %zu nodes, %zu elements, %zu rings, %zu targets, %zu nets, %zu threads, %zu "
      "mechanisms\n",
      p.assembly.nodes.size(), p.assembly.elements.size(), p.assembly.rings.size(), p.assembly.balls.size(),
      scene.nets.size(), scene.threads.size(), scene.mechanisms.size());
  if (scene.equilibrium) std::printf("start            static equilibrium under gravity\n");
  if (p.closing_step >= 0)
    std::printf("closing          at %g s: %d nodes and %d elements join\n",
                p.timeline.time_of(p.closing_step),
                static_cast<Index>(p.assembly.nodes.size()) - p.assembly.nodes_before,
                static_cast<Index>(p.assembly.elements.size()) - p.assembly.elements_before);
}

// Which rings slide on threads, and which feel contact with their wire: an automatic joint chooses unasked.
void print_joints(const Assembly& assembly) {
  std::vector<std::string> sliding, contact, missed, thick;
  for (const AssemblyRing& ring : assembly.rings) {
    auto& without = !ring.missed ? contact : ring.missed->thickness > 0 ? thick : missed;
    (ring.threadings.empty() ? without : sliding).push_back(ring.name);
  }
  const char* label = "joints";
  const auto print = [&](const char* kind, const std::vector<std::string>& names) {
    if (names.empty()) return;
    std::printf("%-16s %s: %s\n", label, kind, list_of(names, 16).c_str());
    label = "";
  };
  print("sliding", sliding);
  print("contact", contact);
  print("contact, as no thread passes through", missed);
  print("contact, as the thread is too thick", thick);
}

void print_steps(const Preparation& p) {
  const char* label = "stable step";
  for (const Phase& phase : p.phases) {
    std::printf("%-16s %.4g s, limited by %s\n", label, phase.bound.step, phase.limited_by.c_str());
    label = "";
  }
  label = "step";
  std::int64_t begin = 0;
  for (const Phase& phase : p.phases) {
    const bool last = &phase == &p.phases.back();
    const std::int64_t end = last ? p.end_step : std::min(p.closing_step, p.end_step);
    if (begin > 0 && begin >= end) break;  // it closes after the end
    std::printf("%-16s %.4g s (%s, %.2g of the stable step), %lld steps to %g s\n", label, phase.plan.dt,
                phase.step_given ? "given" : "automatic", phase.plan.dt / phase.bound.step,
                static_cast<long long>(end - begin), p.timeline.time_of(end));
    label = "", begin = end;
  }
}

void print_end(const Scene& scene) {
  if (scene.time.end_when == EndWhen::never) return;
  std::printf("end              %g s after the mouth has closed, at %g s at the latest\n",
              scene.time.end_delay, scene.time.end);
}

void print_stages(const Preparation& p) {
  for (const Phase& phase : p.phases) {
    std::printf("stages           %s\n", phase.name.c_str());
    for (const StageInfo& stage : phase.plan.stages(phase.model))
      std::printf("  %-9s %-20s %s\n", stage.runs ? "runs" : "left out", stage.name.c_str(),
                  stage.note.c_str());
  }
}

void print_output(const Scene& scene, const Preparation& p) {
  const double frames = scene.time.end / scene.output.frame_interval + 1;
  const Model& whole = p.whole();
  const auto joints = static_cast<double>(whole.joints.size());
  const double points = static_cast<double>(whole.sliding_nodes.size()) + joints;  // of ways
  const double frame = static_cast<double>(whole.nodes) * 9 * 8 +
                       static_cast<double>(whole.elements) * (2 * 8 + 1) + joints * (3 * 8 + 4) +
                       points * (3 * 8 + 8 + 1);
  std::printf("output           %.0f frames, %.1f MB\n", frames, frames * frame / 1e6);
}

// What a stretch of each phase on copies that are thrown away has shown.
struct Trial {
  MemoryUse memory;     // of the larger phase
  double seconds = 0;   // that the whole run takes
  int threads = 0;      // 0: not even the start was possible
  std::string problem;  // what stopped it
  std::string overlap;  // a warning
};

double seconds_per_step(Simulation& s) {
  const std::int64_t end = s.preparation().end_step;
  const std::int64_t steps = std::min<std::int64_t>(2000, std::max<std::int64_t>(end - s.step(), 1));
  s.advance_to(s.step() + std::min<std::int64_t>(10, steps));
  const double begin = now();
  const std::int64_t first = s.step();
  std::int64_t batch = 1;  // a step of a large net takes long, and so would fifty
  for (; s.step() < first + steps && now() - begin < 0.5; batch = std::min<std::int64_t>(2 * batch, 50))
    s.advance_to(std::min(s.step() + batch, first + steps));
  return (now() - begin) / static_cast<double>(s.step() - first);
}

// Lets a simulation run in its first phase, which lasts `steps` steps of the whole run; `besides`: bytes of
// models that the whole run has and this simulation lacks.
void try_phase(Simulation& s, double steps, std::size_t besides, Trial& trial) {
  trial.threads = s.threads();
  MemoryUse use = s.memory();
  use.model += besides;
  if (use.total() > trial.memory.total()) trial.memory = use;
  trial.seconds += seconds_per_step(s) * steps;
}

// Closing at once gives the second phase's work without the wait.
void try_closing(Scene scene, int threads, double steps, std::size_t besides, Trial& trial) {
  scene.closing.time = 0;
  const auto attempt = [&] {
    Simulation rest(scene, step_by_step(prepare(scene)), threads);
    try_phase(rest, steps, besides, trial);
  };
  try {
    return attempt();
  } catch (const NumericalError&) {
    // what is stowed may lie in each other's way, as it does not when it closes
    for (Net& net : scene.nets) net.stowed_factor = 1;
    for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 1;
    scene.targets.clear();
  }
  attempt();
}

Trial try_out(const Scene& scene, int threads, Preparation p) {
  Trial trial;
  const bool two = p.phases.size() > 1;
  const std::int64_t end = p.end_step, first = two ? std::min(p.closing_step, end) : end;
  const std::size_t first_model = memory_of(p.phases.front().model);
  try {
    {
      Simulation begin(scene, step_by_step(std::move(p)), threads);  // at first much is slack
      trial.overlap = begin.overlap_warning();
      try_phase(begin, static_cast<double>(first), 0, trial);
      begin.check_energy(begin.look());
    }
    if (two && end > first) try_closing(scene, threads, static_cast<double>(end - first), first_model, trial);
  } catch (const NumericalError& error) {  // a valid case whose motion goes wrong at once: worth knowing
    trial.problem = error.what();
  }
  return trial;
}

// The summed sizes of all arrays, and what is there besides for a while: `start` in all, or a frame.
void print_memory(std::size_t start, std::size_t frame, const MemoryUse& use) {
  const auto megabytes = [](std::size_t bytes) { return static_cast<double>(bytes) / 1e6; };
  const std::size_t writing = use.total() + frame;
  std::printf(
      "memory           %.1f MB while stepping (model %.1f, state %.1f, pieces %.1f, contacts %.1f, looks "
      "%.1f), %.1f MB while it %s, besides the program's own\n",
      megabytes(use.total()), megabytes(use.model), megabytes(use.state), megabytes(use.pieces),
      megabytes(use.contacts), megabytes(use.looks), megabytes(std::max(start, writing)),
      start > writing ? "starts" : "writes a frame");
}

void print_expected_time(const Scene& scene, const Trial& trial) {
  if (!trial.problem.empty()) {
    std::printf("expected time    unknown, the trial of some thousand steps stopped\n");
    return;
  }
  std::printf("threads          %d\n", trial.threads);
  std::printf(
      "expected time    about %s (h:)min:s, %.3g min per simulated second, from a trial of some thousand "
      "steps\n",
      clock_text(trial.seconds).c_str(), trial.seconds / 60 / scene.time.end);
}

// The exit code: that of a run, where the trial stopped like one.
int print_verdict(const Trial& trial) {
  if (trial.problem.empty()) {
    std::printf("the case is valid\n");
    return static_cast<int>(ExitCode::done);
  }
  const std::string prefix = "error: ";
  const bool has = trial.problem.starts_with(prefix);
  std::printf("the case is valid, but its trial stopped: %s\n",
              trial.problem.c_str() + (has ? prefix.size() : 0));
  return static_cast<int>(ExitCode::numerical);
}

// The exit code: that of a run, where one of them was stopped.
int check_error(const Scene& scene, const ErrorRuns& runs) {
  std::fflush(stdout);
  const ErrorEstimate estimate =
      estimate_error(scene, runs, [](const std::string& what) { std::cerr << "running " << what << "\n"; });
  print_error(estimate);
  return static_cast<int>(estimate.stopped.empty() ? ExitCode::done : ExitCode::numerical);
}

int check_scene(const Scene& scene, int threads, const CheckOptions& options) {
  Preparation p = prepare(scene);
  std::vector<std::string> warnings = case_warnings(scene, p);
  print_counts(scene, p);
  print_joints(p.assembly);
  print_steps(p);
  print_end(scene);
  print_stages(p);
  print_output(scene, p);
  const std::size_t start = memory_at_start(p);
  const std::size_t frame = memory_of_frame(p.whole().nodes, p.whole().elements);
  const Trial trial = try_out(scene, threads, std::move(p));
  if (trial.threads > 0) print_memory(start, frame, trial.memory);
  print_expected_time(scene, trial);
  if (trial.problem.empty() && !trial.overlap.empty()) warnings.push_back("warning: " + trial.overlap);
  std::fflush(stdout);
  for (const std::string& warning : warnings) std::cerr << warning << "\n";
  const int code = print_verdict(trial);
  if (!options.error || code != 0) return code;
  return check_error(scene, {options.runs, threads});
}

}  // namespace

int check(const CaseArguments& arguments, const CheckOptions& options) {
  const Scene scene = read_case(arguments.file, arguments.overrides);
  if (options.resolved) {
    std::cout << scene.resolved_toml;
    return 0;
  }
  warn_of_threads(arguments.threads);
  return with_memory_for(scene, [&] { return check_scene(scene, arguments.threads, options); });
}

}  // namespace cinch::app
