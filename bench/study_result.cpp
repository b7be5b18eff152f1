#include "study_result.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cinch::study {

double error_of_mean(double from_the_mean, std::size_t count) {
  return from_the_mean / std::sqrt(static_cast<double>(std::max<std::size_t>(count, 2) - 1));
}

const RunResult* best_within(const ProblemResult& result, double error, double residual) {
  const RunResult* best = nullptr;
  for (const RunResult& run : result.runs)
    if (run.good() && run.residual <= residual && run.sure_error() + result.reference_error() <= error &&
        (best == nullptr || run.seconds < best->seconds))
      best = &run;
  return best;
}

static const RunResult* least_error(const ProblemResult& result, double residual) {
  const RunResult* nearest = nullptr;
  for (const RunResult& run : result.runs)
    if (run.good() && run.residual <= residual &&
        (nearest == nullptr || run.sure_error() < nearest->sure_error()))
      nearest = &run;
  return nearest;
}

std::string why_none(const ProblemResult& result, double error, double residual) {
  const RunResult* nearest = least_error(result, residual);
  if (nearest == nullptr) return "no run";
  char words[200];
  const double own = 100 * result.reference_error(), chance = 100 * nearest->uncertainty();
  char by_chance[40] = "";
  if (chance > 0) std::snprintf(by_chance, sizeof by_chance, ", by chance %.2g %% more", chance);
  if (result.reference_error() >= error)
    std::snprintf(words, sizeof words, "the reference's own error of %.2g %% decides nothing so small", own);
  else
    std::snprintf(words, sizeof words, "the nearest is off by %.2g %%%s, the reference by %.2g %%",
                  100 * nearest->error(), by_chance, own);
  return words;
}

std::vector<std::string> series_of(const ProblemResult& result) {
  std::vector<std::string> all;
  for (const RunResult& run : result.runs)
    if (std::find(all.begin(), all.end(), run.setting.series()) == all.end())
      all.push_back(run.setting.series());
  return all;
}

namespace {

// The good runs of a series from the coarsest on, as long as each is better than the one before.
std::vector<const RunResult*> falling(const ProblemResult& result, const std::string& series) {
  std::vector<const RunResult*> runs;
  for (const RunResult& run : result.runs)
    if (run.good() && run.setting.series() == series && run.error() > 0) runs.push_back(&run);
  std::stable_sort(runs.begin(), runs.end(), [](const RunResult* a, const RunResult* b) {
    return a->setting.elements < b->setting.elements;
  });
  const auto rises = [](const RunResult* a, const RunResult* b) { return b->error() >= a->error(); };
  const auto end = std::adjacent_find(runs.begin(), runs.end(), rises);
  if (end != runs.end()) runs.erase(end + 1, runs.end());
  return runs;
}

}  // namespace

double observed_order(const ProblemResult& result, const std::string& series) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  if (result.problem->chaotic()) return std::numeric_limits<double>::quiet_NaN();
  for (const RunResult* run : falling(result, series)) {
    const double length = -std::log(run->setting.elements), error = std::log(run->error());
    n += 1, x += length, y += error, xx += length * length, xy += length * error;
  }
  if (n < 3) return std::numeric_limits<double>::quiet_NaN();
  return (n * xy - x * y) / (n * xx - x * x);
}

namespace {

// The good runs of the same method and elements, from the longest step on.
std::map<std::string, std::vector<const RunResult*>> by_step(const ProblemResult& result) {
  std::map<std::string, std::vector<const RunResult*>> groups;
  for (const RunResult& run : result.runs)
    if (run.good()) groups[run.setting.but_for_the_step()].push_back(&run);
  for (auto& [name, runs] : groups)
    std::stable_sort(runs.begin(), runs.end(),
                     [](const RunResult* a, const RunResult* b) { return a->taken.step > b->taken.step; });
  return groups;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Of three runs, each of whose steps is the same part of the one before.
double step_order(const Problem& problem, const RunResult* const* runs) {
  const double factor = runs[0]->taken.step / runs[1]->taken.step;
  if (!(factor > 1) || std::abs(runs[1]->taken.step / runs[2]->taken.step / factor - 1) > 0.01) return none;
  const double first = problem.errors(runs[0]->apart, runs[1]->apart).front().second;
  const double second = problem.errors(runs[1]->apart, runs[2]->apart).front().second;
  return first > second && second > 0 ? std::log(first / second) / std::log(factor) : none;
}

// Of the shortest steps, where the same comes of those before them: else chance makes the differences.
double step_order(const Problem& problem, const std::vector<const RunResult*>& runs) {
  if (runs.size() < 4) return none;
  const RunResult* const* last = runs.data() + runs.size() - 3;
  const double order = step_order(problem, last);
  return std::abs(step_order(problem, last - 1) - order) < 0.5 ? order : none;
}

}  // namespace

std::map<std::string, double> step_orders(const ProblemResult& result) {
  std::map<std::string, double> orders;
  if (!result.problem->exact) return orders;
  for (const auto& [name, runs] : by_step(result))
    if (const double order = step_order(*result.problem, runs); std::isfinite(order)) orders[name] = order;
  return orders;
}

}  // namespace cinch::study
