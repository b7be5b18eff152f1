// The stability matrix: cinch_stability FOLDER [--full] [--only TEXT] runs all cells, each in a process of
// its own, prints them as a table and writes stability.json. Exit code 3 where a cell FAILED.
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "matrix/groups.hpp"
#include "matrix/isolated.hpp"
#include "matrix/report.hpp"

namespace cinch::matrix {
namespace {

struct Arguments {
  std::string folder, only;
  Extent extent = Extent::quick;
};

bool read(int argc, char** argv, Arguments& to) {
  if (argc < 2 || argv[1][0] == '-') return false;
  to.folder = argv[1];
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--full") == 0) to.extent = Extent::full;
    else if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) to.only = argv[++i];
    else return false;
  }
  return true;
}

bool wanted(const Cell& cell, const std::string& only) {
  return (cell.group + ": " + cell.parameter + ": " + cell.value).find(only) != std::string::npos;
}

/// Far longer than any cell takes: a run that is not done by then hangs.
int patience(Extent extent) { return extent == Extent::full ? 900 : 120; }  // s

int run(const Arguments& given) {
  std::vector<Judged> all;
  print_head();
  for (const Cell& cell : all_cells(given.extent)) {
    if (!wanted(cell, given.only)) continue;
    all.push_back({cell, isolated([&] { return judge(cell); }, patience(given.extent))});
    print_row(all.back());
  }
  print_counts(all);
  write(all, given.extent, given.folder);
  for (const Count& count : counts(all))
    if (count.failed > 0) return static_cast<int>(ExitCode::numerical);
  return 0;
}

}  // namespace
}  // namespace cinch::matrix

int main(int argc, char** argv) {
  using namespace cinch;
  matrix::Arguments given;
  if (!matrix::read(argc, argv, given)) {
    std::fprintf(stderr, "usage: cinch_stability FOLDER [--full] [--only TEXT]\n");
    return static_cast<int>(ExitCode::usage);
  }
  try {
    return matrix::run(given);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code);
  }
}
