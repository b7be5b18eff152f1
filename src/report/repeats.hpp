// Numbers of a capture that was made again and again, each time begun a little otherwise: what hangs on
// chance is told by its median and range.
#pragma once
#include <functional>

#include "report/measure.hpp"

namespace cinch {

/// Whether two captures close at the same time.
bool repeats(const ResultModel& one, const ResultModel& other);

/// A capture and those of `again` that repeat it.
std::vector<const Digest*> with_repeats(const Digest& run, const std::vector<Digest>& again);

/// The median of a number over runs. What has not come by a run's end is later than all that has; runs that
/// cannot tell count for nothing. Without value where that leaves the median open. The note of a single run
/// stays where it is that of all.
Measured median_over(const std::vector<const Digest*>& runs,
                     const std::function<Measured(const Digest&)>& measure, std::string_view unit);

}  // namespace cinch
