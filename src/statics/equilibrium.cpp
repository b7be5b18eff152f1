#include "statics/equilibrium.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "base/error.hpp"
#include "statics/interior_point.hpp"
#include "statics/net_checks.hpp"
#include "statics/trust_region.hpp"

namespace cinch {
namespace {

using statics::Points;
using statics::Workspace;

void check_converged(const Workspace& work, const Points& x, double tolerance) {
  const statics::Vector f = work.residual(x);
  if (f.size() == 0) return;
  const std::size_t worst = work.freedom.worst_node(f);
  const double force = work.freedom.nodal_norm(f, worst);
  // a net so stiff that rounded coordinates cannot reach the tolerance is as good as it can be
  const double relative = std::max(tolerance, 1e-9) * work.weight;
  if (force <= std::max(relative, statics::rounding_force(work.net, x))) return;
  char text[160];
  std::snprintf(text, sizeof text,
                " keeps a residual force of %.3g N (%.3g of the weight) after %d factorisations", force,
                force / work.weight, work.iterations);
  throw NumericalError("error: static equilibrium not found: " + statics::describe(work.net, x, worst) +
                       text);
}

EquilibriumResult result_of(const Workspace& work, Points x) {
  const StaticNet& net = work.net;
  EquilibriumResult result;
  if (work.weight > 0) result.relative_residual = work.freedom.largest(work.residual(x)) / work.weight;
  result.iterations = work.iterations;
  for (std::size_t e = 0; e < net.elements.size(); ++e)
    if (statics::elongation(net, x, e) <= 0) ++result.slack_elements;
  result.energy = static_energy(net, x);
  result.position = std::move(x);
  return result;
}

}  // namespace

EquilibriumResult find_equilibrium(const StaticNet& net, const EquilibriumOptions& options) {
  statics::check_net(net);
  Workspace work(net, options.max_iterations);
  const double tolerance = options.tolerance * work.weight;
  Points x = net.position;
  const bool balanced = work.freedom.largest(work.residual(x)) <= tolerance;
  if (!balanced) x = statics::trust_region(work, statics::interior_point(work), tolerance);
  check_converged(work, x, options.tolerance);
  return result_of(work, std::move(x));
}

}  // namespace cinch
