// One tension-only element of a static net: how far it is stretched, what it pulls, how stiff it is.
#pragma once
#include <Eigen/Dense>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/vec3.hpp"
#include "statics/static_net.hpp"

namespace cinch::statics {

using Points = std::vector<Vec3>;  ///< one for each node
using Block = Eigen::Matrix3d;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Vector from the first to the second node of element e at positions x, m. Displacements in place of x give
/// the change of that vector.
Vec3 span(const StaticNet& net, const Points& x, std::size_t e);

/// l - l0 of element e at positions x, m; good to rounding of itself, not only of l.
double elongation(const StaticNet& net, const Points& x, std::size_t e);

/// Tension over length of element e by the tension-only law, N/m; zero when slack.
double force_density(const StaticNet& net, const Points& x, std::size_t e);

/// Second derivative of the energy of an element whose vector is d, N/m; `axial` is dT / dl, N/m, and
/// `density` is T / l, N/m.
Block stiffness_block(const Vec3& d, double axial, double density);

/// `stiffness_block` of element e by the tension-only law, N/m; zero when slack.
Block true_block(const StaticNet& net, const Points& x, std::size_t e);

/// Force on each node at positions x, N: gravity plus the pull of the elements, of which element e has force
/// density q(e) = T / l, N/m.
Points nodal_force(const StaticNet& net, const Points& x, const std::function<double(std::size_t)>& q);

}  // namespace cinch::statics
