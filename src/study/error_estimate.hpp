// How far a case is from what it converges to, told by runs beside its own: with half the step, with finer
// threads besides, and with nodes that begin next to nothing elsewhere.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cinch {

struct ErrorEstimate {
  static constexpr double nudge = 1e-9;  ///< by which nodes begin elsewhere, m
  /// of_step: of the case from one with half its step. of_threads: of that from one with twice the elements
  /// in its threads besides. of_chance: what both would be if only chance made them.
  enum Difference { of_step, of_threads, of_chance };
  static constexpr int differences = 3;

  struct Row {
    std::string name;     ///< of the probe, or "all nodes"
    std::string measure;  ///< what is compared, in words
    std::string unit;
    double size = 0;                               ///< of the case's own, to compare with
    bool still = false;                            ///< its size is rounding: nothing to compare with
    std::array<double, differences> difference{};  ///< NaN where a run was stopped

    /// What errors of first order would be: twice the differences that halving step and elements makes.
    double error() const { return 2 * (difference[of_step] + difference[of_threads]); }
    /// Whether chance would make half or more of both differences: more runs would tell more.
    bool by_chance() const {
      return 4 * difference[of_chance] > difference[of_step] + difference[of_threads];
    }
    /// A bound where by_chance(): each of both differences may hide twice as much as chance makes.
    double bound() const { return error() + 8 * difference[of_chance]; }
    /// Whether that bound says enough: 1 %, what the defaults aim at.
    bool bounded() const { return bound() <= 0.01 * size; }
  };
  std::vector<Row> rows;
  std::vector<std::string> stopped;  ///< what stopped runs beside the case's own
};

struct ErrorRuns {
  int each = 1;     ///< runs of the case and of each finer one, whose means are compared
  int threads = 0;  ///< for all runs together; 0: what the machine has
};

/// Each round of runs takes seven times as long as the case itself; one run of the case more tells what
/// chance does where `each` is 1. Runs of small scenes go side by side; the numbers are the same for any
/// number of threads. `announce` is called with what each run is. Throws NumericalError where the case's own
/// run goes wrong.
ErrorEstimate estimate_error(const Scene& scene, const ErrorRuns& runs,
                             const std::function<void(const std::string&)>& announce);

}  // namespace cinch
