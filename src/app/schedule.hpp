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
  std::int64_t next() const { return interval_ > 0 ? step_of(count_) : never; }
  /// Whether it is due at `step`; from then on the next one is.
  bool due(std::int64_t step) {
    if (step < next()) return false;
    count_ = first_after(step);
    return true;
  }

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
  std::int64_t step_of(std::int64_t count) const {
    return timeline_.step_at(static_cast<double>(count) * interval_);
  }
  // Many may fall on one step: the bounds close in on it from `count_` on.
  std::int64_t first_after(std::int64_t step) const {
    std::int64_t past = count_, stride = 1;
    while (step_of(past + stride) <= step) past += stride, stride *= 2;
    for (; stride > 1; stride /= 2)
      if (step_of(past + stride / 2) <= step) past += stride / 2;
    return past + 1;
  }

  double interval_;
  Timeline timeline_;
  std::int64_t count_ = 0;
};

}  // namespace cinch::app
