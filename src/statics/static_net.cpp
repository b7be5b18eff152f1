#include "statics/static_net.hpp"

#include <algorithm>
#include <cstddef>

#include "statics/element.hpp"
#include "statics/freedom.hpp"

namespace cinch {

double static_energy(const StaticNet& net, const std::vector<Vec3>& position) {
  double energy = 0;
  for (std::size_t n = 0; n < position.size(); ++n) energy -= net.mass[n] * net.gravity.dot(position[n]);
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const double stretch = std::max(0.0, statics::elongation(net, position, e));
    energy += 0.5 * net.stiffness[e] * stretch * stretch;
  }
  return energy;
}

std::vector<Vec3> static_force(const StaticNet& net, const std::vector<Vec3>& position) {
  return statics::nodal_force(net, position,
                              [&](std::size_t e) { return statics::force_density(net, position, e); });
}

Eigen::SparseMatrix<double> static_hessian(const StaticNet& net, const std::vector<Vec3>& position) {
  StaticNet unsupported = net;
  unsupported.support.assign(position.size(), Support::free);
  return statics::Freedom(unsupported).assemble(net, [&](std::size_t e) {
    return statics::true_block(net, position, e);
  });
}

}  // namespace cinch
