// Error against run time, on one thread: cinch_study FOLDER [--full|--trial] writes study.json and study.csv.
//
// The reference of a problem is the mean of its finest runs; how far they lie apart is its own error.
#include <chrono>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "study_result.hpp"

namespace cinch::study {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What one run gives before it is compared.
struct Measured {
  Track track;
  double step, seconds, residual;
};

// Run time is that of the steps: samples are taken outside of the clock.
Measured measure_once(const Problem& problem, const Scene& scene) {
  Simulation sim(scene, 1);
  Measured out{{}, sim.preparation().dt, 0, 0};
  for (int s = 1; s <= problem.samples; ++s) {
    const double begin = seconds();
    sim.advance_to(std::llround(problem.end * s / problem.samples / out.step));
    out.seconds += seconds() - begin;
    out.track.samples.push_back(problem.sample(sim));
  }
  out.seconds /= problem.end;
  out.residual = sim.summary().relative_residual;
  return out;
}

// The fastest of some runs: what else the machine does only adds.
Measured measure(const Problem& problem, const Setting& setting) {
  const Scene scene = problem.scene(setting);
  Measured best = measure_once(problem, scene);
  double spent = best.seconds * problem.end;
  for (int i = 0; i < 9 && spent < 0.3; ++i) {
    const Measured again = measure_once(problem, scene);
    spent += again.seconds * problem.end;
    best.seconds = std::min(best.seconds, again.seconds);
  }
  return best;
}

Track mean(const std::vector<Track>& tracks) {
  Track sum = tracks.front();
  for (std::size_t t = 1; t < tracks.size(); ++t)
    for (std::size_t s = 0; s < sum.samples.size(); ++s)
      for (std::size_t i = 0; i < sum.samples[s].size(); ++i) sum.samples[s][i] += tracks[t].samples[s][i];
  for (auto& sample : sum.samples)
    for (double& value : sample) value /= static_cast<double>(tracks.size());
  return sum;
}

RunResult run(const Problem& problem, const Setting& setting, const Track& reference) {
  RunResult result;
  result.setting = setting;
  try {
    const Measured found = measure(problem, setting);
    result.step = found.step;
    result.errors = problem.errors(found.track, reference);
    result.residual = found.residual;
    result.seconds = found.seconds;
    std::printf("  %-48s %4d elements  error %8.4f %%  %9.3g s/s  residual %.1e%s\n",
                setting.series().c_str(), setting.elements, 100 * result.error(), result.seconds,
                result.residual, setting.papers ? "  the paper's choice" : "");
  } catch (const Error& error) {
    result.failure = error.what();
    std::printf("  %-48s %4d elements  stopped: %.60s...\n", setting.series().c_str(), setting.elements,
                error.what());
  }
  std::fflush(stdout);
  return result;
}

ProblemResult study(const Problem& problem) {
  std::printf("%s: %s\n", problem.name.c_str(), problem.title.c_str());
  std::vector<Track> finest;
  for (const Setting& setting : problem.reference)
    finest.push_back(measure_once(problem, problem.scene(setting)).track);
  const Track reference = mean(finest);
  ProblemResult result;
  result.problem = &problem;
  for (const Track& track : finest)
    result.reference_error =
        std::max(result.reference_error, problem.errors(track, reference).front().second);
  std::printf("  error: %s\n  the reference's own: %.4f %%\n", problem.measure.c_str(),
              100 * result.reference_error);
  for (const Setting& setting : problem.settings) result.runs.push_back(run(problem, setting, reference));
  return result;
}

void print_best(const ProblemResult& result) {
  for (const double wanted : wanted_errors) {
    const RunResult* best = best_within(result, wanted);
    if (best == nullptr) std::printf("  within %4.1f %%: none\n", 100 * wanted);
    else
      std::printf("  within %4.1f %%: %s, %d elements: %.3g s a simulated second\n", 100 * wanted,
                  best->setting.series().c_str(), best->setting.elements, best->seconds);
  }
  for (const std::string& series : series_of(result))
    if (const double order = observed_order(result, series); std::isfinite(order))
      std::printf("  order %5.2f: %s\n", order, series.c_str());
}

}  // namespace
}  // namespace cinch::study

int main(int argc, char** argv) {
  using namespace cinch;
  const bool full = argc == 3 && std::strcmp(argv[2], "--full") == 0;
  const bool trial = argc == 3 && std::strcmp(argv[2], "--trial") == 0;
  if (argc < 2 || argc > 3 || (argc == 3 && !full && !trial)) {
    std::fprintf(stderr, "usage: cinch_study FOLDER [--full|--trial]\n");
    return static_cast<int>(ExitCode::usage);
  }
  try {
    const auto extent = full ? study::Extent::full : trial ? study::Extent::trial : study::Extent::usual;
    std::vector<study::Problem> problems{study::ring_pull(extent)};
    if (!trial) problems.push_back(study::net_closing(extent));
    std::vector<study::ProblemResult> results;
    for (const study::Problem& problem : problems) {
      results.push_back(study::study(problem));
      study::print_best(results.back());
    }
    study::write(results, argv[1]);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code);
  }
}
