// Static equilibrium of lumped nodes and tension-only springs under gravity: the shape a hanging net starts
// from.
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "base/vec3.hpp"
#include "scene/scene.hpp"

namespace cinch {

/// What the static solver needs to know, in the caller's numbering of nodes and elements.
struct StaticNet {
  std::vector<Vec3> position;    ///< first guess, one for each node, m
  std::vector<double> mass;      ///< one for each node, kg; zero is allowed
  std::vector<Support> support;  ///< one for each node: free, guided (moves along its axis) or fixed
  std::vector<Vec3> axis;        ///< one for each node, unit; read for guided nodes only
  std::vector<std::array<Index, 2>> elements;  ///< the two nodes of each element
  std::vector<double> stiffness;               ///< k = E A / l0 of each element, N/m, above zero
  std::vector<double> rest_length;             ///< l0 of each element, m, above zero
  Vec3 gravity = Vec3::Zero();                 ///< m/s^2
};

struct EquilibriumOptions {
  double tolerance = 1e-10;   ///< largest nodal residual over the weight of the movable nodes, -
  int max_iterations = 2000;  ///< factorisations in all; usual nets need 20 to 60
};

struct EquilibriumResult {
  std::vector<Vec3> position;    ///< one for each node, m; fixed nodes as given
  double relative_residual = 0;  ///< largest nodal residual over the weight of the movable nodes, -
  int iterations = 0;            ///< factorisations in all
  int slack_elements = 0;        ///< elements no longer than their rest length
  double energy = 0;             ///< elastic plus gravitational, J
};

/// Sum of k max(0, l - l0)^2 / 2 over the elements less the sum of m g.x over the nodes, J.
/// `position` holds one point for each node of `net`, m.
double static_energy(const StaticNet& net, const std::vector<Vec3>& position);

/// Minus the gradient of `static_energy`, one vector for each node, N. Supports do not matter: at a fixed
/// node it is the load that the support carries.
std::vector<Vec3> static_force(const StaticNet& net, const std::vector<Vec3>& position);

/// Second derivative of `static_energy`, (3 nodes) x (3 nodes), lower triangle only, N/m; entry 3 n + c
/// belongs to coordinate c of node n. A slack element contributes explicit zeros.
Eigen::SparseMatrix<double> static_hessian(const StaticNet& net, const std::vector<Vec3>& position);

/// Minimum of `static_energy` over the movable degrees of freedom (free node 3, guided 1, fixed 0), from any
/// first guess, all members slack included. The residual of a node is its force, for a guided node the part
/// along the axis; without any weight it is measured against the largest residual of the first guess.
/// Coordinates are rounded to the last place of the largest one, so k times that is the least force that can
/// be balanced: a residual above `tolerance` is accepted once no step improves it and it is at most 1e-9 or
/// four times that rounding force over the weight. Throws NumericalError: arrays that do not fit together, a
/// piece that gravity can carry away (names a node of it), no convergence (names the node with the largest
/// residual, its coordinates and residual).
EquilibriumResult find_equilibrium(const StaticNet& net, const EquilibriumOptions& options = {});

}  // namespace cinch
