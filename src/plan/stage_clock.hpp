// Times the stages of a step on few steps, as a reading of the clock costs as much as a small kernel: what it
// finds are shares, of a time that is measured over all steps.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>

#include "plan/step_plan.hpp"

namespace cinch {

using StageSeconds = std::array<double, stage_count>;

inline double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class StageClock {
 public:
  static constexpr std::uint64_t timed_every = 61;  ///< no multiple of what happens every few steps

  /// Runs when stretch number `number` of steps is one of those timed; adds to `seconds`.
  StageClock(std::int64_t number, StageSeconds& seconds)
      : timed_(static_cast<std::uint64_t>(number) % timed_every == 0), seconds_(seconds) {
    if (timed_) last_ = clock_seconds();
  }

  /// Books the time since the last tick on a stage.
  void tick(StageId stage) {
    if (!timed_) return;
    const double t = clock_seconds();
    seconds_[static_cast<std::size_t>(stage)] += t - last_;
    last_ = t;
  }

 private:
  bool timed_;
  StageSeconds& seconds_;
  double last_ = 0;
};

/// `whole` seconds shared out as the sampled ones are.
inline StageSeconds share_out(const StageSeconds& sampled, double whole) {
  const double sum = std::accumulate(sampled.begin(), sampled.end(), 0.0);
  StageSeconds seconds{};
  for (std::size_t s = 0; s < stage_count && sum > 0; ++s) seconds[s] = whole * sampled[s] / sum;
  return seconds;
}

}  // namespace cinch
