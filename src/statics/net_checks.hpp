// Refuses nets that have no static equilibrium, in words that name the node or element at fault.
#pragma once
#include <cstddef>
#include <string>

#include "statics/element.hpp"

namespace cinch::statics {

/// Throws NumericalError: arrays that do not fit together, values out of range, a piece that can fall.
void check_net(const StaticNet& net);

/// Name of node n and its coordinates at positions x, m, for messages.
std::string describe(const StaticNet& net, const Points& x, std::size_t n);

}  // namespace cinch::statics
