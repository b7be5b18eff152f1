// Error against run time, on one thread: cinch_study FOLDER [--full|--trial] [--only NAME]... writes
// study.json and study.csv.
//
// The reference of a problem is its exact solution, or else the mean of its finest runs; how far they lie
// from that is its own error.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "study_file.hpp"
#include "study_measure.hpp"

namespace cinch::study {
namespace {

struct Arguments {
  std::string folder;
  Extent extent = Extent::usual;
  std::vector<std::string> only;  // names of problems; all where empty
};

bool read(int argc, char** argv, Arguments& to) {
  if (argc < 2 || argv[1][0] == '-') return false;
  to.folder = argv[1];
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--full") == 0) to.extent = Extent::full;
    else if (std::strcmp(argv[i], "--trial") == 0) to.extent = Extent::trial;
    else if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) to.only.emplace_back(argv[++i]);
    else return false;
  }
  return true;
}

// Throws for a name that no problem has.
void check_names(const std::vector<Problem>& problems, const std::vector<std::string>& only) {
  std::string names;
  for (const Problem& problem : problems) names += (names.empty() ? "" : ", ") + problem.name;
  for (const std::string& name : only)
    if (std::none_of(problems.begin(), problems.end(), [&](const Problem& p) { return p.name == name; }))
      throw Error(ExitCode::usage, "error: no problem '" + name + "'; there are: " + names);
}

bool wanted(const Problem& problem, const std::vector<std::string>& only) {
  return only.empty() || std::count(only.begin(), only.end(), problem.name) > 0;
}

void print(const RunResult& run) {
  const Setting& setting = run.setting;
  if (run.good())
    std::printf("  %-58s %4d elements  error %8.4f %%  %9.3g s/s  residual %.1e%s\n",
                setting.series().c_str(), setting.elements, 100 * run.error(), run.seconds, run.residual,
                setting.papers ? "  the paper's choice" : "");
  else
    std::printf("  %-58s %4d elements  stopped: %.60s...\n", setting.series().c_str(), setting.elements,
                run.failure.c_str());
  std::fflush(stdout);
}

ProblemResult study(const Problem& problem) {
  std::printf("%s: %s\n", problem.name.c_str(), problem.title.c_str());
  const Reference reference = reference_of(problem);
  ProblemResult result{&problem, reference.errors, {}};
  std::printf("  error: %s\n  the reference's own: %.4f %%\n", problem.measure.c_str(),
              100 * result.reference_error());
  for (const Setting& setting : problem.settings) {
    result.runs.push_back(run(problem, setting, reference.track));
    print(result.runs.back());
  }
  return result;
}

void print_best(const ProblemResult& result, double wanted, const char* besides, double residual) {
  std::printf("  within %4.1f %%%s: ", 100 * wanted, besides);
  if (const RunResult* best = best_within(result, wanted, residual))
    std::printf("%s, %d elements: %.3g s a simulated second\n", best->setting.series().c_str(),
                best->setting.elements, best->seconds);
  else std::printf("none: %s\n", why_none(result, wanted, residual).c_str());
}

void print_end(const ProblemResult& result) {
  for (const double wanted : wanted_errors) {
    print_best(result, wanted, "", INFINITY);
    print_best(result, wanted, ", residual within 1e-4", small_residual);
  }
  for (const std::string& series : series_of(result))
    if (const double order = observed_order(result, series); std::isfinite(order))
      std::printf("  order %5.2f: %s\n", order, series.c_str());
  for (const auto& [elements, order] : step_orders(result))
    std::printf("  order %5.2f in the step: %s\n", order, elements.c_str());
}

void run_all(const Arguments& given) {
  const std::vector<Problem> all = problems(given.extent);
  check_names(all, given.only);
  std::vector<ProblemResult> results;
  for (const Problem& problem : all) {
    if (!wanted(problem, given.only)) continue;
    results.push_back(study(problem));
    print_end(results.back());
  }
  write(results, all, given.extent, given.folder);
}

}  // namespace
}  // namespace cinch::study

int main(int argc, char** argv) {
  using namespace cinch;
  study::Arguments given;
  if (!study::read(argc, argv, given)) {
    std::fprintf(stderr, "usage: cinch_study FOLDER [--full|--trial] [--only NAME]...\n");
    return static_cast<int>(ExitCode::usage);
  }
  try {
    study::run_all(given);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code);
  }
}
