#include "study_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/version.hpp"

namespace cinch::study {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Errors& errors) {
  Json json = Json::object();
  for (const auto& [name, error] : errors) json[name] = error;
  return json;
}

Json run_json(const RunResult& run) {
  Json json = {{"series", run.setting.series()},
               {"method", run.setting.method},
               {"elements", run.setting.elements},
               {"step_s", run.taken.step},
               {"closing_step_s", run.taken.closing_step},
               {"fraction", run.taken.fraction},
               {"closing_fraction", run.taken.closing_fraction},
               {"joint_steps", run.taken.joint_steps},
               {"but_for_the_step", run.setting.but_for_the_step()},
               {"papers_choice", run.setting.papers},
               {"runs", run.setting.runs}};
  if (!run.good()) {
    json["failure"] = run.failure;
    return json;
  }
  json["errors"] = json_of(run.errors);
  if (run.setting.runs > 1) {
    json["errors"]["one_run_from_the_mean"] = run.one_run;
    json["errors"]["uncertainty"] = run.uncertainty();
    json["uncertainties"] = json_of(run.uncertainties);
  }
  json["energy_residual"] = run.residual;
  json["seconds_per_simulated_second"] = run.seconds;
  return json;
}

// Of each measure what the reference may be off by, and whether it hangs on chance.
Json measures_json(const ProblemResult& result) {
  Json json = Json::object();
  const std::vector<std::string>& chaotic = result.problem->chaotic_measures;
  for (const RunResult& run : result.runs)
    for (const auto& [name, error] : run.errors)
      json[name] = {{"reference_error", 0},
                    {"chaotic", std::count(chaotic.begin(), chaotic.end(), name) > 0}};
  for (const auto& [name, error] : result.reference_errors)
    if (json.contains(name)) json[name]["reference_error"] = error;
  return json;
}

Json best_json(const ProblemResult& result, double residual) {
  Json all = Json::array();
  for (const double wanted : wanted_errors) {
    const RunResult* best = best_within(result, wanted, residual);
    all.push_back({{"error", wanted}, {"run", best ? Json(best - result.runs.data()) : Json()}});
    if (best == nullptr) all.back()["why"] = why_none(result, wanted, residual);
  }
  return all;
}

Json problem_json(const ProblemResult& result) {
  Json json = {{"name", result.problem->name},
               {"title", result.problem->title},
               {"measure", result.problem->measure},
               {"reference_error", result.reference_error()},
               {"measures", measures_json(result)},
               {"runs", Json::array()},
               {"best", best_json(result, INFINITY)},
               {"best_of_small_residual", best_json(result, small_residual)},
               {"orders", Json::object()},
               {"step_orders", step_orders(result)}};
  for (const RunResult& run : result.runs) json["runs"].push_back(run_json(run));
  for (const std::string& series : series_of(result))
    if (const double order = observed_order(result, series); std::isfinite(order))
      json["orders"][series] = order;
  return json;
}

const char* name_of(Extent extent) {
  return extent == Extent::full ? "full" : extent == Extent::trial ? "trial" : "usual";
}

// By what and to which extent a study was made.
Json head_json(Extent extent) {
  return {{"version", version},
          {"commit", commit},
          {"compiler", compiler},
          {"isa", kernels().isa},
          {"extent", name_of(extent)}};
}

// The problem of that name in a study made as `head` says; null where there is none.
Json kept(const Json& before, const Json& head, const std::string& name) {
  if (!before.is_object() || !before.contains("problems")) return {};
  for (const auto& [key, value] : head.items())
    if (!before.contains(key) || before[key] != value) return {};
  for (const Json& problem : before["problems"])
    if (problem["name"] == name) return problem;
  return {};
}

Json study_json(const std::vector<ProblemResult>& results, const std::vector<Problem>& all, const Json& head,
                const Json& before) {
  Json json = head;
  json["problems"] = Json::array();
  for (const Problem& problem : all) {
    const auto found = std::find_if(results.begin(), results.end(),
                                    [&](const ProblemResult& r) { return r.problem->name == problem.name; });
    const Json one = found != results.end() ? problem_json(*found) : kept(before, head, problem.name);
    if (!one.is_null()) json["problems"].push_back(one);
  }
  return json;
}

// All measures of all problems, each once.
std::vector<std::string> measures_of(const Json& study) {
  std::vector<std::string> names;
  for (const Json& problem : study["problems"])
    for (const auto& [name, measure] : problem["measures"].items())
      if (name != "error" && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  return names;
}

std::string cell(const Json& value) {
  if (value.is_string()) {
    const std::string text = value;
    return "\"" + text.substr(0, text.find('"')) + "\"";
  }
  if (value.is_boolean()) return value ? "1" : "0";
  if (value.is_null()) return "nan";
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.9g", value.get<double>());
  return digits;
}

std::string row(const Json& problem, const Json& run, const std::vector<std::string>& measures) {
  std::string text = problem["name"];
  for (const char* key : {"series", "method", "elements", "step_s", "closing_step_s", "fraction",
                          "closing_fraction", "joint_steps", "papers_choice", "runs"})
    text += "," + cell(run[key]);
  const Json errors = run.value("errors", Json::object());
  text += "," + cell(errors.value("error", Json())) + "," + cell(errors.value("uncertainty", Json(0)));
  text += "," + cell(problem["reference_error"]);
  for (const std::string& name : measures) text += "," + (errors.contains(name) ? cell(errors[name]) : "");
  for (const char* key : {"energy_residual", "seconds_per_simulated_second"})
    text += "," + cell(run.value(key, Json(0)));
  return text + "," + cell(run.value("failure", Json(""))) + "\n";
}

std::string csv_of(const Json& study) {
  const std::vector<std::string> measures = measures_of(study);
  std::string text =
      "problem,series,method,elements,step_s,closing_step_s,fraction,closing_fraction,joint_steps,"
      "papers_choice,runs,error,uncertainty,reference_error";
  for (const std::string& name : measures) text += ",errors." + name;
  text += ",energy_residual,seconds_per_simulated_second,failure\n";
  for (const Json& problem : study["problems"])
    for (const Json& run : problem["runs"]) text += row(problem, run, measures);
  return text;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  if (!(out << text).flush()) throw FileError("error: " + file.string() + " cannot be written");
}

}  // namespace

void write(const std::vector<ProblemResult>& results, const std::vector<Problem>& all, Extent extent,
           const std::filesystem::path& folder) {
  std::ifstream file(folder / "study.json");
  const Json before = file ? Json::parse(file, nullptr, false) : Json();  // none where it cannot be read
  // NaN becomes null on the way through text, for the table, too
  const Json study = Json::parse(study_json(results, all, head_json(extent), before).dump());
  write_text(folder / "study.json", study.dump(1) + "\n");
  write_text(folder / "study.csv", csv_of(study));
}

}  // namespace cinch::study
