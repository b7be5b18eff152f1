// What closing threads and split masses weigh on until the closing time.
//
// A closing thread lies along its carrier and loads it evenly: between two knots with its mass there, half of
// it on each (eq. (2)). What its nodes weigh, taken where they lie, is not the same, unless elements are as
// long as the carrier's or a whole part of them: with 8 on a net of 12 meshes a knot bears half of what the
// next one does, and flies otherwise. The difference, which sums up to nothing, is told: when the thread is
// laid, it moves.
#pragma once
#include "scene/threading.hpp"

namespace cinch {

/// Sets mass_before of all nodes, and `excess` of the closing threads. `carriers`: by the thread's part.
void superpose_closing_masses(const std::map<Index, LaidAlong>& carriers, Assembly& assembly);

}  // namespace cinch
