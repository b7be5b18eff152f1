// `cinch info`, `cinch report` and `cinch compare`: what to do with results.
#include <iostream>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "output/compare.hpp"
#include "output/info.hpp"
#include "output/report_file.hpp"
#include "output/result_layout.hpp"
#include "output/result_reader.hpp"
#include "report/open_inputs.hpp"
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
  std::vector<Digest> variants;
  for (const auto& path : arguments.open) {
    variants.push_back(digest(Result(path)));
    const std::string& why = variants.back().unjudged;
    if (!why.empty()) std::cerr << "warning: --open " << path.string() << " is left out: " << why << "\n";
  }
  const Sensitivity open_inputs = range_over(variants);
  write_report(results, html, open_inputs);
  if (!arguments.table.empty()) write_paper_table(results, arguments.table, open_inputs);
  for (const Result& result : results) print_verdict(result, std::cout);
  std::cout << "report: " << html.string() << "\n";
  return 0;
}

int compare(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Comparison found = compare_results(Result(a), Result(b));
  print_comparison(found, std::cout);
  return found.identical ? 0 : static_cast<int>(ExitCode::different);
}

}  // namespace cinch::app
