#include "study/error_estimate.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "base/error.hpp"
#include "plan/probes.hpp"
#include "scene/finer_threads.hpp"
#include "study/picture.hpp"
#include "study/run_track.hpp"

namespace cinch {
namespace {

// ---- runs

// Runs of one setting that differ by chance alone.
struct Ensemble {
  std::string name;
  Scene scene;
  std::size_t runs;
  std::vector<RunTrack> tracks{};
  std::vector<std::exception_ptr> failures{};  // by run
};

void run_one(Ensemble& ensemble, std::size_t number, int threads) {
  try {
    const double nudge = number > 0 ? ErrorEstimate::nudge : 0;
    ensemble.tracks[number] = follow(ensemble.scene, threads, {nudge, static_cast<unsigned>(number)});
  } catch (...) {
    ensemble.failures[number] = std::current_exception();
  }
}

// As many at a time as the threads carry.
void run_all(std::vector<Ensemble>& ensembles, int threads,
             const std::function<void(const std::string&)>& announce) {
  std::vector<std::pair<Ensemble*, std::size_t>> jobs;
  for (Ensemble& ensemble : ensembles) {
    ensemble.tracks.resize(ensemble.runs);
    ensemble.failures.resize(ensemble.runs);
    for (std::size_t i = 0; i < ensemble.runs; ++i) jobs.emplace_back(&ensemble, i);
  }
  if (threads == 0) threads = omp_get_max_threads();
  const int each = choose_threads(prepare(ensembles.back().scene).whole().elements, threads);
#pragma omp parallel for num_threads(threads / each) schedule(dynamic, 1)
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto [ensemble, number] = jobs[i];
#pragma omp critical(announcing)
    announce(std::to_string(i + 1) + " of " + std::to_string(jobs.size()) + ": " + ensemble->name);
    run_one(*ensemble, number, each);
  }
}

// ---- what is compared

// One quantity: how a run shows it, and what of a picture counts.
struct Measure {
  std::string words;
  std::function<Picture(const RunTrack&)> picture;
  std::function<double(const Picture&)> size;
};

// Columns [first, first + count) of the probes, sample after sample.
Picture columns_over_time(const RunTrack& track, std::size_t first, std::size_t count) {
  Picture out;
  for (const std::vector<double>& row : track.probes) {
    const auto begin = row.begin() + static_cast<std::ptrdiff_t>(first);
    out.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(count));
  }
  return out;
}

Measure over_time(std::size_t first, std::size_t count) {
  return {"greatest over time", [=](const RunTrack& track) { return columns_over_time(track, first, count); },
          greatest};
}

Measure peak(std::size_t first, std::size_t count) {
  const auto highest = [=](const RunTrack& track) {
    return Picture{{greatest(columns_over_time(track, first, count))}};
  };
  return {"peak", highest, greatest};
}

// Nodes of all parts that coarser threads have, too.
Measure nodes_of(const RunTrack& coarse) {
  std::vector<std::size_t> counts;
  for (const std::vector<Vec3>& part : coarse.nodes) counts.push_back(part.size());
  const auto shared = [counts](const RunTrack& track) {
    Picture out;
    for (std::size_t p = 0; p < counts.size(); ++p) {
      const std::size_t stride = counts[p] > 1 ? (track.nodes[p].size() - 1) / (counts[p] - 1) : 1;
      for (std::size_t k = 0; k < counts[p]; ++k) {
        const Vec3& place = track.nodes[p][k * stride];
        out.push_back({place.x(), place.y(), place.z()});
      }
    }
    return out;
  };
  return {"r.m.s. at the end", shared, root_mean_square};
}

// ---- rows

struct Pictures {
  std::vector<Picture> all;  // empty where a run was stopped

  Pictures(const Ensemble& ensemble, const Measure& measure) {
    if (std::any_of(ensemble.failures.begin(), ensemble.failures.end(), [](const auto& f) { return f; }))
      return;
    for (const RunTrack& track : ensemble.tracks) all.push_back(measure.picture(track));
  }
};

// Of the means of `runs` pictures each.
double distance(const Measure& measure, const Pictures& a, const Pictures& b, std::size_t runs) {
  if (a.all.empty() || b.all.empty()) return std::numeric_limits<double>::quiet_NaN();
  return measure.size(difference(mean(a.all, runs), mean(b.all, runs)));
}

// Of the largest coordinate by the end, m.
double scale_of(const RunTrack& track) {
  double most = 0;
  for (const std::vector<Vec3>& part : track.nodes)
    for (const Vec3& place : part) most = std::max(most, place.cwiseAbs().maxCoeff());
  return most;
}

// Whether a place, a distance or a velocity is what rounding makes of none, in finer runs, too.
bool stands_still(const ErrorEstimate::Row& row, const RunTrack& own, double end) {
  if (row.unit != "m" && row.unit != "m/s") return false;
  constexpr double rounding = 1e-12, nudged = 1e-6;
  const double scale = scale_of(own) / (row.unit == "m" ? 1 : end);
  const auto differs = [&](ErrorEstimate::Difference by) { return row.difference[by] > nudged * scale; };
  return row.size <= rounding * scale && !differs(ErrorEstimate::of_step) &&
         !differs(ErrorEstimate::of_threads);
}

ErrorEstimate::Row row_of(const std::string& name, const Measure& measure,
                          const std::vector<Ensemble>& ensembles, std::size_t runs) {
  const Pictures finer(ensembles[0], measure), half(ensembles[1], measure), own(ensembles[2], measure);
  ErrorEstimate::Row row;
  row.name = name;
  row.measure = measure.words;
  row.difference[ErrorEstimate::of_step] = distance(measure, own, half, runs);
  row.difference[ErrorEstimate::of_threads] = distance(measure, half, finer, runs);
  // of two means, each of which has a share of 1 / runs of the variance
  row.difference[ErrorEstimate::of_chance] =
      std::sqrt(2.0 / static_cast<double>(runs)) * measure.size(deviation(own.all));
  return row;
}

std::size_t columns_of(const Probe& probe, const std::vector<ResultModel::ProbeColumn>& all,
                       std::size_t first) {
  std::size_t count = 0;
  while (first + count < all.size() &&
         (all[first + count].name == probe.name || all[first + count].name.starts_with(probe.name + ".")))
    ++count;
  return count;
}

std::vector<ErrorEstimate::Row> rows_of(const Scene& scene, const std::vector<Ensemble>& ensembles,
                                        std::size_t runs) {
  std::vector<ErrorEstimate::Row> rows;
  const RunTrack& own = ensembles[2].tracks.front();
  const auto add = [&](const std::string& name, const std::string& unit, const Measure& measure, bool place) {
    rows.push_back(row_of(name, measure, ensembles, runs));
    rows.back().unit = unit;
    const Picture picture = measure.picture(own);
    rows.back().size = place ? extent(picture) : greatest(picture);
    rows.back().still = stands_still(rows.back(), own, scene.time.end);
  };
  const std::vector<ResultModel::ProbeColumn> all = probe_columns(scene, assemble(scene));
  std::size_t first = 0;
  for (const Probe& probe : scene.probes) {
    const ProbeQuantity q = probe.quantity;
    const std::size_t count = columns_of(probe, all, first);
    const std::string& unit = all[first].unit;
    if (q == ProbeQuantity::force)
      add(probe.name, unit, peak(first, 3), false);  // the fourth is its magnitude
    else if (q == ProbeQuantity::tension) add(probe.name, unit, peak(first, 1), false);
    else if (q != ProbeQuantity::energy)
      add(probe.name, unit, over_time(first, count), q == ProbeQuantity::position);
    first += count;
  }
  add("all nodes", "m", nodes_of(own), true);
  return rows;
}

Scene half_of(const Scene& scene, const Timeline& timeline) {
  Scene half = scene;
  half.time.step = timeline.before() / 2;
  half.closing.step = timeline.after() / 2;
  return half;
}

// With twice the elements besides. Where the case leaves the step open, it is their own automatic one if that
// is shorter still.
Scene finer_of(const Scene& scene, const Scene& half, const Preparation& own) {
  Scene finer = finer_threads(half, 2), open = finer;
  const bool before = own.phases.front().step_given, after = own.phases.back().step_given;
  if (!before) open.time.step = scene.time.step;
  if (!after) open.closing.step = scene.closing.step;
  try {
    const Timeline timeline = prepare(open).timeline;
    if (!before) finer.time.step = std::min(half.time.step, timeline.before());
    if (!after) finer.closing.step = std::min(*half.closing.step, timeline.after());
  } catch (const CaseError&) {
    // the run itself tells
  }
  return finer;
}

}  // namespace

ErrorEstimate estimate_error(const Scene& scene, const ErrorRuns& runs,
                             const std::function<void(const std::string&)>& announce) {
  const auto each = static_cast<std::size_t>(std::max(runs.each, 1));
  const Preparation own = prepare(scene);
  const Scene half = half_of(scene, own.timeline);
  // the longest first
  std::vector<Ensemble> ensembles{
      {"half the step, twice the elements in threads", finer_of(scene, half, own), each},
      {"half the step", half, each},
      {"the case itself", scene, std::max<std::size_t>(each, 2)}};
  run_all(ensembles, runs.threads, announce);
  ErrorEstimate estimate;
  for (Ensemble& ensemble : ensembles)
    for (const std::exception_ptr& failure : ensemble.failures) {
      if (!failure) continue;
      try {
        std::rethrow_exception(failure);
      } catch (const Error& error) {
        if (&ensemble == &ensembles.back()) throw;
        estimate.stopped.push_back(ensemble.name + ": " + error.what());
      }
    }
  estimate.rows = rows_of(scene, ensembles, each);
  return estimate;
}

}  // namespace cinch
