// The table of `cinch check --error`.
#pragma once
#include "study/error_estimate.hpp"

namespace cinch::app {

void print_error(const ErrorEstimate& estimate);

}  // namespace cinch::app
