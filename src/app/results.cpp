// `cinch info`, `cinch report` and `cinch compare`: what to do with results.
#include <iostream>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "output/compare.hpp"
#include "output/info.hpp"
#include "output/result_reader.hpp"
#include "report/open_inputs.hpp"
#include "report/report.hpp"

namespace cinch::app {

int info(const std::filesystem::path& result) {
  print_info(Result(result), std::cout);
  return 0;
}

int report(const ReportArguments& arguments) {
  std::vector<Result> results;
  for (const auto& path : arguments.results) results.emplace_back(path);
  std::vector<Digest> variants;
  for (const auto& path : arguments.open) variants.push_back(digest(Result(path)));
  const Sensitivity open_inputs = range_over(variants);
  std::filesystem::path html = arguments.html;
  if (html.empty()) html = results.front().path().parent_path() / "report.html";
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
