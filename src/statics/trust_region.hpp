// Static equilibrium to rounding by Newton's method on the true energy in a trust region.
//
// The steps are (H + mu I) q = f. H is never indefinite, so each is the minimiser of the quadratic model in a
// ball whose radius falls as mu rises; the ratio of real to promised gain moves mu.
#pragma once
#include "statics/workspace.hpp"

namespace cinch::statics {

/// Shape of the smallest residual found from `start`, m. Ends when the largest nodal residual is within
/// `tolerance`, N, or at rounding and no longer falling, or when `work` has run out of factorisations.
Points trust_region(Workspace& work, Points start, double tolerance);

/// Residual that rounded coordinates can force on a node of the net at positions x, N.
double rounding_force(const StaticNet& net, const Points& x);

}  // namespace cinch::statics
