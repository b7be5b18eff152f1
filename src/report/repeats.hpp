// Numbers of a run that was made again and again, each time begun a little otherwise: what hangs on chance is
// told by its median and range.
#pragma once
#include <functional>

#include "report/measure.hpp"

namespace cinch {

/// Whether two runs close at the same time.
bool repeats(const ResultModel& one, const ResultModel& other);

/// A run and those of `again` that repeat it: of the same case of the paper, closing at the same time.
std::vector<const Digest*> with_repeats(const Digest& run, const std::vector<Digest>& again);

/// The median of a number over runs, where more than half of them have it. Runs without it count as above all
/// others: what has not come by the end is late.
Measured median_over(const std::vector<const Digest*>& runs,
                     const std::function<Measured(const Digest&)>& measure, std::string_view unit);

}  // namespace cinch
