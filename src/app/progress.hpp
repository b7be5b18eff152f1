// The progress line of a run, on stderr: one line that renews itself on a terminal, plain lines elsewhere.
#pragma once
#include <cstdint>
#include <string>

namespace cinch::app {

class Progress {
 public:
  /// `simulated`, `step`: where the run begins.
  Progress(double end_time, bool quiet, double simulated, std::int64_t step);
  /// Shows simulated time, steps per second, minutes of run time per simulated second and time left, when it
  /// is time.
  void update(double simulated, std::int64_t step);
  /// Ends the line.
  void finish();

 private:
  void show(double simulated, std::int64_t step, double wall);
  double end_time_, begin_, last_shown_, window_wall_, window_simulated_;
  std::int64_t window_step_;
  bool quiet_, terminal_, open_ = false;
};

/// "1:23" or "1:02:03" from seconds.
std::string clock_text(double seconds);

}  // namespace cinch::app
