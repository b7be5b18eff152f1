// Measurements of the net's closure, paper Sec. 5.3.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "report/measure.hpp"

namespace cinch::measure {
namespace {

constexpr double kAfter = 0.1;  // s: "until 1.6 s" for a closing time of 1.5 s
constexpr double kWhole = 0.5;  // s: the paper's run ends at 2 s

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Measured no_event(const Digest& d, const std::string& what) {
  if (!d.summary) return missing("the run left no summary");
  return {std::nullopt, what + " until " + std::to_string(d.end_time()).substr(0, 5) + " s", true};
}

// A sample this near the closing time counts neither as before nor as after.
double slack(const Digest& d) { return 1.5 * std::max({d.model.time_step, d.model.closing_time_step, 1e-9}); }

Series velocity(const Digest& d, int mass, int axis) { return d.mass_velocity[at(mass)].component(axis); }

// The first sample after the separation; nothing where it comes late.
std::optional<double> just_after(const Digest& d, const Series& series) {
  const double from = *d.model.closing_time + slack(d);
  const auto next = std::upper_bound(series.t.begin(), series.t.end(), from);
  if (next == series.t.end() || *next > from + sample_reach) return std::nullopt;
  return series.v[static_cast<std::size_t>(next - series.t.begin())];
}

// A series from the separation on.
Series after_closing(const Digest& d, const Series& series) {
  const auto skipped =
      std::upper_bound(series.t.begin(), series.t.end(), *d.model.closing_time + slack(d)) - series.t.begin();
  return {{series.t.begin() + skipped, series.t.end()}, {series.v.begin() + skipped, series.v.end()}};
}

// Whether events were looked for twice at least behind `from`, up to `to`.
bool looked_twice(const Digest& d, double from, double to) {
  constexpr double rounding = 1e-9;
  const double interval = d.look_interval;
  return !(interval > 0) ||
         std::floor(to / interval + rounding) - std::floor(from / interval + rounding) >= 2;
}

Measured hardly_looked(const Digest& d) {
  char text[80];
  std::snprintf(text, sizeof text, "events were looked for every %.4g s only", d.look_interval);
  return missing(text);
}

std::string sampling(const Digest& d, int mass) {
  const VectorSeries& series = d.mass_velocity[at(mass)];
  return series.source == "probe" ? "" : "from frames only: coarse in time";
}

}  // namespace

std::optional<std::array<int, 2>> split_masses(const Digest& d) {
  for (const char* mechanism : {"mechanism.m1", "mechanism.1", "m1", "1"}) {
    const int a = d.mass(std::string(mechanism) + ".a"), b = d.mass(std::string(mechanism) + ".b");
    if (a >= 0 && b >= 0) return std::array{a, b};
  }
  return std::nullopt;
}

Measured first_touch(const Digest& d) {
  const auto time = d.first_event("target_contact");
  return time ? Measured{time, ""} : no_event(d, "nothing touched the target");
}

// "least area 6.0 % of the greatest before, at 1.586 s", from the closing time on.
std::string least_mouth(const Digest& d) {
  double greatest = 0, share = 1, when = 0;
  for (std::size_t i = 0; i < d.mouth_area.t.size(); ++i) {
    greatest = std::max(greatest, d.mouth_area.v[i]);
    if (d.mouth_area.t[i] <= *d.model.closing_time || !(d.mouth_area.v[i] < share * greatest)) continue;
    share = d.mouth_area.v[i] / greatest;
    when = d.mouth_area.t[i];
  }
  char text[100];
  std::snprintf(text, sizeof text, "; least area %.1f %% of the greatest before, at %.3f s", 100 * share,
                when);
  return when > 0 ? text : "";
}

Measured closed_after(const Digest& d) {
  const auto time = d.first_event("mouth_closed");
  if (!d.model.closing_time) return missing("nothing closes in this case");
  const double closing = *d.model.closing_time;
  if (!looked_twice(d, closing, time.value_or(closing + kWhole))) return hardly_looked(d);
  if (time) return {*time - closing, ""};
  Measured none = no_event(d, "the mouth did not close");
  none.note += least_mouth(d);
  return none;
}

Measured enclosed(const Digest& d) {
  if (!d.summary) return missing("the run left no summary");
  if (!d.model.closing_time) return missing("nothing closes in this case");
  const double end = *d.model.closing_time + kWhole;
  bool inside = false;
  for (const Event& event : d.turns("target_enclosed", "target_lost"))
    if (event.time <= end + slack(d)) inside = event.kind == "target_enclosed";
  if (inside) return {1, ""};
  if (!reaches(d, end)) return past_the_end(d, end);
  return looked_twice(d, *d.model.closing_time, end) ? Measured{0, ""} : hardly_looked(d);
}

Measured separation_jump(const Digest& d, int axis) {
  const auto pair = split_masses(d);
  if (!pair || !d.model.closing_time) return missing("no split masses of mechanism 1 in this result");
  const double before = *d.model.closing_time - slack(d);
  double size[2] = {0, 0};
  for (std::size_t side = 0; side < 2; ++side) {
    const Series v = velocity(d, (*pair)[side], axis);
    const auto jump = v.jump_at(*d.model.closing_time, slack(d));
    const bool near = samples_between(v.t, before - sample_reach, before) > 0 && just_after(d, v);
    if (!jump || !near) return missing("no samples on both sides of the closing time");
    size[side] = std::abs(*jump);
  }
  return {axis == 2 ? std::max(size[0], size[1]) : (size[0] + size[1]) / 2, sampling(d, (*pair)[0])};
}

Measured share_lost(const Digest& d, int axis) {
  const auto pair = split_masses(d);
  if (!pair || !d.model.closing_time) return missing("no split masses of mechanism 1 in this result");
  if (!reaches(d, *d.model.closing_time + kAfter)) return past_the_end(d, *d.model.closing_time + kAfter);
  const Series v = velocity(d, (*pair)[0], axis);
  const double end = *d.model.closing_time + kAfter;
  const auto start = just_after(d, v);
  if (!start || !told(d, v.t, end)) return too_few(*d.model.closing_time, end);
  if (!(std::abs(*start) > 0)) return missing("no velocity to lose");
  return {1 - v.at(end) / *start, sampling(d, (*pair)[0])};
}

Measured y_change_over_x(const Digest& d) {
  const auto pair = split_masses(d);
  if (!pair || !d.model.closing_time) return missing("no split masses of mechanism 1 in this result");
  const double closing = *d.model.closing_time;
  if (!reaches(d, closing + kAfter)) return past_the_end(d, closing + kAfter);
  double change[2] = {0, 0};
  for (int axis = 0; axis < 2; ++axis) {
    const Series v = velocity(d, (*pair)[0], axis);
    const auto start = just_after(d, v);
    if (!start || !told(d, v.t, closing + kAfter)) return too_few(closing, closing + kAfter);
    change[axis] = std::abs(v.at(closing + kAfter) - *start);
  }
  if (!(change[0] > 0)) return missing("its X velocity does not change");
  return {change[1] / change[0], sampling(d, (*pair)[0])};
}

Measured turns_positive_after(const Digest& d) {
  const auto pair = split_masses(d);
  if (!pair || !d.model.closing_time) return missing("no split masses of mechanism 1 in this result");
  const Series v = after_closing(d, velocity(d, (*pair)[0], 0));
  if (v.t.size() < 2) return too_few(*d.model.closing_time, d.end_time());
  if (v.v.front() >= 0) return missing("positive from the first sample after the closing time on");
  const auto turn = v.rises_through(0, *d.model.closing_time);
  if (!turn) return no_event(d, "it did not turn");
  return {*turn - *d.model.closing_time, ""};
}

Measured mirror_departure(const Digest& d) {
  const auto pair = split_masses(d);
  if (!pair || !d.model.closing_time) return missing("no split masses of mechanism 1 in this result");
  if (!reaches(d, *d.model.closing_time + kAfter)) return past_the_end(d, *d.model.closing_time + kAfter);
  const VectorSeries &a = d.mass_velocity[at((*pair)[0])], &b = d.mass_velocity[at((*pair)[1])];
  if (a.t != b.t) return missing("one of both masses has a probe, the other frames only");
  double most = 0;
  int samples = 0;
  for (std::size_t i = 0; i < a.t.size(); ++i) {
    const double after = a.t[i] - *d.model.closing_time;
    if (after <= slack(d) || after > kAfter) continue;
    const Vec3 off(b.v[i].x() + a.v[i].y(), b.v[i].y() + a.v[i].x(), b.v[i].z() - a.v[i].z());
    most = std::max(most, off.cwiseAbs().maxCoeff());
    ++samples;
  }
  if (samples < 2) return too_few(*d.model.closing_time, *d.model.closing_time + kAfter);
  return {most, ""};
}

Measured first_collision_time(const Digest& d, const std::string& ring) {
  const RingRecord* record = d.record(d.ring(ring));
  if (!record || !d.model.closing_time) return missing("no record of ring " + ring);
  if (record->first_contact_time < 0) return no_event(d, "ring " + ring + " was never touched");
  return {record->first_contact_time - *d.model.closing_time, ""};
}

Measured first_collision_force(const Digest& d, const std::string& ring) {
  const RingRecord* record = d.record(d.ring(ring));
  if (!record) return missing("no record of ring " + ring);
  if (record->first_contact_time < 0) return missing(no_event(d, "ring " + ring + " was never touched").note);
  return {record->first_contact_force, ""};
}

Measured peak_force_time(const Digest& d, const std::string& ring) {
  if (!d.model.closing_time) return missing("nothing closes in this case");
  const double end = *d.model.closing_time + kWhole;
  if (!reaches(d, end)) return past_the_end(d, end);
  const auto peak = peak_force(d, d.ring(ring), end);
  if (!peak) return missing("no record of ring " + ring);
  if (!peak->source.empty() &&
      samples_between(d.ring_force[at(d.ring(ring))].t, *d.model.closing_time, end) < 2)
    return too_few(*d.model.closing_time, end);
  if (peak->time < 0) return no_event(d, "ring " + ring + " was never touched");
  char height[48];
  std::snprintf(height, sizeof height, "here %.3g N high", peak->force);
  return {peak->time - *d.model.closing_time,
          height + (peak->source.empty() ? "" : ", from " + peak->source + " only")};
}

Measured least_gain_along_z(const Results& results) {
  std::map<double, std::vector<double>>
      reached;  // by closing time: mean Z of mechanism 1's split masses 0.4 s later
  for (const Digest* d : results) {
    const auto pair = split_masses(*d);
    if (!pair || !d->model.closing_time || !reaches(*d, *d->model.closing_time + 0.4)) continue;
    const double time = *d->model.closing_time;
    if (!std::all_of(pair->begin(), pair->end(),
                     [&](int m) { return told(*d, d->mass_position[at(m)].t, time + 0.4); }))
      continue;
    double z = 0;
    for (const int m : *pair) z += d->mass_position[at(m)].component(2).at(time + 0.4) / 2;
    const auto known = reached.lower_bound(time - same_closing_time);
    const bool same = known != reached.end() && known->first < time + same_closing_time;
    (same ? known->second : reached[time]).push_back(z);
  }
  std::optional<double> least;
  std::optional<double> before;
  std::size_t runs = 1;
  for (const auto& [time, all] : reached) {
    runs = std::max(runs, all.size());
    const double z = std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
    if (before) least = std::min(least.value_or(z - *before), z - *before);
    before = z;
  }
  return {least, runs > 1 ? "means of up to " + std::to_string(runs) + " runs" : ""};
}

}  // namespace cinch::measure
