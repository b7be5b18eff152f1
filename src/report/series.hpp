// Time series as the report needs them: values at a time, crossings, thinning for plots.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.hpp"

namespace cinch {

/// A quantity over time (or over any other abscissa), in rising order of `t`.
struct Series {
  std::vector<double> t, v;
  bool empty() const { return t.empty(); }
  /// Linear between samples, the end values outside; nan when empty.
  double at(double time) const;
  /// The last value before `time` and the first one at or after it: what a jump at `time` is measured with. A
  /// sample within `slack` of `time` counts as neither.
  std::optional<double> jump_at(double time, double slack) const;
  /// First time after `from` at which the value passes from below `level` to `level` or more.
  std::optional<double> rises_through(double level, double from) const;
};

/// A vector over time; `source` says where it comes from ("probe" or "frames").
struct VectorSeries {
  std::vector<double> t;
  std::vector<Vec3> v;
  std::string source;
  bool empty() const { return t.empty(); }
  Series component(int axis) const;
  Series norm() const;
};

/// How many samples lie behind `from`, up to `to`.
std::size_t samples_between(const std::vector<double>& t, double from, double to);

/// At most `most` points of a series, keeping the least and the greatest value of each of most/2 stretches,
/// so that spikes survive; first and last point stay.
Series thinned(const Series& series, std::size_t most = 3000);

}  // namespace cinch
