#include "study_measure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <thread>

#include "base/error.hpp"
#include "processor_time.hpp"

namespace cinch::study {
namespace {

// What one run gives before it is compared.
struct Measured {
  Track track;
  StepsTaken taken;
  double seconds, residual;
};

StepsTaken steps_taken(const Preparation& preparation) {
  const Phase &first = preparation.phases.front(), &last = preparation.phases.back();
  const double before = preparation.timeline.before(), after = preparation.timeline.after();
  return {before, after, before / first.bound.step, after / last.bound.step, last.plan.joint_steps};
}

// Run time is that of the steps, by the processor's clock: what else a machine does does not count. Samples
// are taken outside of it.
Measured measure_once(const Problem& problem, const Scene& scene) {
  Simulation sim(scene, 1);
  const Timeline& timeline = sim.preparation().timeline;
  Measured out{{}, steps_taken(sim.preparation()), 0, 0};
  for (int s = 1; s <= problem.samples; ++s) {
    const double begin = bench::thread_seconds();
    sim.advance_to(timeline.step_at(problem.end * s / problem.samples));
    out.seconds += bench::thread_seconds() - begin;
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
  StepsTaken taken;
  double seconds = 0, residual = 0;  // medians
};

// Not a number where one of them is none, as times of events that a run lacks.
double median(std::vector<double> values) {
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); })) return NAN;
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

// The first `timed` runs follow each other, and their time counts. Runs have numbers from `first` on.
Sweep measure(const Problem& problem, const Setting& setting, int timed, int first = 0) {
  const Scene scene = problem.scene(setting);
  std::vector<Measured> runs;
  for (int r = 0; r < std::min(timed, setting.runs); ++r)
    runs.push_back(measure_run(problem, scene, first + r));
  const std::size_t alone = runs.size();
  measure_together(problem, scene, first + static_cast<int>(alone), first + setting.runs, runs);
  Sweep sweep;
  std::vector<double> times, residuals;
  for (const Measured& run : runs) {
    sweep.tracks.push_back(run.track);
    sweep.taken = run.taken;
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

// The exact solution at a run's own times.
Track exact_track(const Problem& problem, const std::vector<double>& times) {
  Track track{times, {}};
  for (const double time : times) track.samples.push_back(problem.exact(time));
  return track;
}

Track difference(Track of, const Track& from) {
  for (std::size_t s = 0; s < of.samples.size(); ++s)
    for (std::size_t i = 0; i < of.samples[s].size(); ++i) of.samples[s][i] -= from.samples[s][i];
  return of;
}

// How far each is from their mean, measure by measure.
std::vector<Errors> from_the_mean(const Problem& problem, const std::vector<Track>& tracks,
                                  const Track& mean) {
  std::vector<Errors> all;
  for (const Track& track : tracks) all.push_back(problem.errors(track, mean));
  return all;
}

// Of each measure what `pick` makes of its values, as an error of their mean.
template <class Pick>
Errors errors_of_mean(const std::vector<Errors>& apart, Pick pick) {
  Errors errors = apart.front();
  for (std::size_t m = 0; m < errors.size(); ++m) {
    std::vector<double> values;
    for (const Errors& one : apart) values.push_back(one[m].second);
    errors[m].second = error_of_mean(pick(values), values.size());
  }
  return errors;
}

// As median() for what is no number.
double greatest_of(const std::vector<double>& values) {
  return std::isnan(median(values)) ? NAN : *std::max_element(values.begin(), values.end());
}

void compare(const Problem& problem, const std::vector<Track>& tracks, const Track& reference,
             RunResult& result) {
  const Track found = mean(tracks);
  const Track right = problem.exact ? exact_track(problem, found.times) : reference;
  result.errors = problem.errors(found, right);
  if (problem.exact) result.apart = difference(found, right);
  if (tracks.size() == 1) return;
  const std::vector<Errors> apart = from_the_mean(problem, tracks, found);
  std::vector<double> first;
  for (const Errors& one : apart) first.push_back(one.front().second);
  result.one_run = median(first);
  result.uncertainties = errors_of_mean(apart, median);
}

}  // namespace

// Settings of a reference scatter about what they all come to; the one that is furthest off counts. No run of
// a reference begins as one that is compared with it, or as one of another setting of the reference: what
// these have in common by chance would count as agreement.
Reference reference_of(const Problem& problem) {
  if (problem.exact) return {};
  int first = 0;
  for (const Setting& setting : problem.settings) first = std::max(first, setting.runs);
  std::vector<Track> finest;
  for (const Setting& setting : problem.reference) {
    finest.push_back(mean(measure(problem, setting, 0, first).tracks));
    first += setting.runs;
  }
  const Track all = mean(finest);
  return {all, errors_of_mean(from_the_mean(problem, finest, all), greatest_of)};
}

RunResult run(const Problem& problem, const Setting& setting, const Track& reference) {
  RunResult result;
  result.setting = setting;
  try {
    constexpr int timed = 8;
    const Sweep found = measure(problem, setting, timed);
    result.taken = found.taken;
    compare(problem, found.tracks, reference, result);
    result.residual = found.residual;
    result.seconds = setting.runs > 1 ? found.seconds : least_seconds(problem, setting, found.seconds);
  } catch (const Error& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace cinch::study
