// A net that hangs at rest, for as many steps as wanted.
#pragma once
#include "cell.hpp"

namespace cinch::matrix {

/// Held where no node leaves its place by more than rounding and slow settling give.
Outcome quiet_net(std::int64_t steps);

}  // namespace cinch::matrix
