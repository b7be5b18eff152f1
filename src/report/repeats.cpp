#include "report/repeats.hpp"

#include <algorithm>
#include <cmath>

#include "report/html.hpp"

namespace cinch {
namespace {

std::string words(const std::vector<double>& values, std::size_t runs, std::string_view unit) {
  std::string text = "median of " + std::to_string(runs) + " runs";
  const std::string least = html::plain(values.front(), unit), most = html::plain(values.back(), unit);
  if (least != most) text += ", " + least + " to " + most;
  if (values.size() < runs) text += ", " + std::to_string(runs - values.size()) + " without";
  return text;
}

}  // namespace

bool repeats(const ResultModel& one, const ResultModel& other) {
  const auto &a = one.closing_time, &b = other.closing_time;
  return a.has_value() == b.has_value() &&
         std::abs(a.value_or(0) - b.value_or(0)) < measure::same_closing_time;
}

std::vector<const Digest*> with_repeats(const Digest& run, const std::vector<Digest>& again) {
  std::vector<const Digest*> runs{&run};
  for (const Digest& other : again)
    if (run.paper_case == other.paper_case && repeats(run.model, other.model)) runs.push_back(&other);
  return runs;
}

Measured median_over(const std::vector<const Digest*>& runs,
                     const std::function<Measured(const Digest&)>& measure, std::string_view unit) {
  Measured first = measure(*runs.front());
  if (runs.size() == 1) return first;
  std::vector<double> values;
  for (const Digest* run : runs)
    if (const Measured one = measure(*run); one.value) values.push_back(*one.value);
  const std::size_t middle = (runs.size() - 1) / 2;
  if (values.size() <= middle) {
    const std::string few =
        "in " + std::to_string(values.size()) + " of " + std::to_string(runs.size()) + " runs";
    return {std::nullopt, first.note.empty() ? few : first.note + "; " + few};
  }
  std::sort(values.begin(), values.end());
  first.value = values[middle];
  first.note += (first.note.empty() ? "" : "; ") + words(values, runs.size(), unit);
  return first;
}

}  // namespace cinch
