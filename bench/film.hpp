// States of a case at later times, computed once in a process and by one thread: the bits are those of any
// number.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "plan/simulation.hpp"

namespace cinch::bench {

class Film {
 public:
  /// Runs the case through all `times` (s, ascending).
  Film(const Scene& scene, const std::vector<double>& times);

  /// Moves a fresh simulation of the same scene on to one of the times. It passes the closing time by itself,
  /// so that its threads share the scene out as in a run.
  void wind(Simulation& simulation, double time) const;

 private:
  Timeline timeline_;
  std::map<std::int64_t, State> states_;  ///< by step; that before closing, too
};

}  // namespace cinch::bench
