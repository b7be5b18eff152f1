// Error against run time, on one thread: cinch_study FOLDER [--full|--trial] writes study.json and study.csv.
//
// The reference of a problem is its exact solution, or else the mean of its finest runs; how far they lie
// from that is its own error.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <future>
#include <thread>

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
  double step, closing_step, seconds, residual;
};

// Run time is that of the steps: samples are taken outside of the clock.
Measured measure_once(const Problem& problem, const Scene& scene) {
  Simulation sim(scene, 1);
  const Timeline& timeline = sim.preparation().timeline;
  Measured out{{}, timeline.before(), timeline.after(), 0, 0};
  for (int s = 1; s <= problem.samples; ++s) {
    const double begin = seconds();
    sim.advance_to(timeline.step_at(problem.end * s / problem.samples));
    out.seconds += seconds() - begin;
    out.track.times.push_back(sim.time());
    out.track.samples.push_back(problem.sample(sim));
  }
  out.seconds /= problem.end;
  out.residual = sim.summary().relative_residual;
  return out;
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

// The runs of one setting.
struct Sweep {
  std::vector<Track> tracks;
  double step = 0, closing_step = 0, seconds = 0, residual = 0;  // medians of the last two
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Measured measure_run(const Problem& problem, Scene scene, int run) {
  if (problem.perturb) problem.perturb(scene, run);
  return measure_once(problem, scene);
}

// The runs [first, last) of a setting, as many at once as there are processors.
void measure_together(const Problem& problem, const Scene& scene, int first, int last,
                      std::vector<Measured>& found) {
  const int at_once = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (; first < last; first += at_once) {
    std::vector<std::future<Measured>> runs;
    for (int r = first; r < std::min(last, first + at_once); ++r)
      runs.push_back(std::async(std::launch::async, measure_run, std::cref(problem), scene, r));
    for (auto& run : runs) found.push_back(run.get());
  }
}

// The first `timed` runs follow each other, and their time counts.
Sweep measure(const Problem& problem, const Setting& setting, int timed) {
  const Scene scene = problem.scene(setting);
  std::vector<Measured> runs;
  for (int r = 0; r < std::min(timed, setting.runs); ++r) runs.push_back(measure_run(problem, scene, r));
  const std::size_t alone = runs.size();
  measure_together(problem, scene, static_cast<int>(alone), setting.runs, runs);
  Sweep sweep;
  std::vector<double> times, residuals;
  for (const Measured& run : runs) {
    sweep.tracks.push_back(run.track);
    sweep.step = run.step, sweep.closing_step = run.closing_step;
    residuals.push_back(run.residual);
    if (times.size() < alone) times.push_back(run.seconds);
  }
  sweep.seconds = times.empty() ? 0 : median(times), sweep.residual = median(residuals);
  return sweep;
}

// Where a setting has one run: the fastest of some, as what else the machine does only adds.
double least_seconds(const Problem& problem, const Setting& setting, double first) {
  double best = first, spent = first * problem.end;
  for (int i = 0; i < 9 && spent < 0.3; ++i) {
    const double again = measure_once(problem, problem.scene(setting)).seconds;
    spent += again * problem.end;
    best = std::min(best, again);
  }
  return best;
}

// What runs are compared with.
struct Reference {
  Track track;
  double error = 0;  // its own
};

// Settings of a reference scatter about what they all come to; the one that is furthest off counts.
Reference reference_of(const Problem& problem) {
  if (problem.exact) return {};
  std::vector<Track> finest;
  for (const Setting& setting : problem.reference)
    finest.push_back(mean(measure(problem, setting, 0).tracks));
  Reference reference{mean(finest)};
  for (const Track& track : finest)
    reference.error = std::max(reference.error, problem.errors(track, reference.track).front().second);
  reference.error = error_of_mean(reference.error, finest.size());
  return reference;
}

// The exact solution at a run's own times.
Track exact_track(const Problem& problem, const std::vector<double>& times) {
  Track track{times, {}};
  for (const double time : times) track.samples.push_back(problem.exact(time));
  return track;
}

// Errors of the mean, by how much a run differs from it, and how uncertain that leaves the mean.
Errors errors_of(const Problem& problem, const std::vector<Track>& tracks, const Track& reference) {
  const Track found = mean(tracks);
  Errors errors = problem.errors(found, problem.exact ? exact_track(problem, found.times) : reference);
  if (tracks.size() == 1) return errors;
  std::vector<double> apart;
  for (const Track& track : tracks) apart.push_back(problem.errors(track, found).front().second);
  errors.emplace_back("one_run_from_the_mean", median(apart));
  errors.emplace_back("uncertainty", error_of_mean(median(apart), tracks.size()));
  return errors;
}

RunResult run(const Problem& problem, const Setting& setting, const Track& reference) {
  RunResult result;
  result.setting = setting;
  try {
    constexpr int timed = 8;
    const Sweep found = measure(problem, setting, timed);
    result.step = found.step, result.closing_step = found.closing_step;
    result.errors = errors_of(problem, found.tracks, reference);
    result.residual = found.residual;
    result.seconds = setting.runs > 1 ? found.seconds : least_seconds(problem, setting, found.seconds);
    std::printf("  %-58s %4d elements  error %8.4f %%  %9.3g s/s  residual %.1e%s\n",
                setting.series().c_str(), setting.elements, 100 * result.error(), result.seconds,
                result.residual, setting.papers ? "  the paper's choice" : "");
  } catch (const Error& error) {
    result.failure = error.what();
    std::printf("  %-58s %4d elements  stopped: %.60s...\n", setting.series().c_str(), setting.elements,
                error.what());
  }
  std::fflush(stdout);
  return result;
}

ProblemResult study(const Problem& problem) {
  std::printf("%s: %s\n", problem.name.c_str(), problem.title.c_str());
  const Reference reference = reference_of(problem);
  ProblemResult result;
  result.problem = &problem;
  result.reference_error = reference.error;
  std::printf("  error: %s\n  the reference's own: %.4f %%\n", problem.measure.c_str(),
              100 * result.reference_error);
  for (const Setting& setting : problem.settings)
    result.runs.push_back(run(problem, setting, reference.track));
  return result;
}

void print_best(const ProblemResult& result) {
  const auto print = [](double wanted, const char* besides, const RunResult* best) {
    std::printf("  within %4.1f %%%s: ", 100 * wanted, besides);
    if (best == nullptr) std::printf("none\n");
    else
      std::printf("%s, %d elements: %.3g s a simulated second\n", best->setting.series().c_str(),
                  best->setting.elements, best->seconds);
  };
  for (const double wanted : wanted_errors) {
    print(wanted, "", best_within(result, wanted));
    print(wanted, ", residual within 1e-4", best_within(result, wanted, small_residual));
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
    const std::vector<study::Problem> problems = study::problems(extent);
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
