// Static equilibrium of a net under gravity, slack members included: the shape a hanging net starts from.
//
// The elastic energy k max(0, |d| - l0)^2 / 2 is a convex function of the element's vector d, gravity is
// linear: the total energy is convex and every stationary point is a global minimum. What makes it hard is
// stiffness (elements stretch by 1e-6 of their length where the shape moves by metres) and the jump of the
// second derivative where a member goes slack. Two methods share the work:
//  1. an interior-point method takes tension and slack as unknowns of their own. It sees neither difficulty,
//     and no first guess, and ends within about 1e-7 of the weight;
//  2. Newton's method in a trust region minimises the true energy from there to rounding.
#pragma once
#include <vector>

#include "base/error.hpp"
#include "base/vec3.hpp"
#include "statics/static_net.hpp"

namespace cinch {

/// A piece that gravity can carry away.
struct CanFall : NumericalError {
  std::size_t node, nodes;  ///< its first node; how many it has
  CanFall(const std::string& message, std::size_t first, std::size_t count)
      : NumericalError(message), node(first), nodes(count) {}
};

struct EquilibriumOptions {
  double tolerance = 1e-10;   ///< largest nodal residual over the weight of the movable nodes, -
  int max_iterations = 2000;  ///< factorisations in all
};

struct EquilibriumResult {
  std::vector<Vec3> position;    ///< one for each node, m; fixed nodes as given
  double relative_residual = 0;  ///< largest nodal residual over the weight of the movable nodes, -
  int iterations = 0;            ///< factorisations in all
  int slack_elements = 0;        ///< elements no longer than their rest length
  double energy = 0;             ///< elastic plus gravitational, J
};

/// Minimum of `static_energy` over the movable degrees of freedom (free node 3, guided 1, fixed 0), from any
/// first guess, all members slack included. The residual of a node is its force, for a guided node the part
/// along the axis; without any weight it is measured against the largest residual of the first guess.
/// Coordinates are rounded to the last place of the largest one, so k times that is the least force that can
/// be balanced: a residual above `tolerance` is accepted once no step improves it and it is at most 1e-9 or
/// four times that rounding force over the weight. Throws CanFall for a piece that gravity can carry away,
/// NumericalError for arrays that do not fit together and no convergence (names the node with the largest
/// residual, its coordinates and residual).
EquilibriumResult find_equilibrium(const StaticNet& net, const EquilibriumOptions& options = {});

}  // namespace cinch
