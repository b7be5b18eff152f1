// Static equilibrium to about 1e-7 of the weight by an interior-point method, blind to the first guess.
//
// Minimising the energy is the same as minimising sum T^2 / (2 k) - sum m g.x under e(x) = l - l0 <= T / k.
// With the slack s = T / k - e >= 0 its conditions are
//     force(x, T) = 0,     s + e(x) - T / k = 0,     T s = nu -> 0,     T, s > 0.
// A Newton step of these, with de = u.(dx_j - dx_i), has
//     ds = -(s + e - T / k) - de + dT / k,     dT = a de + c,
//     a = T / (s + T / k),     c = (nu + T (e - T / k)) / (s + T / k),
// and leaves a symmetric system for dx: axial stiffness a, force density T / l, load force(x, T + c).
// T > 0 keeps it positive definite even where members are slack.
#pragma once
#include "statics/workspace.hpp"

namespace cinch::statics {

/// Shape close to the equilibrium, m, or the last one when `work` ran out of factorisations or the steps
/// became too short. It does not say which: the true energy judges it afterwards.
Points interior_point(Workspace& work);

}  // namespace cinch::statics
