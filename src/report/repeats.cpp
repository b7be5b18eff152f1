#include "report/repeats.hpp"

#include <algorithm>
#include <cmath>

#include "report/html.hpp"

namespace cinch {
namespace {

// What the runs say of one number.
struct Sample {
  std::vector<double> values;  // in order
  std::size_t late = 0;
  std::string note;  // of all runs

  Sample(const std::vector<const Digest*>& runs, const std::function<Measured(const Digest&)>& measure) {
    for (const Digest* run : runs) {
      const Measured one = measure(*run);
      if (one.value) values.push_back(*one.value);
      else if (one.late) ++late;
      if (run == runs.front()) note = one.note;
      else if (note != one.note) note.clear();
    }
    std::sort(values.begin(), values.end());
  }

  std::size_t decided() const { return values.size() + late; }
  std::optional<double> median() const {
    if (2 * values.size() <= decided()) return std::nullopt;
    const std::size_t upper = decided() / 2;
    return decided() % 2 == 1 ? values[upper] : 0.5 * (values[upper - 1] + values[upper]);
  }
  std::string words(std::string_view unit) const {
    std::string text = "median of " + std::to_string(decided()) + " runs";
    const std::string least = html::plain(values.front(), unit), most = html::plain(values.back(), unit);
    if (least != most) text += ", " + least + " to " + most;
    if (late > 0) text += ", in " + std::to_string(late) + " not by the end";
    return text;
  }
};

}  // namespace

bool repeats(const ResultModel& one, const ResultModel& other) {
  return one.closing_time && other.closing_time &&
         std::abs(*one.closing_time - *other.closing_time) < measure::same_closing_time;
}

std::vector<const Digest*> with_repeats(const Digest& run, const std::vector<Digest>& again) {
  std::vector<const Digest*> runs{&run};
  for (const Digest& other : again)
    if (run.paper_case == other.paper_case && repeats(run.model, other.model)) runs.push_back(&other);
  return runs;
}

Measured median_over(const std::vector<const Digest*>& runs,
                     const std::function<Measured(const Digest&)>& measure, std::string_view unit) {
  if (runs.size() == 1) return measure(*runs.front());
  const Sample sample(runs, measure);
  const std::optional<double> median = sample.median();
  const std::string words =
      median ? sample.words(unit)
             : "in " + std::to_string(sample.values.size()) + " of " + std::to_string(runs.size()) + " runs";
  return {median, sample.note.empty() ? words : sample.note + "; " + words};
}

}  // namespace cinch
