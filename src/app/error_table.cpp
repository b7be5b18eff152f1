#include "app/error_table.hpp"

#include <cmath>
#include <cstdio>

namespace cinch::app {
namespace {

// Of a row's size, "-" where it is not known.
std::string percent(double difference, double size) {
  if (std::isnan(difference) || !(size > 0)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * difference / size);
  return text;
}

// Rounded up: a bound holds as it is printed.
std::string percent_bound(const ErrorEstimate::Row& row) {
  const double share = 100 * row.bound() / row.size;
  const double digit = std::pow(10.0, std::floor(std::log10(share)) - 1);
  char text[32];
  std::snprintf(text, sizeof text, "< %.2g %%", std::ceil(share / digit) * digit);
  return text;
}

std::string error_of(const ErrorEstimate::Row& row) {
  if (!row.by_chance()) return percent(row.error(), row.size);
  return row.bounded() ? percent_bound(row) : "by chance";
}

std::string size_of(const ErrorEstimate::Row& row) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g %s", row.size, row.unit.c_str());
  return text;
}

void print_row(const ErrorEstimate::Row& row) {
  if (row.still) {
    std::printf("  %-24s %-19s does not move\n", row.name.c_str(), row.measure.c_str());
    return;
  }
  std::printf("  %-24s %-19s %14s %10s %10s %10s %10s\n", row.name.c_str(), row.measure.c_str(),
              size_of(row).c_str(), percent(row.difference[ErrorEstimate::of_step], row.size).c_str(),
              percent(row.difference[ErrorEstimate::of_threads], row.size).c_str(),
              percent(row.difference[ErrorEstimate::of_chance], row.size).c_str(), error_of(row).c_str());
}

}  // namespace

void print_error(const ErrorEstimate& estimate) {
  std::printf(
      "error            differences from runs with half the step, with twice the elements in threads "
      "besides, "
      "and what chance makes of both\n");
  std::printf("  %-24s %-19s %14s %10s %10s %10s %10s\n", "what", "measure", "size", "step", "threads",
              "chance", "error");
  bool chance = false, bound = false;
  for (const ErrorEstimate::Row& row : estimate.rows) {
    print_row(row);
    if (row.still) continue;
    chance = chance || (row.by_chance() && !row.bounded());
    bound = bound || (row.by_chance() && row.bounded());
  }
  std::printf(
      "                 error: twice the differences of step and threads, as at first order; nets keep their "
      "elements\n");
  if (bound)
    std::printf(
        "                 < : nodes that begin %g m elsewhere would make half of both differences or more; a "
        "bound, "
        "twice the differences with twice the chance in each\n",
        ErrorEstimate::nudge);
  if (chance)
    std::printf(
        "                 by chance: nodes that begin %g m elsewhere would make half of both differences or "
        "more; --runs N compares means\n",
        ErrorEstimate::nudge);
  for (const std::string& what : estimate.stopped) std::printf("stopped          %s\n", what.c_str());
}

}  // namespace cinch::app
