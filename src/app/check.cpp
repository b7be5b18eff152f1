// `cinch check`: what a case would do, without doing it.
#include <chrono>
#include <cstdio>
#include <iostream>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "base/error.hpp"
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
                static_cast<double>(p.closing_step) * p.dt,
                static_cast<Index>(p.assembly.nodes.size()) - p.assembly.nodes_before,
                static_cast<Index>(p.assembly.elements.size()) - p.assembly.elements_before);
}

void print_step(const Scene& scene, const Preparation& p) {
  std::printf("stable step      %.4g s, limited by %s\n", p.stable_step, p.limited_by.c_str());
  std::printf("step             %.4g s (%s, %.2g of the stable step), %lld steps to %g s\n", p.dt,
              scene.time.step > 0 ? "given" : "automatic", p.dt / p.stable_step,
              static_cast<long long>(p.end_step), scene.time.end);
}

void print_stages(const Preparation& p) {
  for (const Phase& phase : p.phases) {
    std::printf("stages           %s\n", phase.name.c_str());
    for (const StageInfo& stage : phase.plan.stages(phase.model))
      std::printf("  %-9s %-20s %s\n", stage.runs ? "runs" : "left out", stage.name.c_str(),
                  stage.note.c_str());
  }
}

// Bytes that the store takes, and what the frames will take on disk.
void print_sizes(const Scene& scene, const Preparation& p) {
  const double nodes = static_cast<double>(p.assembly.nodes.size());
  const double elements = static_cast<double>(p.assembly.elements.size());
  const double store =
      nodes * (8 * 8 + sizeof(AssemblyNode)) + elements * (6 * 8 + 7 * 4 + sizeof(AssemblyElement));
  const double frames = scene.time.end / scene.output.frame_interval + 1;
  const double frame = nodes * 9 * 8 + elements * (2 * 8 + 1 + 4);
  std::printf("memory           %.1f MB\n", store / 1e6);
  std::printf("output           %.0f frames, %.1f MB\n", frames, frames * frame / 1e6);
}

// Times a short stretch of each phase on copies that are thrown away.
void print_expected_time(const Scene& scene, int threads) {
  double expected = 0;
  Simulation trial(scene, threads);
  const Preparation& p = trial.preparation();
  const auto measure = [&](Simulation& s) {
    const std::int64_t steps = std::min<std::int64_t>(2000, std::max<std::int64_t>(p.end_step - s.step(), 1));
    s.advance_to(s.step() + std::min<std::int64_t>(10, steps));
    const double begin = now();
    const std::int64_t first = s.step();
    while (s.step() < first + steps && now() - begin < 0.5)
      s.advance_to(std::min(s.step() + 50, first + steps));
    return (now() - begin) / static_cast<double>(s.step() - first);
  };
  const std::int64_t first_phase = p.phases.size() > 1 ? std::min(p.closing_step, p.end_step) : p.end_step;
  expected += measure(trial) * static_cast<double>(first_phase);
  if (p.phases.size() > 1 && p.end_step > p.closing_step) {
    Scene closing = scene;  // closing at once gives the second phase's work without the wait
    closing.closing.time = 0;
    Simulation second(closing, threads);
    expected += measure(second) * static_cast<double>(p.end_step - p.closing_step);
  }
  std::printf("threads          %d\n", trial.threads());
  std::printf(
      "expected time    about %s (h:)min:s, %.3g min per simulated second, from a trial of some thousand "
      "steps\n",
      clock_text(expected).c_str(), expected / 60 / scene.time.end);
}

}  // namespace

int check(const CaseArguments& arguments, bool resolved) {
  const Scene scene = read_case(arguments.file, arguments.overrides);
  if (resolved) {
    std::cout << scene.resolved_toml;
    return 0;
  }
  const Preparation p = prepare(scene);
  print_counts(scene, p);
  print_step(scene, p);
  print_stages(p);
  print_sizes(scene, p);
  try {
    print_expected_time(scene, arguments.threads);
  } catch (const NumericalError&
               error) {  // a valid case whose motion goes wrong at once: worth knowing before the run
    std::printf("expected time    unknown, the trial of some thousand steps stopped: %s\n", error.what());
  }
  std::printf("the case is valid\n");
  return 0;
}

}  // namespace cinch::app
