// Steps at which something is due: the k-th is the one nearest to k times an interval.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cinch::app {

class Schedule {
 public:
  /// `interval` 0: never.
  Schedule(double interval, double dt) : interval_(interval), dt_(dt) {}
  std::int64_t next() const {
    if (interval_ <= 0) return std::numeric_limits<std::int64_t>::max();
    // an interval far beyond the end may be more steps than can be counted
    return std::llround(std::min(static_cast<double>(count_) * interval_ / dt_, 9e18));
  }
  /// Whether it is due at `step`; from then on the next one is.
  bool due(std::int64_t step) {
    if (step < next()) return false;
    while (next() <= step) ++count_;
    return true;
  }

 private:
  double interval_, dt_;
  std::int64_t count_ = 0;
};

}  // namespace cinch::app
