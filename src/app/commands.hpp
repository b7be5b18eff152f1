// The sub-commands of `cinch`; each returns the program's exit code or throws an Error.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "input/case_reader.hpp"

namespace cinch::app {

struct CaseArguments {
  std::filesystem::path file;
  std::vector<Override> overrides;
  int threads = 0;  ///< 0: automatic
};

struct RunArguments {
  CaseArguments scene;            ///< its file is empty where a run goes on
  std::filesystem::path restart;  ///< a checkpoint or its folder; empty: begin anew
  std::filesystem::path out;      ///< empty: results/NAME, or the first free results/NAME-K; of a run that
                                  ///< goes on: where its checkpoint lies
  bool overwrite = false;
  bool quiet = false;
};

struct ReportArguments {
  std::vector<std::filesystem::path> results;
  std::vector<std::filesystem::path> open;   ///< runs with inputs changed that the paper leaves open
  std::vector<std::filesystem::path> again;  ///< runs that repeat captures, begun a little otherwise
  std::filesystem::path html;                ///< empty: report.html beside the first result
  std::filesystem::path table;               ///< Markdown table; empty: none
};

/// What `cinch check` tells besides.
struct CheckOptions {
  bool resolved = false;  ///< the case with all defaults, and nothing else
  bool error = false;     ///< how far it is from finer ones ...
  int runs = 1;           ///< ... by the means of so many runs each
};

int run(const RunArguments& arguments);
int check(const CaseArguments& arguments, const CheckOptions& options);
int info(const std::filesystem::path& result);
int report(const ReportArguments& arguments);
int compare(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace cinch::app
