// Steps at which something is due: the k-th is the one nearest to k times an interval.
#pragma once
#include <cstdint>
#include <limits>

#include "plan/timeline.hpp"

namespace cinch::app {

class Schedule {
 public:
  /// `interval` 0: never.
  Schedule(double interval, const Timeline& timeline) : interval_(interval), timeline_(timeline) {}
  std::int64_t next() const {
    if (interval_ <= 0) return std::numeric_limits<std::int64_t>::max();
    return timeline_.step_at(static_cast<double>(count_) * interval_);
  }
  /// Whether it is due at `step`; from then on the next one is.
  bool due(std::int64_t step) {
    if (step < next()) return false;
    while (next() <= step) ++count_;
    return true;
  }

 private:
  double interval_;
  Timeline timeline_;
  std::int64_t count_ = 0;
};

}  // namespace cinch::app
