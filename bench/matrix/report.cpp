// Markdown on stdout, JSON in a file.
#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/version.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::matrix {
namespace {

using Json = nlohmann::ordered_json;

Json cell_json(const Judged& one) {
  Json json = {{"group", one.cell.group},
               {"parameter", one.cell.parameter},
               {"value", one.cell.value},
               {"must", words_of_must(one.cell)},
               {"verdict", words(one.outcome.verdict)},
               {"residual", one.outcome.residual},
               {"steps", one.outcome.steps},
               {"message", one.outcome.message},
               {"place", Json::object()}};
  for (const auto& [name, value] : one.cell.place) json["place"][name] = value;
  return json;
}

/// One line, no bars: fit for a cell of a table.
std::string in_a_row(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::vector<Count> counts(const std::vector<Judged>& all) {
  std::vector<Count> list;
  for (const Judged& one : all) {
    if (list.empty() || list.back().group != one.cell.group) list.push_back({one.cell.group});
    Count& count = list.back();
    ++(one.outcome.verdict == Verdict::held      ? count.held
       : one.outcome.verdict == Verdict::stopped ? count.stopped
                                                 : count.failed);
  }
  return list;
}

void print_head() {
  std::printf(
      "| group | parameter | value | must | verdict | residual | steps | message |\n"
      "|---|---|---|---|---|---|---|---|\n");
}

void print_row(const Judged& one) {
  std::printf("| %s | %s | %s | %s | %s | %.1e | %lld | %s |\n", one.cell.group.c_str(),
              one.cell.parameter.c_str(), one.cell.value.c_str(), words_of_must(one.cell).c_str(),
              words(one.outcome.verdict).c_str(), one.outcome.residual,
              static_cast<long long>(one.outcome.steps), in_a_row(one.outcome.message).c_str());
  std::fflush(stdout);
}

void print_counts(const std::vector<Judged>& all) {
  std::printf("\n| group | held | stopped | FAILED |\n|---|---|---|---|\n");
  for (const Count& count : counts(all))
    std::printf("| %s | %d | %d | %d |\n", count.group.c_str(), count.held, count.stopped, count.failed);
}

void write(const std::vector<Judged>& all, Extent extent, const std::filesystem::path& folder) {
  Json json = {{"version", version},
               {"commit", commit},
               {"compiler", compiler},
               {"isa", kernels().isa},
               {"mode", extent == Extent::full ? "full" : "quick"},
               {"groups", Json::array()},
               {"cells", Json::array()}};
  for (const Count& count : counts(all))
    json["groups"].push_back(
        {{"name", count.group}, {"held", count.held}, {"stopped", count.stopped}, {"failed", count.failed}});
  for (const Judged& one : all) json["cells"].push_back(cell_json(one));
  const std::filesystem::path file = folder / "stability.json";
  std::ofstream out(file);
  if (!(out << json.dump(1) << "\n").flush())
    throw FileError("error: " + file.string() + " cannot be written");
}

}  // namespace cinch::matrix
