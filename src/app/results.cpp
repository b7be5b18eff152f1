// `cinch info`, `cinch report` and `cinch compare`: what to do with results.
#include <iostream>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "output/compare.hpp"
#include "output/info.hpp"
#include "output/result_reader.hpp"
#include "report/report.hpp"

namespace cinch::app {

int info(const std::filesystem::path& result) {
  print_info(Result(result), std::cout);
  return 0;
}

int report(const std::vector<std::filesystem::path>& paths, const std::filesystem::path& html) {
  std::vector<Result> results;
  for (const auto& path : paths) results.emplace_back(path);
  std::filesystem::path target = html;
  if (target.empty()) target = results.front().path().parent_path() / "report.html";
  write_report(results, target);
  for (const Result& result : results) print_verdict(result, std::cout);
  std::cout << "report: " << target.string() << "\n";
  return 0;
}

int compare(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Comparison found = compare_results(Result(a), Result(b));
  print_comparison(found, std::cout);
  return found.identical ? 0 : static_cast<int>(ExitCode::different);
}

}  // namespace cinch::app
