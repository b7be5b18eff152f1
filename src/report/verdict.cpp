#include "report/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "report/html.hpp"
#include "report/measure.hpp"
#include "report/repeats.hpp"

namespace cinch {
namespace {

bool holds(const PaperNumber& paper, double here) {
  const double rounding = 1e-9 * std::max(1.0, std::abs(paper.value));
  switch (paper.rule) {
    case Rule::at_most:
      return here <= paper.value + rounding;
    case Rule::at_least:
      return here >= paper.value - rounding;
    default:
      return std::abs(here - paper.value) <= paper.tolerance + rounding;
  }
}

bool range_allows(const PaperNumber& paper, const OpenRange& range) {
  if (paper.rule == Rule::near)
    return range.low - paper.tolerance <= paper.value && paper.value <= range.high + paper.tolerance;
  return holds(paper, range.low) || holds(paper, range.high);
}

std::string joined(std::string first, const std::string& second) {
  if (first.empty()) return second;
  return second.empty() ? first : first + "; " + second;
}

/// Fills the table row by row.
class Table {
 public:
  /// `base`: the result that the paper's own run is compared with.
  Table(const Sensitivity& sensitivity, bool several, const Digest* base)
      : sensitivity_(sensitivity), several_(several), base_(base) {}

  void row(const std::string& key, const Measured& measured, const Digest* of = nullptr) {
    VerdictRow row;
    row.paper = &paper_number(key);
    row.note = joined(std::string(row.paper->note), measured.note);
    if (several_ && of) row.result = of->label();
    // the study of the open inputs varies the paper's own run: it says nothing about the others
    const auto range = of == base_ || of == nullptr ? sensitivity_.find(key) : sensitivity_.end();
    const bool known = range != sensitivity_.end();
    if (known && range->second.low < range->second.high) row.note = joined(row.note, range->second.note);
    if (measured.value && std::isfinite(*measured.value)) {
      row.here = measured.value;
      row.verdict = judge(*row.paper, *row.here, known ? &range->second : nullptr);
    }
    rows.push_back(std::move(row));
  }

  std::vector<VerdictRow> rows;

 private:
  const Sensitivity& sensitivity_;
  bool several_;
  const Digest* base_;
};

using Results = std::vector<const Digest*>;

Results by_elements(Results results) {
  std::stable_sort(results.begin(), results.end(), [](const Digest* a, const Digest* b) {
    return a->thread_elements() < b->thread_elements();
  });
  return results;
}

// The least value over all results: one row says that every one of them passes.
template <class Measure>
Measured least_of(const Results& results, Measure measure) {
  Measured least;
  for (const Digest* d : results) {
    const Measured one = measure(*d);
    if (!one.value) return one;
    if (!least.value || *one.value < *least.value) least = one;
  }
  if (results.size() > 1)
    least.note = joined(least.note, "least of " + std::to_string(results.size()) + " results");
  return least;
}

void ring_pull_forces(const Results& results, Table& table) {
  for (const Digest* d : results) {
    const int n = d->thread_elements();
    if (n == 50 || n == 100 || n == 200 || n == 300)
      table.row("ring_pull.force_" + std::to_string(n), measure::peak_ring_force(*d), d);
  }
  table.row("ring_pull.force_falls", measure::greatest_force_rise(results));
}

std::string listed(const Digest& d, double value, const PaperNumber& paper) {
  return d.label() + ": " + html::plain(value, paper.unit);
}

// The finest result stands in the row. Results that come nearer to the limit as elements are added converge,
// even if the finest has not arrived.
template <class Measure>
void limit_row(const Results& results, const std::string& key, Table& table, Measure measure) {
  const PaperNumber& paper = paper_number(key);
  Measured finest;
  bool nearer = results.size() > 1;
  std::string others;
  double last = 0;
  for (const Digest* d : results) {
    const Measured one = measure(*d);
    if (one.value && d != results.back()) others = joined(others, listed(*d, *one.value, paper));
    const double off = one.value ? std::abs(*one.value - paper.value) : 0;
    nearer = nearer && one.value && (d == results.front() || off < last || off <= paper.tolerance);
    last = off;
    finest = one;
  }
  finest.note = joined(finest.note, others);
  table.row(key, finest, results.back());
  if (nearer) table.rows.back().verdict = Verdict::converges;
}

void ring_pull_limits(const Results& results, Table& table) {
  const auto ball = [](int axis) {
    return [axis](const Digest& d) { return measure::mass_at(d, 0, axis, 1.0); };
  };
  limit_row(results, "ring_pull.ball_y", table, ball(1));
  limit_row(results, "ring_pull.ball_z", table, ball(2));
  limit_row(results, "ring_pull.ring_y", table,
            [](const Digest& d) { return measure::ring_at(d, 0, 1, 1.0); });
}

void ring_pull_table(const Results& unsorted, Table& table) {
  const Results results = by_elements(unsorted);
  table.row("ring_pull.passes", least_of(results, measure::ball_ahead_of_ring));
  table.row("ring_pull.drags", least_of(results, measure::ring_end_speed));
  ring_pull_forces(results, table);
  table.row("ring_pull.coincide", measure::curves_apart(results, 200, 300));
  bool fewer = false;
  for (const Digest* d : results) {
    if (d->thread_elements() >= 200) break;
    table.row("ring_pull.fewer_larger", measure::beyond(*d, results, 200), d);
    fewer = true;
  }
  if (!fewer) table.row("ring_pull.fewer_larger", {});
  ring_pull_limits(results, table);
}

template <class Measure>
void row_each(const Results& results, const char* key, Table& table, Measure measure) {
  for (const Digest* d : results) table.row(key, measure(*d), d);
}

void edge_closure_table(const Results& results, Table& table) {
  const auto left_above = [](const Digest& d) { return measure::left_above_right(d, 0.5); };
  row_each(results, "edge_closure.rest", table, measure::start_speed);
  row_each(results, "edge_closure.bunched", table,
           [](const Digest& d) { return measure::spread_at(d, 0.5); });
  row_each(results, "edge_closure.left_above", table, left_above);
  row_each(results, "edge_closure.slightly", table, left_above);
}

// How far from the paper's 1.5 s a result closes, s.
double off_closing_time(const Digest* d) {
  return d->model.closing_time ? std::abs(*d->model.closing_time - 1.5) : 1e9;
}

Results nearest_closing_time_first(Results results) {
  std::stable_sort(results.begin(), results.end(), [](const Digest* a, const Digest* b) {
    return off_closing_time(a) < off_closing_time(b);
  });
  return results;
}

// All but Fig. 14 is of the run that closes at 1.5 s; null where there is none.
const Digest* paper_run(const Results& results) {
  const Digest* nearest = nearest_closing_time_first(results).front();
  return off_closing_time(nearest) < measure::same_closing_time ? nearest : nullptr;
}

// Rows of captures, each number the median over the runs that repeat one.
class CaptureRows {
 public:
  CaptureRows(const Results& unsorted, const std::vector<Digest>& again, Table& table)
      : results_(nearest_closing_time_first(unsorted)),
        run_(paper_run(results_)),
        again_(again),
        table_(table) {}

  void fill() {
    of_run("capture.first_touch", measure::first_touch);
    of_run("capture.closes_after", measure::closed_after);
    if (results_.size() > 1) of_each("capture.closed_by", measure::closed_after);
    of_each("capture.enclosed", measure::enclosed);
    velocities();
    rings();
    std::set<const Digest*> all;  // one may repeat several
    for (const Digest* d : results_)
      for (const Digest* repeat : with_repeats(*d, again_)) all.insert(repeat);
    table_.row("capture.later_further", measure::least_gain_along_z({all.begin(), all.end()}));
  }

 private:
  using Measure = std::function<Measured(const Digest&)>;

  void add(const std::string& key, const Digest& of, const Measure& measure) {
    table_.row(key, median_over(with_repeats(of, again_), measure, paper_number(key).unit), &of);
  }
  void of_run(const std::string& key, const Measure& measure) {
    if (run_) add(key, *run_, measure);
    else table_.row(key, {{}, "needs a result that closes at 1.5 s"});
  }
  void of_each(const std::string& key, const Measure& measure) {
    for (const Digest* d : results_) add(key, *d, measure);
  }

  void velocities() {
    for (int axis = 0; axis < 3; ++axis)
      of_run(std::string("capture.jump_") + "xyz"[axis],
             [axis](auto& d) { return measure::separation_jump(d, axis); });
    of_run("capture.a1_falls", [](auto& d) { return measure::share_lost(d, 0); });
    of_run("capture.a1_turns", measure::turns_positive_after);
    of_run("capture.a1_y_steady", measure::y_change_over_x);
    of_run("capture.mirror", measure::mirror_departure);
  }
  void rings() {
    for (const char* ring : {"1", "2"}) {
      const std::string key = std::string("capture.ring") + ring;
      of_run(key + "_time", [ring](auto& d) { return measure::first_collision_time(d, ring); });
      of_run(key + "_force", [ring](auto& d) { return measure::first_collision_force(d, ring); });
    }
    of_run("capture.ring1_peak", [](auto& d) { return measure::peak_force_time(d, "1"); });
  }

  Results results_;
  const Digest* run_;  // the paper's; null where there is none
  const std::vector<Digest>& again_;
  Table& table_;
};

}  // namespace

const char* words(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::within_open_inputs:
      return "within the open inputs";
    case Verdict::not_reproduced:
      return "not reproduced";
    case Verdict::converges:
      return "converges";
    case Verdict::not_converged:
      return "not converged";
    default:
      return "not in these results";
  }
}

Verdict judge(const PaperNumber& paper, double here, const OpenRange* range) {
  if (paper.rule == Rule::limit) return holds(paper, here) ? Verdict::converges : Verdict::not_converged;
  if (holds(paper, here)) return Verdict::reproduced;
  return range && range_allows(paper, *range) ? Verdict::within_open_inputs : Verdict::not_reproduced;
}

std::vector<VerdictRow> compare_with_paper(const std::vector<Digest>& results, const Sensitivity& sensitivity,
                                           const std::vector<Digest>& again) {
  Results same;
  for (const Digest& d : results)
    if (d.paper_case == results.front().paper_case) same.push_back(&d);
  if (same.empty()) return {};
  const bool closes = same.front()->paper_case == PaperCase::capture;
  Table table(sensitivity, same.size() > 1, closes ? paper_run(same) : same.front());
  if (same.front()->paper_case == PaperCase::ring_pull) ring_pull_table(same, table);
  if (same.front()->paper_case == PaperCase::edge_closure) edge_closure_table(same, table);
  if (same.front()->paper_case == PaperCase::capture) CaptureRows(same, again, table).fill();
  return std::move(table.rows);
}

}  // namespace cinch
