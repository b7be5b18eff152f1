// When steps are: before the closing time and from it on they may differ in length.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cinch {

class Timeline {
 public:
  Timeline() = default;
  /// Steps of `dt` s all the time.
  explicit Timeline(double dt) : before_(dt), after_(dt) {}
  /// Steps of `before` s up to step `closing`, of `after` s from it on.
  Timeline(double before, double after, std::int64_t closing)
      : before_(before), after_(after), closing_(before == after ? 0 : closing) {}

  /// s, of the steps before the closing time and from it on.
  double before() const { return before_; }
  double after() const { return after_; }

  double time_of(std::int64_t step) const {
    if (step <= closing_) return static_cast<double>(step) * before_;
    return closing_time() + static_cast<double>(step - closing_) * after_;
  }
  /// The step nearest to a time; 9e18 for what lies further ahead than can be counted.
  std::int64_t step_at(double time) const {
    if (time <= closing_time()) return nearest(time / before_);
    return closing_ + std::min(nearest((time - closing_time()) / after_), most - closing_);
  }

 private:
  double closing_time() const { return static_cast<double>(closing_) * before_; }
  static constexpr std::int64_t most = 9'000'000'000'000'000'000;
  static std::int64_t nearest(double steps) {
    return std::llround(std::min(steps, static_cast<double>(most)));
  }

  double before_ = 0, after_ = 0;
  std::int64_t closing_ = 0;  ///< 0: one length; the sums above are plain products then
};

}  // namespace cinch
