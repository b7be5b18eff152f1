#include "study_result.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/version.hpp"

namespace cinch::study {
namespace {

using Json = nlohmann::ordered_json;

Json run_json(const RunResult& run) {
  Json json = {{"series", run.setting.series()},
               {"method", run.setting.method},
               {"elements", run.setting.elements},
               {"step_s", run.step},
               {"closing_step_s", run.closing_step},
               {"papers_choice", run.setting.papers},
               {"runs", run.setting.runs}};
  if (!run.good()) {
    json["failure"] = run.failure;
    return json;
  }
  for (const auto& [name, error] : run.errors) json["errors"][name] = error;
  json["energy_residual"] = run.residual;
  json["seconds_per_simulated_second"] = run.seconds;
  return json;
}

Json problem_json(const ProblemResult& result) {
  Json json = {{"name", result.problem->name},
               {"title", result.problem->title},
               {"measure", result.problem->measure},
               {"reference_error", result.reference_error},
               {"runs", Json::array()},
               {"best", Json::array()},
               {"best_of_small_residual", Json::array()},
               {"orders", Json::object()}};
  for (const RunResult& run : result.runs) json["runs"].push_back(run_json(run));
  const auto named = [&](double wanted, const RunResult* best) {
    return Json{{"error", wanted}, {"run", best ? Json(best - result.runs.data()) : Json()}};
  };
  for (const double wanted : wanted_errors) {
    json["best"].push_back(named(wanted, best_within(result, wanted)));
    json["best_of_small_residual"].push_back(named(wanted, best_within(result, wanted, small_residual)));
  }
  for (const std::string& series : series_of(result))
    if (const double order = observed_order(result, series); std::isfinite(order))
      json["orders"][series] = order;
  return json;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  if (!(out << text).flush()) throw FileError("error: " + file.string() + " cannot be written");
}

}  // namespace

double RunResult::uncertainty() const {
  for (const auto& [name, value] : errors)
    if (name == "uncertainty") return value;
  return 0;
}

double error_of_mean(double from_the_mean, std::size_t count) {
  return from_the_mean / std::sqrt(static_cast<double>(std::max<std::size_t>(count, 2) - 1));
}

const RunResult* best_within(const ProblemResult& result, double error, double residual) {
  const RunResult* best = nullptr;
  for (const RunResult& run : result.runs)
    if (run.good() && run.residual <= residual &&
        run.error() + run.uncertainty() + result.reference_error <= error &&
        (best == nullptr || run.seconds < best->seconds))
      best = &run;
  return best;
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

void write(const std::vector<ProblemResult>& results, const std::filesystem::path& folder) {
  Json json = {{"version", version},
               {"commit", commit},
               {"compiler", compiler},
               {"isa", kernels().isa},
               {"problems", Json::array()}};
  std::string csv =
      "problem,series,method,elements,step_s,closing_step_s,papers_choice,error,energy_residual,"
      "seconds_per_simulated_second,failure\n";
  for (const ProblemResult& result : results) {
    json["problems"].push_back(problem_json(result));
    for (const RunResult& run : result.runs) {
      char numbers[200];
      std::snprintf(numbers, sizeof numbers, "%d,%.9g,%.9g,%d,%.9g,%.9g,%.9g", run.setting.elements, run.step,
                    run.closing_step, run.setting.papers, run.good() ? run.error() : NAN, run.residual,
                    run.seconds);
      csv += result.problem->name + ",\"" + run.setting.series() + "\",\"" + run.setting.method + "\"," +
             numbers + ",\"" + run.failure.substr(0, run.failure.find('"')) + "\"\n";
    }
  }
  write_text(folder / "study.json", json.dump(1) + "\n");
  write_text(folder / "study.csv", csv);
}

}  // namespace cinch::study
