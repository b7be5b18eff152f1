#include "plan/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cinch {
namespace {

// Inverse masses with zero at fixed nodes.
std::vector<double> mobility(const Model& model) {
  std::vector<double> inverse;
  inverse.reserve(model.mass.size());
  for (const double mass : model.mass) inverse.push_back(1 / mass);
  for (const kernel::Constraint& c : model.constraints)
    if (c.ax == 0 && c.ay == 0 && c.az == 0) inverse[static_cast<std::size_t>(c.node)] = 0;
  return inverse;
}

// Calls visit(e, a, b) for each element and its usage(dt) = a dt^2 + b dt of the stable step.
template <class Visit>
void for_each_usage(const Model& model, const std::vector<double>& inverse, Visit visit) {
  const auto elements = static_cast<std::size_t>(model.elements);
  std::vector<double> k_sum(inverse.size()), c_sum(inverse.size());
  for (std::size_t e = 0; e < elements; ++e)
    for (const Index end : {model.end_a[e], model.end_b[e]}) {
      k_sum[static_cast<std::size_t>(end)] += model.stiffness[e];
      c_sum[static_cast<std::size_t>(end)] += model.damping[e];
    }
  for (std::size_t e = 0; e < elements; ++e) {
    const auto a = static_cast<std::size_t>(model.end_a[e]), b = static_cast<std::size_t>(model.end_b[e]);
    visit(e, (k_sum[a] * inverse[a] + k_sum[b] * inverse[b]) / 4,
          (c_sum[a] * inverse[a] + c_sum[b] * inverse[b]) / 2);
  }
}

}  // namespace

StableStep stable_step(const Model& model) {
  StableStep out;
  out.step = std::numeric_limits<double>::infinity();
  for_each_usage(model, mobility(model), [&](std::size_t e, double quadratic, double linear) {
    // the positive root of quadratic dt^2 + linear dt = 1, free of cancellation
    const double step = 2 / (linear + std::sqrt(linear * linear + 4 * quadratic));
    if (step < out.step) {
      out.step = step;
      out.element = static_cast<Index>(e);
    }
  });
  return out;
}

std::vector<double> node_share(const Model& model, double step) {
  const std::vector<double> inverse = mobility(model);
  std::vector<double> used(inverse.size());
  for_each_usage(model, inverse, [&](std::size_t e, double quadratic, double linear) {
    const double usage = (quadratic * step + linear) * step;
    for (const Index end : {model.end_a[e], model.end_b[e]}) {
      double& u = used[static_cast<std::size_t>(end)];
      u = std::max(u, usage);
    }
  });
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = inverse[i] / std::max(1 - used[i], 1e-3);
  return used;
}

}  // namespace cinch
