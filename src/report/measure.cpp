#include "report/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cinch::measure {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double kPullEnd = 1;     // s: end of the paper's run, Sec. 5.1
constexpr double kInstant = 1e-6;  // s: times this near to each other are the same

const Digest* with_elements(const Results& results, int elements) {
  for (const Digest* d : results)
    if (d->thread_elements() == elements) return d;
  return nullptr;
}

Results by_elements(Results results) {
  std::sort(results.begin(), results.end(),
            [](const Digest* a, const Digest* b) { return a->thread_elements() < b->thread_elements(); });
  return results;
}

// Frames and samples come at the steps nearest to their times.
double same_time(const Digest& d) {
  return std::max(kInstant, 1.001 * 0.5 * std::max(d.model.time_step, d.model.closing_time_step));
}

Measured at_time(const Digest& d, const Series& series, double time) {
  if (!reaches(d, time)) return past_the_end(d, time);
  if (told(d, series.t, time)) return {series.at(time), ""};
  char text[60];
  std::snprintf(text, sizeof text, "no samples near %.4g s", time);
  return missing(text);
}

Measured less(const Measured& a, const Measured& b) {
  if (!a.value || !b.value) return a.value ? b : a;
  return {*a.value - *b.value, ""};
}

}  // namespace

Measured missing(const std::string& what) { return {std::nullopt, what}; }

Measured past_the_end(const Digest& d, double time) {
  char text[80];
  std::snprintf(text, sizeof text, "the run ends at %.4g s, before %.4g s", d.end_time(), time);
  return missing(text);
}

// Runs end at the step nearest to the end that they were given.
bool reaches(const Digest& d, double time) { return d.end_time() >= time - same_time(d); }

Measured too_few(double from, double to) {
  char text[80];
  std::snprintf(text, sizeof text, "fewer than two samples from %.4g s to %.4g s", from, to);
  return missing(text);
}

bool told(const Digest& d, const std::vector<double>& t, double time) {
  const double same = same_time(d);
  const auto after = std::lower_bound(t.begin(), t.end(), time - same);
  if (after != t.end() && *after <= time + same) return true;
  if (after == t.begin() || after == t.end()) return false;
  return *after - time <= sample_reach && time - *(after - 1) <= sample_reach;
}

std::optional<Peak> peak_force(const Digest& d, int ring, double until) {
  const RingRecord* record = d.record(ring);
  if (record && record->peak_time <= until + kInstant) return Peak{record->peak_force, record->peak_time, ""};
  if (ring < 0 || d.ring_force.size() <= at(ring) || d.ring_force[at(ring)].empty()) return std::nullopt;
  const VectorSeries& force = d.ring_force[at(ring)];
  if (samples_between(force.t, 0, until + kInstant) < 2) return std::nullopt;
  Peak peak{0, -1, force.source};
  for (std::size_t i = 0; i < force.t.size() && force.t[i] <= until + kInstant; ++i)
    if (const double size = force.v[i].norm(); size > peak.force) peak.force = size, peak.time = force.t[i];
  return peak;
}

Measured ball_ahead_of_ring(const Digest& d) {
  if (d.mass_position.empty() || d.ring_position.empty()) return missing("no ball or no ring in this result");
  return less(at_time(d, d.mass_position[0].component(1), kPullEnd),
              at_time(d, d.ring_position[0].component(1), kPullEnd));
}

Measured ring_end_speed(const Digest& d) {
  if (d.ring_position.empty() || d.frame_times.size() < 2) return missing("no ring or a single frame");
  constexpr double span = 0.1 * kPullEnd;
  const Series y = d.ring_position[0].component(1);
  Measured way = less(at_time(d, y, kPullEnd), at_time(d, y, kPullEnd - span));
  if (way.value) *way.value /= span;
  return way;
}

Measured peak_ring_force(const Digest& d) {
  if (!reaches(d, kPullEnd)) return past_the_end(d, kPullEnd);
  Measured greatest = missing("no ring force recorded");
  for (int r = 0; r < static_cast<int>(d.model.rings.size()); ++r) {
    const auto peak = peak_force(d, r, kPullEnd);
    if (!peak || (greatest.value && peak->force <= *greatest.value)) continue;
    greatest = {peak->force, ""};
    if (!peak->source.empty()) greatest.note = "from " + peak->source + " only: the true peak may be higher";
  }
  return greatest;
}

Measured greatest_force_rise(const Results& results) {
  const Results sorted = by_elements(results);
  std::optional<double> rise;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const auto before = peak_ring_force(*sorted[i - 1]).value, after = peak_ring_force(*sorted[i]).value;
    if (before && after && sorted[i - 1]->thread_elements() < sorted[i]->thread_elements())
      rise = std::max(rise.value_or(-std::numeric_limits<double>::infinity()), *after - *before);
  }
  return {rise, ""};
}

Measured curves_apart(const Results& results, int fewer, int more) {
  const Digest *a = with_elements(results, fewer), *b = with_elements(results, more);
  if (!a || !b)
    return missing("needs results of " + std::to_string(fewer) + " and " + std::to_string(more) +
                   " elements");
  for (const Digest* d : {a, b})
    if (!reaches(*d, kPullEnd)) return past_the_end(*d, kPullEnd);
  const Series ya = a->ring_position.at(0).component(1), yb = b->ring_position.at(0).component(1);
  double apart = 0;
  int samples = 0;  // but for the start, where both are the same
  for (const double t : a->frame_times) {
    if (t > kPullEnd + kInstant || !told(*a, ya.t, t) || !told(*b, yb.t, t)) continue;
    apart = std::max(apart, std::abs(ya.at(t) - yb.at(t)));
    samples += t > 0;
  }
  return samples < 2 ? too_few(0, kPullEnd) : Measured{apart, ""};
}

Measured beyond(const Digest& d, const Results& results, int reference) {
  const Digest* other = with_elements(results, reference);
  if (!other) return missing("needs a result of " + std::to_string(reference) + " elements");
  return less(at_time(d, d.ring_position.at(0).component(1), kPullEnd),
              at_time(*other, other->ring_position.at(0).component(1), kPullEnd));
}

Measured ring_at(const Digest& d, int ring, int axis, double time) {
  if (d.ring_position.size() <= at(ring)) return missing("no ring in this result");
  return at_time(d, d.ring_position[at(ring)].component(axis), time);
}

Measured mass_at(const Digest& d, int mass, int axis, double time) {
  if (d.mass_position.size() <= at(mass)) return missing("no ball in this result");
  return at_time(d, d.mass_position[at(mass)].component(axis), time);
}

Measured start_speed(const Digest& d) {
  if (d.frame_times.empty()) return missing("no frames");
  return {d.start_speed, ""};
}

Measured spread_at(const Digest& d, double time) {
  if (d.mouth_spread.empty()) return missing("fewer than two rings");
  return at_time(d, d.mouth_spread, time);
}

std::optional<std::array<int, 2>> left_and_right(const Digest& d) {
  if (d.mass_position.size() != 2 || d.ring_position.empty() || d.mass_position[0].empty())
    return std::nullopt;
  const auto named = [&](int m, const char* word) {
    return d.model.masses[at(m)].name.find(word) != std::string::npos;
  };
  if (named(0, "left") || named(1, "right")) return std::array{0, 1};
  if (named(1, "left") || named(0, "right")) return std::array{1, 0};
  Vec3 centre = Vec3::Zero();
  for (const VectorSeries& ring : d.ring_position)
    centre += ring.v.front() / static_cast<double>(d.ring_position.size());
  const double first = (d.mass_position[0].v.front() - centre).norm(),
               second = (d.mass_position[1].v.front() - centre).norm();
  return first <= second ? std::array{0, 1} : std::array{1, 0};
}

Measured left_above_right(const Digest& d, double time) {
  const auto pair = left_and_right(d);
  if (!pair) return missing("needs two named masses and rings");
  if (!d.gravity) return missing("no gravity in the resolved case");
  const Vec3 up = -d.gravity->normalized();
  const auto height = [&](int mass) {
    const VectorSeries& path = d.mass_position[at(mass)];
    Series heights{path.t, {}};
    for (const Vec3& place : path.v) heights.v.push_back(up.dot(place));
    return at_time(d, heights, time);
  };
  return less(height((*pair)[0]), height((*pair)[1]));
}

}  // namespace cinch::measure
