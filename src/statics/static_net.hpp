// A net at rest under gravity: lumped nodes, tension-only springs, its energy as a function of the positions.
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

/// Sum of k max(0, l - l0)^2 / 2 over the elements less the sum of m g.x over the nodes, J.
/// `position` holds one point for each node of `net`, m.
double static_energy(const StaticNet& net, const std::vector<Vec3>& position);

/// Minus the gradient of `static_energy`, one vector for each node, N. Supports do not matter: at a fixed
/// node it is the load that the support carries.
std::vector<Vec3> static_force(const StaticNet& net, const std::vector<Vec3>& position);

/// Second derivative of `static_energy`, (3 nodes) x (3 nodes), lower triangle only, N/m; entry 3 n + c
/// belongs to coordinate c of node n. A slack element contributes explicit zeros.
Eigen::SparseMatrix<double> static_hessian(const StaticNet& net, const std::vector<Vec3>& position);

}  // namespace cinch
