#include "app/progress.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace cinch::app {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds) || seconds > 3.6e7) return "-:--";
  const auto s = static_cast<long>(seconds + 0.5);
  char text[32];
  if (s >= 3600) std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  else std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  return text;
}

Progress::Progress(double end_time, bool quiet, double simulated, std::int64_t step)
    : end_time_(end_time),
      begin_(now()),
      last_shown_(begin_),
      window_wall_(begin_),
      window_simulated_(simulated),
      window_step_(step),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::update(double simulated, std::int64_t step) {
  if (quiet_) return;
  const double wall = now();
  if (wall - last_shown_ < (terminal_ ? 0.1 : 10)) return;
  show(simulated, step, wall);
}

void Progress::show(double simulated, std::int64_t step, double wall) {
  // rates over the last stretch, so that the closing phase does not inherit the pace of the deployment
  const double stretch = wall - window_wall_, gained = simulated - window_simulated_;
  const double steps_per_second = stretch > 0 ? static_cast<double>(step - window_step_) / stretch : 0;
  const double minutes = gained > 0 ? stretch / 60 / gained : 0;
  std::fprintf(stderr, "%st = %.4f/%g s  %3.0f %%  %.3g steps/s  %.3g min per simulated second  %s left%s",
               terminal_ ? "\r\033[K" : "", simulated, end_time_, 100 * simulated / end_time_,
               steps_per_second, minutes, clock_text((end_time_ - simulated) * minutes * 60).c_str(),
               terminal_ ? "" : "\n");
  std::fflush(stderr);
  open_ = terminal_;
  last_shown_ = wall;
  if (stretch > 3) {
    window_wall_ = wall;
    window_simulated_ = simulated;
    window_step_ = step;
  }
}

void Progress::finish() {
  if (open_) std::fputs("\r\033[K", stderr);
  open_ = false;
}

}  // namespace cinch::app
