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
  CaseArguments scene;
  std::filesystem::path out;  ///< empty: results/NAME, or the first free results/NAME-K
  bool overwrite = false;
  bool quiet = false;
};

int run(const RunArguments& arguments);
int check(const CaseArguments& arguments, bool resolved);
int info(const std::filesystem::path& result);
int report(const std::vector<std::filesystem::path>& results, const std::filesystem::path& html);
int compare(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace cinch::app
