// Runs the settings of a problem and compares them with its reference, on one thread each.
#pragma once
#include "study_result.hpp"

namespace cinch::study {

/// What runs are compared with: the mean of a problem's finest runs; nothing where there is an exact
/// solution.
struct Reference {
  Track track;
  Errors errors;  ///< its own, by each measure
};

Reference reference_of(const Problem& problem);

/// What a setting comes to, or why it stopped.
RunResult run(const Problem& problem, const Setting& setting, const Track& reference);

}  // namespace cinch::study
