// The groups of the stability matrix.
#pragma once
#include "cell.hpp"

namespace cinch::matrix {

/// Moduli, element lengths, mass ratios, damping and contact made stiff, with step_s = "auto".
std::vector<Cell> stiffness(Extent extent);
/// A thread that turns slack and taut, with steps close to the stable one and little damping.
std::vector<Cell> slack(Extent extent);
/// Steps on both sides of the stable one in scenes that stay taut, and the search for counter-examples.
std::vector<Cell> step(Extent extent);
/// Impacts, rings and threads in places where formulas divide by nothing, long rest.
std::vector<Cell> motion(Extent extent);
/// The same bits with any number of threads.
std::vector<Cell> threads(Extent extent);

std::vector<Cell> all_cells(Extent extent);

}  // namespace cinch::matrix
