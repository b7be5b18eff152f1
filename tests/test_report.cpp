// The report: verdicts that can fail, plots that keep their spikes, pictures with the right points, a page
// that stands on its own.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "base/error.hpp"
#include "output/recorder.hpp"
#include "output/report_file.hpp"
#include "output/text_file.hpp"
#include "report/assets.hpp"
#include "report/charts.hpp"
#include "report/facts.hpp"
#include "report/html.hpp"
#include "report/measure.hpp"
#include "report/net_picture.hpp"
#include "report/net_view.hpp"
#include "report/open_inputs.hpp"
#include "report/page.hpp"
#include "report/report.hpp"
#include "report/verdict.hpp"

namespace cinch {
namespace {

namespace fs = std::filesystem;

/// A directory of its own that goes away with the test.
struct Scratch {
  fs::path path;
  Scratch() {
    std::string name = (fs::temp_directory_path() / "cinch-report-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Scratch() { fs::remove_all(path); }
};

const VerdictRow* find_row(const std::vector<VerdictRow>& rows, const std::string& key) {
  for (const VerdictRow& row : rows)
    if (row.paper->key == key) return &row;
  return nullptr;
}

Verdict verdict_on(const std::vector<Digest>& results, const std::string& key, const Sensitivity& open = {}) {
  const auto rows = compare_with_paper(results, open);
  const VerdictRow* row = find_row(rows, key);
  EXPECT_NE(row, nullptr) << key;
  return row ? row->verdict : Verdict::missing;
}

VectorSeries line(const Vec3& from, const Vec3& to, double end, int points = 101) {
  VectorSeries out{{}, {}, "probe"};
  for (int i = 0; i < points; ++i) {
    const double share = double(i) / (points - 1);
    out.t.push_back(share * end);
    out.v.push_back(from + share * (to - from));
  }
  return out;
}

/// A ring pull that ends with the ball at `ball` and the ring at Y = `ring`.
Digest ring_pull(int elements, double peak, const Vec3& ball, double ring) {
  Digest d;
  d.paper_case = PaperCase::ring_pull;
  d.model.case_name = "ring_pull";
  d.model.parts = {{"thread", "main", false}};
  d.model.element_part.assign(static_cast<std::size_t>(elements), 0);
  d.model.rings = {{"r1", 0.01, 0.002}};
  d.model.masses = {{"thread.main.start", 0, 0.1}};
  d.frame_times = {0, 0.5, 1.0};
  d.mass_position = {line({0, -0.2, 0}, ball, 1)};
  d.mass_velocity = d.mass_position;
  d.ring_position = {line(Vec3::Zero(), {0, ring, 0}, 1)};
  d.ring_force = {line(Vec3::Zero(), Vec3::Zero(), 1)};
  d.summary.emplace();
  d.summary->status = "done";
  d.summary->ring_records = {{"r1", 0.1, 0.5, peak, 0.4}};
  return d;
}

Digest good_pull() { return ring_pull(200, 1.5, {0, 0.58, -0.41}, 0.301); }

/// A capture that does all that the paper says, closing at `closing`.
Digest capture(double closing = 1.5) {
  Digest d;
  d.paper_case = PaperCase::capture;
  d.model.case_name = "capture";
  d.model.time_step = 1e-6;
  d.model.closing_time = closing;
  for (int r = 1; r <= 16; ++r) d.model.rings.push_back({"r" + std::to_string(r), 0.01, 0.002});
  d.model.masses = {{"mechanism.m1.a", 0, 0.1}, {"mechanism.m1.b", 1, 0.1}};
  VectorSeries a{{}, {}, "probe"}, b = a;
  for (int i = 0; i <= 2100; ++i) {
    const double t = 1e-3 * i, after = t - closing;
    const bool split = after >= 0;
    // X falls from -2 towards zero, which it passes 0.2 s later
    const double x = split ? -2 + 10 * std::min(after, 0.3) : 0,
                 y = split ? -2 + 0.5 * std::min(after, 0.3) : 0;
    a.t.push_back(t), b.t.push_back(t);
    a.v.emplace_back(x, y, 0.7);
    b.v.emplace_back(-y, -x, 0.7);
  }
  d.mass_velocity = {a, b};
  d.mass_position = {line(Vec3::Zero(), {0, 0, 2.1 * closing}, 2.1),
                     line(Vec3::Zero(), {0, 0, 2.1 * closing}, 2.1)};
  d.frame_times = {0, 1, 2.1};
  d.summary.emplace();
  d.summary->status = "done";
  d.summary->events = {{1.45, "target_contact", "ball"},
                       {closing, "separation", "m1"},
                       {closing + 0.4, "mouth_closed", ""},
                       {closing + 0.41, "target_enclosed", "ball"}};
  d.summary->ring_records = {{"r1", closing + 0.003, 37, 60, closing + 0.1},
                             {"r2", closing + 0.009, 8.1, 20, closing + 0.4}};
  return d;
}

VectorSeries& velocity_of_b(Digest& d) { return d.mass_velocity[1]; }

TEST(Report, A_number_is_judged_by_its_tolerance_and_the_open_inputs) {
  const PaperNumber& force = paper_number("capture.ring1_force");
  EXPECT_EQ(judge(force, 37 + 7.3), Verdict::reproduced);
  EXPECT_EQ(judge(force, 37 + 7.5), Verdict::not_reproduced);
  EXPECT_EQ(judge(force, 5), Verdict::not_reproduced);
  const OpenRange reaches{5, 40, ""}, stays_below{5, 20, ""};
  EXPECT_EQ(judge(force, 5, &reaches), Verdict::within_open_inputs);
  EXPECT_EQ(judge(force, 5, &stays_below), Verdict::not_reproduced);
  EXPECT_EQ(judge(force, 37, &stays_below), Verdict::reproduced);
  EXPECT_EQ(judge(paper_number("ring_pull.ball_y"), 0.58), Verdict::converges);
  EXPECT_EQ(judge(paper_number("ring_pull.ball_y"), 0.62), Verdict::not_converged);
  EXPECT_EQ(judge(paper_number("edge_closure.bunched"), 0.2), Verdict::not_reproduced);
  EXPECT_EQ(judge(paper_number("edge_closure.left_above"), -0.01), Verdict::not_reproduced);
}

TEST(Report, Every_row_has_a_key_and_a_source) {
  std::map<std::string_view, int> seen;
  for (const PaperNumber& row : paper_numbers()) {
    EXPECT_EQ(++seen[row.key], 1) << row.key;
    EXPECT_FALSE(row.source.empty()) << row.key;
    EXPECT_TRUE(row.rule != Rule::near || row.tolerance > 0) << row.key;
  }
  EXPECT_THROW(paper_number("nothing"), Error);
}

TEST(Report, A_ring_pull_like_the_papers_passes_every_row_it_can) {
  for (const VerdictRow& row : compare_with_paper({good_pull()})) {
    const bool fine = row.verdict == Verdict::reproduced || row.verdict == Verdict::converges ||
                      row.verdict == Verdict::missing;
    EXPECT_TRUE(fine) << row.paper->key << ": " << words(row.verdict);
  }
}

TEST(Report, A_wrong_ring_pull_fails) {
  EXPECT_EQ(verdict_on({ring_pull(200, 1.5, {0, 0.1, -0.41}, 0.301)}, "ring_pull.passes"),
            Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({ring_pull(200, 1.5, {0, 0.58, -0.41}, 0.0)}, "ring_pull.drags"),
            Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({ring_pull(200, 3.0, {0, 0.58, -0.41}, 0.301)}, "ring_pull.force_200"),
            Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({ring_pull(200, 1.5, {0, 0.58, -0.37}, 0.301)}, "ring_pull.ball_z"),
            Verdict::not_converged);
  EXPECT_EQ(verdict_on({ring_pull(200, 1.5, {0, 0.58, -0.41}, 0.4)}, "ring_pull.ring_y"),
            Verdict::not_converged);
}

TEST(Report, Several_ring_pulls_show_convergence_whatever_their_order) {
  const Digest fine = ring_pull(300, 1.0, {0, 0.58, -0.40}, 0.302),
               middle = ring_pull(200, 1.5, {0, 0.59, -0.37}, 0.301),
               coarse = ring_pull(100, 2.5, {0, 0.60, -0.30}, 0.310);
  EXPECT_EQ(verdict_on({middle, fine, coarse}, "ring_pull.force_falls"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({middle, fine, coarse}, "ring_pull.coincide"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({middle, fine, coarse}, "ring_pull.fewer_larger"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({middle, fine, coarse}, "ring_pull.ball_z"), Verdict::converges);
  const Digest worse = ring_pull(300, 1.9, {0, 0.58, -0.33}, 0.330);
  EXPECT_EQ(verdict_on({middle, worse, coarse}, "ring_pull.force_falls"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({middle, worse, coarse}, "ring_pull.coincide"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({middle, worse, coarse}, "ring_pull.ball_z"), Verdict::not_converged);
}

TEST(Report, An_edge_closure_is_judged_against_gravity) {
  Digest d;
  d.paper_case = PaperCase::edge_closure;
  d.model.masses = {{"thread.closing.start", 0, 0.1}, {"thread.closing.end", 1, 0.1}};
  d.ring_position = {line(Vec3::Zero(), Vec3::Zero(), 0.5)};
  d.mass_position = {line({0.615, 0, -0.5}, {-0.1, 0, -0.99}, 0.5),
                     line({-0.585, 0, -0.5}, {0.1, 0, -0.98}, 0.5)};
  d.mouth_spread = {{0, 0.5}, {0.9, 0.05}};
  d.frame_times = {0, 0.5};
  d.gravity = Vec3(0, 0, -9.81);
  EXPECT_EQ(verdict_on({d}, "edge_closure.rest"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({d}, "edge_closure.bunched"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({d}, "edge_closure.left_above"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({d}, "edge_closure.slightly"), Verdict::reproduced);
  d.gravity = Vec3(0, 0, 9.81);
  d.mouth_spread.v[1] = 0.3;
  d.start_speed = 0.1;
  EXPECT_EQ(verdict_on({d}, "edge_closure.rest"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({d}, "edge_closure.bunched"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({d}, "edge_closure.left_above"), Verdict::not_reproduced);
}

TEST(Report, A_capture_like_the_papers_passes_every_row_it_can) {
  for (const VerdictRow& row : compare_with_paper({capture()})) {
    const bool fine = row.verdict == Verdict::reproduced || row.paper->key == "capture.later_further";
    EXPECT_TRUE(fine) << row.paper->key << ": " << words(row.verdict) << " " << row.here.value_or(NAN) << " "
                      << row.note;
  }
}

TEST(Report, A_capture_with_one_thing_wrong_fails_that_row) {
  Digest no_jump = capture(), askew = capture(), late = capture(), open = capture(), weak = capture();
  for (VectorSeries& v : no_jump.mass_velocity)
    for (Vec3& each : v.v) each *= 0.5;
  for (Vec3& each : velocity_of_b(askew).v) each.x() += 0.3;
  late.summary->events[0].time = 1.6;
  open.summary->events.resize(2);
  weak.summary->ring_records[0] = {"r1", 1.52, 5, 9, 1.9};
  EXPECT_EQ(verdict_on({no_jump}, "capture.jump_x"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({askew}, "capture.mirror"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({late}, "capture.first_touch"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({open}, "capture.enclosed"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({open}, "capture.closes_after"), Verdict::missing);
  EXPECT_EQ(verdict_on({weak}, "capture.ring1_time"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({weak}, "capture.ring1_force"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({weak}, "capture.ring1_peak"), Verdict::not_reproduced);
  EXPECT_EQ(verdict_on({weak}, "capture.ring1_force", {{"capture.ring1_force", {3, 50, "towing thread"}}}),
            Verdict::within_open_inputs);
}

VerdictRow row_over(const std::vector<Digest>& results, const std::vector<Digest>& again,
                    const std::string& key) {
  const auto rows = compare_with_paper(results, {}, again);
  const VerdictRow* row = find_row(rows, key);
  return row ? *row : VerdictRow{};
}

TEST(Report, Captures_made_again_are_judged_by_their_median) {
  const auto closed_after = [](double time) {
    Digest d = capture();
    d.summary->events[2].time = 1.5 + time;
    return d;
  };
  Digest open = capture();
  open.summary->events.resize(2);
  const std::vector<Digest> late{closed_after(0.8)};
  EXPECT_EQ(verdict_on(late, "capture.closes_after"), Verdict::not_reproduced);
  Digest other_time = capture(1.3);
  const std::vector<Digest> again{
      closed_after(0.31), closed_after(0.36), open,
      closed_after(0.39), other_time,         ring_pull(200, 1.5, {0, 0.58, -0.41}, 0.301)};
  const VerdictRow row = row_over(late, again, "capture.closes_after");
  EXPECT_NEAR(row.here.value_or(0), 0.39, 1e-12) << "of 0.31, 0.36, 0.39, 0.8 and one that stays open";
  EXPECT_EQ(row.verdict, Verdict::reproduced);
  EXPECT_NE(row.note.find("median of 5 runs, 0.31 s to 0.8 s, in 1 not by the end"), std::string::npos)
      << row.note;
  const VerdictRow enclosed = row_over(late, again, "capture.enclosed");
  EXPECT_EQ(enclosed.here, 1);
  EXPECT_NE(enclosed.note.find("median of 5 runs, 0 to 1"), std::string::npos) << enclosed.note;
  const VerdictRow few = row_over(late, {open, open}, "capture.closes_after");
  EXPECT_EQ(few.verdict, Verdict::missing);
  EXPECT_NE(few.note.find("in 1 of 3 runs"), std::string::npos) << few.note;
  EXPECT_EQ(row_over(late, {}, "capture.closes_after").note.find("median"), std::string::npos);
  EXPECT_NEAR(row_over(late, {closed_after(0.3)}, "capture.closes_after").here.value_or(0), 0.55, 1e-12)
      << "the mean of two";
}

TEST(Report, A_run_that_cannot_tell_does_not_count_among_those_made_again) {
  Digest open = capture(), short_one = capture();
  open.summary->events.resize(2);
  short_one.frame_times = {0, 1.6};
  short_one.summary->events.resize(2);
  const VerdictRow row =
      row_over({open}, {short_one, short_one, short_one, capture(), open}, "capture.enclosed");
  EXPECT_EQ(row.here, 0) << "of 0, 0, 1";
  EXPECT_NE(row.note.find("median of 3 runs"), std::string::npos) << row.note;
  Digest untouched = capture();
  untouched.summary->ring_records[0].first_contact_time = -1;
  const VerdictRow force = row_over({untouched}, {capture()}, "capture.ring1_force");
  EXPECT_EQ(force.here, 37) << "no force is not a greater one";
  EXPECT_EQ(force.note.find("never touched"), std::string::npos) << "of one run alone: " << force.note;
}

TEST(Report, A_run_has_come_to_the_end_by_the_step_nearest_to_it) {
  Digest d = capture();
  d.model.closing_time_step = 6e-6;
  d.frame_times.back() = 2 - 2.9e-6;
  EXPECT_EQ(verdict_on({d}, "capture.enclosed"), Verdict::reproduced);
  d.summary->events.resize(2);
  EXPECT_EQ(verdict_on({d}, "capture.enclosed"), Verdict::not_reproduced);
  d.frame_times.back() = 2 - 3.1e-6;
  EXPECT_EQ(verdict_on({d}, "capture.enclosed"), Verdict::missing);
}

TEST(Report, How_far_a_capture_gets_is_a_mean_over_those_made_again) {
  const auto reaching = [](double closing, double z) {
    Digest d = capture(closing);
    d.mass_position.assign(2, line({0, 0, z}, {0, 0, z}, 2.1));
    return d;
  };
  const std::vector<Digest> results{reaching(1.5, 1), reaching(1.3, 1.1)};
  EXPECT_NEAR(row_over(results, {}, "capture.later_further").here.value_or(9), -0.1, 1e-12);
  const std::vector<Digest> again{reaching(1.5, 1.4), reaching(1.5, 1.2)};
  const VerdictRow mean = row_over(results, again, "capture.later_further");
  EXPECT_NEAR(mean.here.value_or(9), 0.1, 1e-12);
  EXPECT_NE(mean.note.find("means of up to 3 runs"), std::string::npos) << mean.note;
}

TEST(Report, The_range_over_open_inputs_names_its_ends) {
  Digest slack = capture(), tight = capture();
  slack.file = "study/long_thread/run.vtkhdf";
  tight.file = "study/short_thread/run.vtkhdf";
  slack.summary->ring_records[0].first_contact_force = 5;
  tight.summary->ring_records[0].first_contact_force = 60;
  const Sensitivity ranges = range_over({slack, tight});
  const OpenRange& force = ranges.at("capture.ring1_force");
  EXPECT_EQ(force.low, 5);
  EXPECT_EQ(force.high, 60);
  EXPECT_NE(force.note.find("(long_thread) to"), std::string::npos) << force.note;
  EXPECT_NE(force.note.find("(short_thread)"), std::string::npos) << force.note;
  EXPECT_EQ(verdict_on({slack}, "capture.ring1_force", ranges), Verdict::within_open_inputs);
}

TEST(Report, A_badge_has_the_colour_of_its_verdict) {
  Digest weak = capture();
  weak.summary->ring_records[0].first_contact_force = 5;
  const auto rows = compare_with_paper({weak}, {{"capture.ring1_force", {3, 50, "towing thread"}}});
  const std::string table = page::paper_table(rows, false);
  EXPECT_NE(table.find("<span class=\"badge fair\">within the open inputs</span>"), std::string::npos);
  EXPECT_NE(table.find("<span class=\"badge good\">reproduced</span>"), std::string::npos);
  const std::string pull = page::paper_table(compare_with_paper({good_pull()}), false);
  EXPECT_NE(pull.find("<span class=\"badge good\">converges</span>"), std::string::npos);
}

TEST(Report, Peaks_of_every_step_are_preferred_to_samples) {
  Digest d = good_pull();
  d.ring_force[0].v[50] = Vec3(0, 3, -4);
  EXPECT_EQ(measure::peak_ring_force(d).value, 1.5);
  d.summary.reset();
  EXPECT_EQ(measure::peak_ring_force(d).value, 5);
  EXPECT_EQ(measure::peak_ring_force(d).note, "from probe only: the true peak may be higher");
  d.ring_force.clear();
  EXPECT_FALSE(measure::peak_ring_force(d).value);
}

TEST(Report, A_run_that_ends_early_decides_nothing_that_comes_later) {
  Digest pull = good_pull(), caught = capture();
  pull.frame_times = {0, 0.2};
  for (const char* key : {"passes", "drags", "force_200", "ball_y", "ring_y"})
    EXPECT_EQ(verdict_on({pull}, std::string("ring_pull.") + key), Verdict::missing) << key;
  const auto rows = compare_with_paper({pull});
  EXPECT_EQ(rows.front().note, "the run ends at 0.2 s, before 1 s");
  caught.frame_times = {0, 1, 1.78};
  caught.summary->status = "interrupted";
  caught.summary->events.resize(2);
  for (const char* key : {"enclosed", "closes_after", "ring1_peak"})
    EXPECT_EQ(verdict_on({caught}, std::string("capture.") + key), Verdict::missing) << key;
  for (const char* key : {"first_touch", "jump_x", "a1_falls", "mirror", "ring1_time"})
    EXPECT_EQ(verdict_on({caught}, std::string("capture.") + key), Verdict::reproduced) << key;
  caught.frame_times = {0, 1, 1.52};
  for (const char* key : {"a1_falls", "a1_y_steady", "mirror"})
    EXPECT_EQ(verdict_on({caught}, std::string("capture.") + key), Verdict::missing) << key;
}

// Leaves samples at multiples of `interval` alone.
void thin_out(VectorSeries& series, double interval) {
  VectorSeries left{{}, {}, series.source};
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    const double number = series.t[i] / interval;
    if (std::abs(number - std::round(number)) * interval > 1e-9) continue;
    left.t.push_back(series.t[i]);
    left.v.push_back(series.v[i]);
  }
  series = left;
}

void thin_out(Digest& d, double interval) {
  for (auto* all : {&d.ring_position, &d.ring_force, &d.mass_position, &d.mass_velocity})
    for (VectorSeries& series : *all) thin_out(series, interval);
}

TEST(Report, A_run_without_samples_where_a_number_is_measured_decides_nothing) {
  for (const double interval : {0.7, 1.05, 2.1}) {  // one sample in each window, or none
    Digest caught = capture(), other = capture(1.3);
    for (Digest* d : {&caught, &other}) d->mass_position = d->mass_velocity, thin_out(*d, interval);
    for (const char* key :
         {"jump_x", "jump_y", "jump_z", "a1_falls", "a1_turns", "a1_y_steady", "mirror", "later_further"})
      EXPECT_EQ(verdict_on({caught, other}, std::string("capture.") + key), Verdict::missing)
          << key << " of samples every " << interval << " s";
  }
  Digest caught = capture();
  caught.mass_position = caught.mass_velocity;
  thin_out(caught, 0.02);
  for (const char* key : {"jump_x", "a1_falls", "a1_turns", "a1_y_steady", "mirror"})
    EXPECT_NE(verdict_on({caught}, std::string("capture.") + key), Verdict::missing)
        << key << " of the cases' own frames";
  Digest pull = good_pull();
  pull.summary.reset();
  pull.frame_times = {0, 1.05};
  for (auto* all : {&pull.mass_position, &pull.ring_position, &pull.ring_force})
    for (VectorSeries& series : *all) series.t = {0, 1.05}, series.v = {series.v.front(), series.v.back()};
  for (const char* key : {"passes", "drags", "force_200", "ball_y", "ball_z", "ring_y"})
    EXPECT_EQ(verdict_on({pull}, std::string("ring_pull.") + key), Verdict::missing) << key;
  Digest fine = ring_pull(300, 1, {0, 0.58, -0.4}, 0.302);
  EXPECT_EQ(verdict_on({pull, fine}, "ring_pull.coincide"), Verdict::missing);
  EXPECT_EQ(verdict_on({fine, pull, ring_pull(100, 2.5, {0, 0.6, -0.3}, 0.31)}, "ring_pull.fewer_larger"),
            Verdict::missing);
}

TEST(Report, Two_samples_of_different_times_are_no_mirror) {
  Digest d = capture();
  thin_out(velocity_of_b(d), 0.02);
  EXPECT_EQ(verdict_on({d}, "capture.mirror"), Verdict::missing);
}

TEST(Report, Events_that_were_hardly_looked_for_decide_nothing) {
  Digest open = capture(), late = capture();
  open.summary->events.resize(2);
  EXPECT_EQ(verdict_on({open}, "capture.enclosed"), Verdict::not_reproduced);
  open.look_interval = 0.02;
  EXPECT_EQ(verdict_on({open}, "capture.enclosed"), Verdict::not_reproduced);
  open.look_interval = 10;
  EXPECT_EQ(verdict_on({open}, "capture.enclosed"), Verdict::missing);
  late.look_interval = 0.38;  // 1.52, 1.9
  EXPECT_EQ(verdict_on({late}, "capture.closes_after"), Verdict::reproduced);
  late.look_interval = 0.95;
  EXPECT_EQ(verdict_on({late}, "capture.closes_after"), Verdict::missing);
  EXPECT_EQ(verdict_on({late}, "capture.enclosed"), Verdict::reproduced) << "it was seen";
}

TEST(Report, A_spread_or_a_height_needs_a_sample_near) {
  Digest d;
  d.paper_case = PaperCase::edge_closure;
  d.model.masses = {{"thread.closing.left", 0, 0.1}, {"thread.closing.right", 1, 0.1}};
  d.ring_position = {line(Vec3::Zero(), Vec3::Zero(), 1)};
  d.mass_position = {line({0, 0, 0}, {0, 0, -0.98}, 1), line({0, 0, 0}, {0, 0, -0.99}, 1)};
  d.mouth_spread = {{0, 0.5, 1}, {0.9, 0.05, 0.05}};
  d.frame_times = {0, 1};
  d.gravity = Vec3(0, 0, -9.81);
  EXPECT_EQ(verdict_on({d}, "edge_closure.bunched"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({d}, "edge_closure.left_above"), Verdict::reproduced);
  d.mouth_spread = {{0, 1}, {0, 0}};
  thin_out(d, 1);
  EXPECT_EQ(verdict_on({d}, "edge_closure.bunched"), Verdict::missing);
  EXPECT_EQ(verdict_on({d}, "edge_closure.left_above"), Verdict::missing);
}

TEST(Report, Results_that_end_early_do_not_spoil_a_comparison_of_several) {
  const Digest middle = good_pull(), coarse = ring_pull(100, 2.5, {0, 0.60, -0.30}, 0.310);
  Digest early = ring_pull(300, 0, {0, -0.3, -0.5}, 0);
  early.frame_times = {0, 0.1};
  EXPECT_EQ(verdict_on({middle, early, coarse}, "ring_pull.coincide"), Verdict::missing);
  EXPECT_EQ(verdict_on({middle, early, coarse}, "ring_pull.fewer_larger"), Verdict::reproduced);
  EXPECT_EQ(verdict_on({middle, early, coarse}, "ring_pull.force_falls"), Verdict::reproduced);
}

TEST(Report, A_longer_run_is_judged_where_the_papers_ends) {
  Digest pull = good_pull(), caught = capture();
  pull.frame_times = {0, 1, 2};
  for (VectorSeries* path : {&pull.mass_position[0], &pull.ring_position[0]})
    path->t.push_back(2), path->v.emplace_back(0, -5, 0);
  pull.summary->ring_records[0] = {"r1", 0.1, 0.5, 99, 1.7};
  pull.ring_force[0].v[40] = Vec3(0, 1.4, 0);
  for (const char* key : {"passes", "drags", "force_200"})
    EXPECT_EQ(verdict_on({pull}, std::string("ring_pull.") + key), Verdict::reproduced) << key;
  EXPECT_EQ(measure::peak_ring_force(pull).note, "from probe only: the true peak may be higher");
  caught.frame_times.back() = 5;
  caught.summary->events.back().time = 4;
  EXPECT_EQ(verdict_on({caught}, "capture.enclosed"), Verdict::not_reproduced);
}

TEST(Report, Only_the_papers_closing_time_is_held_against_its_figures) {
  EXPECT_EQ(verdict_on({capture(1.2)}, "capture.enclosed"), Verdict::reproduced);
  for (const char* key : {"first_touch", "closes_after", "jump_x", "a1_turns", "ring1_force", "ring1_peak"})
    EXPECT_EQ(verdict_on({capture(1.2)}, std::string("capture.") + key), Verdict::missing) << key;
  EXPECT_EQ(verdict_on({capture(1.2), capture(1.5)}, "capture.jump_x"), Verdict::reproduced);
}

TEST(Report, A_capture_without_its_mechanisms_or_rings_has_gaps_that_are_named) {
  Digest d = capture();
  d.model.masses.clear();
  d.mass_velocity.clear();
  d.mass_position.clear();
  EXPECT_FALSE(measure::split_masses(d));
  EXPECT_EQ(verdict_on({d}, "capture.jump_x"), Verdict::missing);
  d.model.rings.clear();
  EXPECT_EQ(verdict_on({d}, "capture.ring1_peak"), Verdict::missing);
  std::string notes;
  for (const Plot& plot : figure_plots({d})) notes += plot.note;
  EXPECT_NE(notes.find("The result has no ring 2."), std::string::npos) << notes;
}

TEST(Report, A_target_that_is_lost_again_is_told_and_not_enclosed) {
  const auto told = [](const Digest& d, const std::string& what) {
    for (const Fact& fact : facts_of(d))
      if (fact.what == what) return fact.text;
    return std::string("nothing");
  };
  Digest d = capture(1.5);
  ResultModel::Ball ball;
  ball.name = "ball";
  d.model.balls = {ball};
  EXPECT_EQ(told(d, "mouth"), "closed at 1.9 s");
  EXPECT_EQ(told(d, "target ball"), "enclosed at 1.91 s");
  EXPECT_EQ(measure::enclosed(d).value, 1);
  d.summary->events.push_back({1.92, "mouth_reopened", ""});
  d.summary->events.push_back({1.93, "target_lost", "ball"});
  EXPECT_EQ(told(d, "mouth"), "closed at 1.9 s, reopened at 1.92 s");
  EXPECT_EQ(told(d, "target ball"), "enclosed at 1.91 s, lost at 1.93 s");
  EXPECT_NE(measure::enclosed(d).value, 1);
  d.summary->events.clear();
  EXPECT_EQ(told(d, "mouth"), "never closed");
  EXPECT_EQ(told(d, "target ball"), "never enclosed");
}

TEST(Report, A_mouth_has_its_figure_in_any_case) {
  Digest d;
  EXPECT_TRUE(figure_plots({d}).empty());
  d.mouth_area = {{0, 1, 2}, {1, 0.5, 0.01}};
  d.frame_times = {0, 1, 2};
  d.summary.emplace();
  d.summary->events = {{1.9, "mouth_closed", ""}, {0.2, "target_contact", "ball"}};
  const auto plots = figure_plots({d});
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_EQ(plots[0].curves[0].points.v, d.mouth_area.v);
  ASSERT_EQ(plots[0].marks.size(), 2u);
  EXPECT_EQ(plots[0].marks[0].label, "touches target") << "in the order of time";
}

/// The column `name` of a probe that rises from 0 to `end`.
ProbeSeries probed(const std::string& name, const std::string& quantity, const std::string& of,
                   const std::string& unit, double end) {
  return {{name, quantity, of, unit}, {{0, 1}, {0, end}}};
}

TEST(Report, Probes_of_a_quantity_share_a_chart) {
  Digest d;
  for (const char* axis : {".x", ".y", ".z"})
    d.probes.push_back(probed(std::string("tip") + axis, "position", "thread.a.end", "m", 1));
  d.probes.push_back(probed("rope", "tension", "thread.a", "N", 3));
  d.probes.push_back(probed("net", "tension", "net.main", "N", 4));
  d.probes.push_back(probed("area", "mouth_area", "", "m^2", 2));
  const auto plots = probe_plots(d, {});
  ASSERT_EQ(plots.size(), 3u);
  EXPECT_EQ(plots[0].title, "Position: tip");
  EXPECT_EQ(plots[0].y, "position, m");
  ASSERT_EQ(plots[0].curves.size(), 3u);
  EXPECT_EQ(plots[0].curves[2].label, "tip.z");
  EXPECT_FALSE(plots[0].from_zero);
  EXPECT_EQ(plots[1].title, "Tension: rope, net");
  EXPECT_EQ(plots[1].note, "rope: thread.a; net: net.main");
  EXPECT_EQ(plots[1].curves[1].points.v.back(), 4);
  EXPECT_NE(plots[1].curves[0].colour, plots[1].curves[1].colour);
  EXPECT_EQ(plots[2].y, "mouth area, m²");
}

TEST(Report, A_chart_has_no_more_curves_than_colours) {
  Digest d;
  for (int k = 0; k < 19; ++k)
    d.probes.push_back(probed("t" + std::to_string(k), "tension", "thread.a", "N", k));
  const auto plots = probe_plots(d, {});
  ASSERT_EQ(plots.size(), 3u);
  for (const Plot& plot : plots) EXPECT_LE(plot.curves.size(), 8u);
  EXPECT_EQ(plots[2].title, "Tension: t16, t17, t18");
}

TEST(Report, Every_quantity_keeps_a_chart_where_there_are_too_many) {
  Digest d;
  for (int k = 0; k < 50; ++k)
    d.probes.push_back(probed("t" + std::to_string(k), "tension", "thread.a", "N", k));
  d.probes.push_back(probed("spread", "mouth_spread", "", "m", 1));
  auto plots = probe_plots(d, {});
  EXPECT_EQ(plots.size(), 8u);
  EXPECT_EQ(leave_out(plots, 3), 5u);
  ASSERT_EQ(plots.size(), 3u);
  EXPECT_EQ(plots[0].curves[0].label, "t0");
  EXPECT_EQ(plots[2].title, "Mouth spread: spread");
}

TEST(Report, Probes_that_a_figure_shows_have_no_further_chart) {
  Digest pull = good_pull();
  pull.probes = {probed("force.x", "force", "ring.r1", "N", 1),
                 probed("path.y", "position", "thread.main.start", "m", 1),
                 probed("rope", "tension", "thread.main", "N", 1)};
  const auto plots = probe_plots(pull, figure_plots({pull}));
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_EQ(plots[0].title, "Tension: rope");
  Digest caught = capture();
  caught.ring_force.assign(16, line(Vec3::Zero(), {0, 0, 1}, 2));
  caught.probes = {probed("v.x", "velocity", "mechanism.m1.a", "m/s", 1),
                   probed("f.x", "force", "ring.r2", "N", 1), probed("f3.x", "force", "ring.r3", "N", 1),
                   probed("area", "mouth_area", "", "m^2", 1)};
  ASSERT_EQ(probe_plots(caught, figure_plots({caught})).size(), 1u);
  EXPECT_EQ(probe_plots(caught, figure_plots({caught}))[0].title, "Force: f3");
}

TEST(Report, Later_closing_times_reach_further) {
  EXPECT_EQ(verdict_on({capture(1.5), capture(1.2), capture(1.6)}, "capture.later_further"),
            Verdict::reproduced);
  Digest back = capture(1.6);
  back.mass_position = {line(Vec3::Zero(), Vec3::Zero(), 2.1), line(Vec3::Zero(), Vec3::Zero(), 2.1)};
  EXPECT_EQ(verdict_on({capture(1.5), back}, "capture.later_further"), Verdict::not_reproduced);
}

TEST(Report, Thinning_keeps_every_spike_and_both_ends) {
  Series noisy;
  for (int i = 0; i < 200000; ++i) {
    noisy.t.push_back(1e-5 * i);
    noisy.v.push_back(std::sin(0.01 * i));
  }
  noisy.v[77777] = 50;
  noisy.v[123456] = -60;
  const Series few = thinned(noisy, 3000);
  EXPECT_LE(few.t.size(), 3000u);
  EXPECT_GT(few.t.size(), 2000u);
  EXPECT_TRUE(std::is_sorted(few.t.begin(), few.t.end()));
  EXPECT_EQ(few.t.front(), noisy.t.front());
  EXPECT_EQ(few.t.back(), noisy.t.back());
  EXPECT_EQ(few.at(noisy.t[77777]), 50);
  EXPECT_EQ(few.at(noisy.t[123456]), -60);
  EXPECT_EQ(thinned(few, 3000).t.size(), few.t.size());
}

TEST(Report, Jumps_and_crossings) {
  const Series s{{0, 1, 2, 3}, {-1, -1, 1, 2}};
  EXPECT_EQ(s.jump_at(1.5, 0.1), 2);
  EXPECT_EQ(s.jump_at(1, 0.1), 2);  // the sample at 1 is neither before nor after
  EXPECT_EQ(s.jump_at(3, 0.1), std::nullopt);
  EXPECT_EQ(s.rises_through(0, 0), 1.5);
  EXPECT_EQ(s.rises_through(5, 0), std::nullopt);
  EXPECT_DOUBLE_EQ(s.at(2.5), 1.5);
}

TEST(Report, Numbers_as_people_write_them) {
  EXPECT_EQ(html::number(-0.0123456, 3), "−0.0123");
  EXPECT_EQ(html::number(3.02e-14, 3), "3.02·10<sup>−14</sup>");
  EXPECT_EQ(html::number(1e-6, 3), "1·10<sup>−6</sup>");
  EXPECT_EQ(html::number(1183, 3), "1183");
  EXPECT_EQ(html::number(NAN), "–");
  EXPECT_EQ(html::duration(250), "4 min 10 s");
  EXPECT_EQ(html::duration(7510), "2 h 5 min");
  EXPECT_EQ(escape_markup("<a href=\"x\">&"), "&lt;a href=&quot;x&quot;&gt;&amp;");
  EXPECT_EQ(html::script_safe("'</script><!--'"), "'<\\/script><\\!--'");
  const std::string bytes = "any carnal pleas";
  EXPECT_EQ(html::base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}),
            "YW55IGNhcm5hbCBwbGVhcw==");
}

/// A square of four net elements of 1 m in the plane Z = 0 and a closing thread across it, with a ball
/// behind.
ResultModel square_model() {
  ResultModel model;
  model.case_name = "square";
  model.title = "A <square>";
  model.case_toml = "title = \"</script><script>alert(1)</script>\"\n";
  model.elements = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
  model.rest_length.assign(5, 1);
  model.element_radius.assign(5, 0.001);
  model.element_part = {0, 0, 0, 0, 1};
  model.node_mass.assign(4, 0.1);
  model.parts = {{"net", "main", false}, {"thread", "closing", true}};
  model.rings = {{"r1", 0.05, 0.002}};
  model.balls = {{"ball", Vec3(0.5, 0.5, -2), 0.2}};
  model.masses = {{"mechanism.m1.launcher", 0, 0.05}};
  model.closing_time = 0.5;
  model.probes = {{"f.x", "force.x", "ring.r1", "N"},
                  {"f.y", "force.y", "ring.r1", "N"},
                  {"f.z", "force.z", "ring.r1", "N"}};
  return model;
}

Frame square_frame(double time) {
  Frame frame;
  frame.time = time;
  frame.step = std::lround(time * 1000);
  frame.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  frame.velocity.assign(4, Vec3::Zero());
  frame.contact_force.assign(4, Vec3::Zero());
  frame.tension = {0, 0, 5, 5, 1};
  frame.strain.assign(5, 0);
  frame.active = {1, 1, 1, 1, static_cast<std::uint8_t>(time >= 0.5)};
  frame.ring_center = {{0.5, 0, 0}};
  frame.ring_normal = {{1, 0, 0}};
  frame.ring_force = {{0, 0, 0}};
  return frame;
}

PictureSet front_view(const ResultModel& model, const Frame& frame) {
  PictureSet set;
  set.model = &model;
  set.chains = element_chains(model, frame.position);
  set.camera = Camera::looking({0.5, 0.5, 0}, {0, 0, 1}, {0, 1, 0}, 1e9);
  set.pixels_per_metre = 100;
  set.width = 200;
  set.height = 200;
  set.tension_reference = 5;
  return set;
}

TEST(Report, A_picture_shows_points_where_they_are) {
  const ResultModel model = square_model();
  const Frame before = square_frame(0), after = square_frame(1);
  const std::string first = net_picture(front_view(model, before), before, "t = 0 s", "b0");
  // the square from (50, 150) to (150, 50): y runs downwards in a picture
  EXPECT_NE(first.find("class=\"n0\""), std::string::npos) << first;
  EXPECT_NE(first.find("class=\"n3\""), std::string::npos);
  for (const char* corner : {"50 150", "150 150", "150 50", "50 50"})
    EXPECT_NE(first.find(corner), std::string::npos) << corner;
  EXPECT_NE(first.find("cx=\"100\" cy=\"100\" r=\"20\""), std::string::npos) << "ball";
  EXPECT_NE(first.find("class=\"ml\" cx=\"50\" cy=\"150\""), std::string::npos) << "launcher";
  EXPECT_NE(first.find("translate(100 150) rotate(0)"), std::string::npos) << "ring";
  EXPECT_EQ(first.find("class=\"c"), std::string::npos) << "the closing thread is not there yet";
  EXPECT_NE(net_picture(front_view(model, after), after, "t = 1 s", "b1").find("class=\"c"),
            std::string::npos);
}

// The closing thread from corner to corner goes through a ring beside it; elements may be drawn from either
// end.
TEST(Report, A_picture_leads_threads_through_their_rings) {
  ResultModel model = square_model();
  model.joints = {{1, 0}, {1, 0}};
  Frame frame = square_frame(1);
  frame.joint_element = {4, 4};
  frame.joint_waypoint = {{0.2, 0.5, 0}, {0.5, 0.8, 0}};
  const std::string way = "M50 150L70 100L100 70L150 50", back = "M150 50L100 70L70 100L50 150";
  PictureSet set = front_view(model, frame);
  EXPECT_NE(net_picture(set, frame, "", "b").find(way), std::string::npos);
  for (Chain& chain : set.chains) std::reverse(chain.nodes.begin(), chain.nodes.end());
  EXPECT_NE(net_picture(set, frame, "", "b").find(back), std::string::npos);
  frame.active[4] = 0;
  EXPECT_EQ(net_picture(set, frame, "", "b").find("70 100"), std::string::npos) << "not there yet";
}

TEST(Report, What_a_ball_hides_is_drawn_before_it) {
  ResultModel model = square_model();
  const Frame frame = square_frame(1);
  const auto order = [&] {
    const std::string svg = net_picture(front_view(model, frame), frame, "", "b");
    return svg.find("class=\"c") < svg.find("class=\"b\"");
  };
  EXPECT_FALSE(order());
  model.balls[0].center.z() = 2;
  model.balls[0].radius = 0.6;
  EXPECT_TRUE(order());
}

TEST(Report, Chains_run_straight_through_knots) {
  ResultModel model;
  model.parts = {{"net", "n", false}};
  std::vector<Vec3> position;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) position.emplace_back(i, j, 0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      if (i < 3) model.elements.push_back({4 * j + i, 4 * j + i + 1});
      if (j < 3) model.elements.push_back({4 * j + i, 4 * j + i + 4});
    }
  model.element_part.assign(model.elements.size(), 0);
  const auto chains = element_chains(model, position);
  ASSERT_EQ(chains.size(), 8u);
  for (const Chain& chain : chains) EXPECT_EQ(chain.elements.size(), 3u);
  EXPECT_EQ(chosen_chains(chains, 12).size(), 4u);
  EXPECT_EQ(chosen_chains(chains, 1000).size(), 8u);
}

TEST(Report, Tension_levels) {
  EXPECT_EQ(tension_reference({0, 0, 3.4, 7, 2.2}), 2);
  EXPECT_EQ(tension_reference({0}), 1);
  EXPECT_EQ(tension_level(0, 2), 0);
  EXPECT_EQ(tension_level(0.1, 2), 1);
  EXPECT_EQ(tension_level(1, 2), 2);
  EXPECT_EQ(tension_level(2, 2), 3);
}

/// Records the square; `finish`: with a summary.
void record_square(const fs::path& directory, bool finish) {
  Recorder recorder(directory, square_model(), {});
  for (int k = 0; k <= 10; ++k) {
    for (int i = 0; i < 10; ++i) {
      const double row[] = {0, k == 5 && i == 3 ? 12.0 : 0.0, 0};
      recorder.probes(0.1 * k + 0.01 * i, row);
    }
    recorder.frame(square_frame(0.1 * k));
  }
  Summary summary;
  summary.status = "failed";
  summary.message = "node 3 ran away </script>";
  summary.case_name = "square";
  summary.stages = {{"elements", 2}, {"rings", 1}};
  summary.events = {{0.5, "separation", "m1"}};
  summary.ring_records = {{"r1", 0.53, 12, 12, 0.53}};
  if (finish) recorder.finish(summary);
}

std::string report_text(const fs::path& directory) {
  std::vector<Result> results;
  results.emplace_back(directory);
  write_report(results, directory / "report.html");
  return read_text_file(directory / "report.html");
}

TEST(Report, A_probe_is_preferred_to_frames) {
  const Scratch scratch;
  record_square(scratch.path, true);
  const Digest d = digest(Result(scratch.path));
  EXPECT_EQ(d.ring_force[0].source, "probe");
  EXPECT_EQ(d.ring_force[0].norm().at(0.53), 12);
  EXPECT_EQ(d.mass_velocity[0].source, "frames");
}

std::string without_libraries(std::string page) {
  for (const std::string_view library : {assets::chart_js(), assets::three_js()}) {
    const std::string text = html::script_safe(library);
    const auto place = page.find(text);
    EXPECT_NE(place, std::string::npos) << "a library is not in the page";
    if (place != std::string::npos) page.erase(place, text.size());
  }
  return page;
}

TEST(Report, The_page_stands_on_its_own) {
  const Scratch scratch;
  record_square(scratch.path, true);
  const std::string page = without_libraries(report_text(scratch.path));
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
  EXPECT_FALSE(std::regex_search(page, std::regex("<(script|img|iframe|object)[^>]*\\ssrc=")));
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_NE(page.find("A &lt;square&gt;"), std::string::npos);
  EXPECT_NE(page.find("node 3 ran away &lt;/script&gt;"), std::string::npos);
}

TEST(Report, The_page_draws_the_probes_of_a_case) {
  const Scratch scratch;
  record_square(scratch.path, true);
  const std::string page = report_text(scratch.path);
  EXPECT_NE(page.find("<h2>Probes</h2>"), std::string::npos);
  EXPECT_NE(page.find("Force: f"), std::string::npos);
  const std::string start = "<script type=\"application/json\" id=\"plots\">";
  const auto from = page.find(start) + start.size();
  const auto plots = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
  ASSERT_EQ(plots.size(), 4u) << "probes, ledger, residual, tension";
  EXPECT_EQ(plots[0]["y"], "force, N");
  EXPECT_EQ(plots[0]["curves"].size(), 3u);
  EXPECT_EQ(plots[3]["y"], "tension, N");
  EXPECT_NE(page.find("data-plot=\"3\""), std::string::npos) << "each canvas has its data";
}

TEST(Report, Too_many_charts_of_probes_are_counted) {
  const Scratch scratch;
  ResultModel model = square_model();
  model.probes.clear();
  for (int k = 0; k < 8 * 26; ++k)
    model.probes.push_back({"t" + std::to_string(k), "tension", "net.main", "N"});
  Recorder recorder(scratch.path, model, {});
  recorder.probes(0, std::vector<double>(model.probes.size(), 1));
  recorder.frame(square_frame(0));
  const std::string page = report_text(scratch.path);
  EXPECT_NE(page.find("2 more charts would make this page slow"), std::string::npos);
  EXPECT_NE(page.find("data-plot=\"26\""), std::string::npos);
  EXPECT_EQ(page.find("data-plot=\"27\""), std::string::npos) << "24 of probes, 3 of energy and tension";
}

TEST(Report, Only_pages_and_tables_of_its_own_are_replaced) {
  const Scratch scratch;
  record_square(scratch.path, true);
  std::vector<Result> results;
  results.emplace_back(scratch.path);
  const fs::path page = scratch.path / "page.html", table = scratch.path / "table.md",
                 link = scratch.path / "link";
  write_report(results, page);
  write_paper_table(results, table);
  EXPECT_TRUE(is_report_page(page) && is_report_table(table));
  EXPECT_FALSE(is_report_page(table) || is_report_table(page));
  fs::create_symlink(page, link);
  EXPECT_FALSE(is_report_page(link));
  replace_text_file(table, read_text_file(table) + "Notes of my own.\n");
  EXPECT_FALSE(is_report_table(table));
  EXPECT_THROW(require_own(table, is_report_table), Error);
  EXPECT_THROW(require_own(scratch.path, is_report_page), Error);
  EXPECT_NO_THROW(require_own(page, is_report_page));
  EXPECT_NO_THROW(require_own(scratch.path / "fresh.html", is_report_page));
}

TEST(Report, No_text_of_a_case_ends_a_script) {
  const Scratch scratch;
  record_square(scratch.path, true);
  const std::string page = report_text(scratch.path);
  std::size_t opened = 0, closed = 0;
  for (std::size_t i = page.find("<script"); i != std::string::npos; i = page.find("<script", i + 1))
    ++opened;
  for (std::size_t i = page.find("</script"); i != std::string::npos; i = page.find("</script", i + 1))
    ++closed;
  EXPECT_EQ(opened, 5u);  // plots, net, two libraries, our own
  EXPECT_EQ(closed, opened);
}

TEST(Report, The_data_of_the_turnable_net_read_back) {
  const Scratch scratch;
  record_square(scratch.path, true);
  const Result result(scratch.path);
  const auto view = nlohmann::json::parse(net_view_json(result, result.model(), Camera()));
  EXPECT_EQ(view["times"].size(), 11u);
  EXPECT_EQ(view["nodes"], 4);
  EXPECT_EQ(view["positions"].get<std::string>().size(), 11u * 4 * 3 * 2 * 4 / 3);
  EXPECT_EQ(view["thinned"], false);
  EXPECT_EQ(view["waypoints"], "");
}

// What page.js draws with: for each joint the number of its element among those shown, and a place in steps.
TEST(Report, The_turnable_net_leads_threads_through_their_rings) {
  const Scratch scratch;
  ResultModel model = square_model();
  model.joints = {{1, 0}};
  Frame frame = square_frame(1);
  frame.joint_element = {4};
  frame.joint_waypoint = {{0, 2, 0}};  // beyond all nodes
  { Recorder(scratch.path, model, {}).frame(frame); }
  const Result result(scratch.path);
  const auto view = nlohmann::json::parse(net_view_json(result, result.model(), Camera()));
  const std::uint8_t expected[] = {4, 0, 0, 0, 65000 % 256, 65000 / 256, 0, 0};
  EXPECT_EQ(view["waypoints"], html::base64(expected));
}

TEST(Report, A_run_without_a_summary_is_still_shown) {
  const Scratch scratch;
  record_square(scratch.path, false);
  const std::string page = report_text(scratch.path);
  EXPECT_NE(page.find("left no summary"), std::string::npos);
  EXPECT_NE(page.find("<svg class=\"net\""), std::string::npos);
  std::ostringstream out;
  print_verdict(Result(scratch.path), out);
  EXPECT_NE(out.str().find("unfinished"), std::string::npos);
}

TEST(Report, No_result_is_refused) { EXPECT_THROW(write_report({}, "nowhere.html"), Error); }

}  // namespace
}  // namespace cinch
