// `cinch info`, `cinch report` and `cinch compare`: what to do with results.
#include <algorithm>
#include <iostream>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "output/compare.hpp"
#include "output/info.hpp"
#include "output/report_file.hpp"
#include "output/result_layout.hpp"
#include "output/result_reader.hpp"
#include "report/open_inputs.hpp"
#include "report/repeats.hpp"
#include "report/report.hpp"

namespace cinch::app {
namespace {

namespace fs = std::filesystem;

void require_own_files(const fs::path& page, const fs::path& table) {
  require_own(page, is_report_page);
  if (table.empty()) return;
  require_own(table, is_report_table);
  if (fs::absolute(page).lexically_normal() == fs::absolute(table).lexically_normal())
    throw Error(ExitCode::usage, "error: page and table would be the same file: " + table.string());
}

// Of runs that an option names; those that are not the paper's scene count for nothing.
std::vector<Digest> digests_of(const char* option, const std::vector<fs::path>& paths) {
  std::vector<Digest> digests;
  for (const fs::path& path : paths) {
    digests.push_back(digest(Result(path)));
    const std::string& why = digests.back().unjudged;
    if (!why.empty())
      std::cerr << "warning: " << option << " " << path.string() << " is left out: " << why << "\n";
  }
  return digests;
}

// Why a run repeats none of the results; empty where it does.
std::string no_repeat(const Digest& run, const std::vector<Result>& results) {
  const auto repeated = [&](const Result& result) { return repeats(run.model, result.model()); };
  const auto the_same = [&](const Result& result) { return fs::equivalent(run.file, result.path()); };
  if (run.paper_case != PaperCase::capture) return "only captures are made again";
  if (std::any_of(results.begin(), results.end(), the_same)) return "it is one of the results";
  if (std::none_of(results.begin(), results.end(), repeated)) return "no result closes at its time";
  return "";
}

// Captures that repeat one of the results.
std::vector<Digest> repeats_among(const std::vector<fs::path>& paths, const std::vector<Result>& results) {
  std::vector<Digest> all = digests_of("--again", paths), runs;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!all[i].unjudged.empty()) continue;
    const std::string why = no_repeat(all[i], results);
    if (why.empty()) runs.push_back(std::move(all[i]));
    else std::cerr << "warning: --again " << paths[i].string() << " is left out: " << why << "\n";
  }
  return runs;
}

}  // namespace

int info(const std::filesystem::path& result) {
  print_info(Result(result), std::cout);
  return 0;
}

int report(const ReportArguments& arguments) {
  std::vector<Result> results;
  for (const auto& path : arguments.results) results.emplace_back(path);
  fs::path html = arguments.html;
  if (html.empty()) html = results.front().path().parent_path() / layout::kReportFile;
  require_own_files(html, arguments.table);
  const Sensitivity open_inputs = range_over(digests_of("--open", arguments.open));
  const std::vector<Digest> again = repeats_among(arguments.again, results);
  write_report(results, html, open_inputs, again);
  if (!arguments.table.empty()) write_paper_table(results, arguments.table, open_inputs, again);
  for (const Result& result : results) print_verdict(result, std::cout, again);
  std::cout << "report: " << html.string() << "\n";
  return 0;
}

int compare(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Comparison found = compare_results(Result(a), Result(b));
  print_comparison(found, std::cout);
  return found.identical ? 0 : static_cast<int>(ExitCode::different);
}

}  // namespace cinch::app
