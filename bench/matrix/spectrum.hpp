// The true stable step of a scene as it lies, by eigenvalues: what the solver's bound is held against.
#pragma once
#include <vector>

#include "plan/preparation.hpp"

namespace cinch::matrix {

/// Largest eigenvalue of M^-1 (dt^2/4 K + dt/2 C): central differences with lagged dampers stay bounded up to
/// one. K with the stiffness that tension gives across; every element counts as taut along itself.
double largest_usage(const Model& model, const std::vector<Vec3>& place, double step);

/// The step at which that is one, s.
double critical_step(const Model& model, const std::vector<Vec3>& place);

/// Where nodes are at t = 0.
std::vector<Vec3> places(const Assembly& assembly);

}  // namespace cinch::matrix
