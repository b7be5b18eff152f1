#include "plan/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<double> mobilities(const Model& model) {
  std::vector<double> all;
  all.reserve(at(model.nodes));
  for (Index i = 0; i < model.nodes; ++i) all.push_back(mobility(model, i));
  return all;
}

// Calls visit(node, weight) for what ring of a joint moves: weight bounds how fast the thread's length
// changes with the node's place. Half of at most 2 goes to each end of a host, and its turn adds at most 2 c
// / L.
template <class Visit>
void for_each_host(const Model& model, const kernel::Joint& joint, Visit visit) {
  if (joint.host_a == joint.host_b) return visit(at(joint.host_a), 2.0);
  const double weight = 1 + 2 * joint.opening / model.ring_host_length[at(joint.ring)];
  visit(at(joint.host_a), weight);
  visit(at(joint.host_b), weight);
}

// S and C of the header.
struct NodeSums {
  std::vector<double> stiffness, damping;
};

// Of all elements, or of those of sliding threads only.
NodeSums node_sums(const Model& model, bool only_sliding = false) {
  NodeSums sums{std::vector<double>(at(model.nodes)), std::vector<double>(at(model.nodes))};
  const auto add = [&](std::size_t e) {
    for (const Index end : {model.end_a[e], model.end_b[e]}) {
      sums.stiffness[at(end)] += model.stiffness[e];
      sums.damping[at(end)] += model.damping[e];
    }
  };
  for (std::size_t e = 0; !only_sliding && e < at(model.elements); ++e) add(e);
  for (std::size_t t = 0; only_sliding && t < model.sliding_threads.size(); ++t)
    for (Index e = 0; e < model.sliding_threads[t].elements; ++e) add(at(model.sliding_first[t] + e));
  for (const kernel::SlidingThread& thread : model.sliding_threads)
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      for_each_host(model, model.joints[at(j)], [&](std::size_t node, double weight) {
        sums.stiffness[node] += weight * thread.stiffness;
        sums.damping[node] += weight * thread.damping;
      });
  return sums;
}

// Usage(dt) = quadratic dt^2 + linear dt of the stable step.
struct Usage {
  double quadratic = 0, linear = 0;

  void add(const NodeSums& sums, const std::vector<double>& inverse_mass, std::size_t node, double weight) {
    quadratic += weight * sums.stiffness[node] * inverse_mass[node] / 4;
    linear += weight * sums.damping[node] * inverse_mass[node] / 2;
  }
  double at_step(double step) const { return (quadratic * step + linear) * step; }
  /// Where it reaches `limit`: the positive root, free of cancellation.
  double step_at(double limit) const {
    return 2 * limit / (linear + std::sqrt(linear * linear + 4 * quadratic * limit));
  }
};

// What all rings of a thread, should they meet in one of its elements, add to that element's usage; by
// element.
std::vector<Usage> ring_usages(const Model& model, const NodeSums& sums,
                               const std::vector<double>& inverse_mass) {
  std::vector<Usage> usages(model.sliding_threads.empty() ? 0 : at(model.elements));
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    Usage sum;
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      for_each_host(model, model.joints[at(j)],
                    [&](std::size_t node, double weight) { sum.add(sums, inverse_mass, node, weight); });
    std::fill_n(usages.begin() + model.sliding_first[t], thread.elements, sum);
  }
  return usages;
}

// Of element e, with what rings add to it.
Usage usage_of(const Model& model, const NodeSums& sums, const std::vector<double>& inverse_mass,
               const std::vector<Usage>& rings, std::size_t e) {
  Usage usage = rings.empty() ? Usage{} : rings[e];
  usage.add(sums, inverse_mass, at(model.end_a[e]), 1);
  usage.add(sums, inverse_mass, at(model.end_b[e]), 1);
  return usage;
}

// Calls visit(e, usage) for each element.
template <class Visit>
void for_each_usage(const Model& model, const std::vector<double>& inverse_mass, Visit visit) {
  const NodeSums sums = node_sums(model);
  const std::vector<Usage> rings = ring_usages(model, sums, inverse_mass);
  for (std::size_t e = 0; e < at(model.elements); ++e)
    visit(e, usage_of(model, sums, inverse_mass, rings, e));
}

// Calls visit(e, usage) for each element of a sliding thread: of the joints that hold, for the time that they
// do.
template <class Visit>
void for_each_joint_usage(const Model& model, const std::vector<double>& inverse_mass, Visit visit) {
  const NodeSums sums = node_sums(model, true);
  const std::vector<Usage> rings = ring_usages(model, sums, inverse_mass);
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t)
    for (Index k = 0; k < model.sliding_threads[t].elements; ++k) {
      const std::size_t e = at(model.sliding_first[t] + k);
      visit(e, usage_of(model, sums, inverse_mass, rings, e));
    }
}

}  // namespace

StableStep stable_step(const Model& model) {
  StableStep out;
  out.step = std::numeric_limits<double>::infinity();
  for_each_usage(model, mobilities(model), [&](std::size_t e, const Usage& u) {
    const double step = u.step_at(1);
    if (step < out.step) {
      out.step = step;
      out.element = static_cast<Index>(e);
    }
  });
  return out;
}

int joint_steps(const Model& model, double step, double share, int most) {
  const std::vector<double> inverse = mobilities(model);
  std::vector<double> used(at(model.elements));
  for_each_usage(model, inverse, [&](std::size_t e, const Usage& usage) { used[e] = usage.at_step(step); });
  double steps = most;
  for_each_joint_usage(model, inverse, [&](std::size_t e, const Usage& usage) {
    const double limit = std::min(share, 1 - used[e]);
    steps = std::min(steps, limit > 0 ? usage.step_at(limit) / step : 1.0);
  });
  return std::max(1, static_cast<int>(steps));
}

std::vector<double> node_share(const Model& model, double step, int joint_steps) {
  const std::vector<double> inverse = mobilities(model);
  std::vector<double> used(at(model.elements)), used_at(inverse.size());
  for_each_usage(model, inverse, [&](std::size_t e, const Usage& usage) { used[e] = usage.at_step(step); });
  if (joint_steps > 1)
    for_each_joint_usage(model, inverse, [&](std::size_t e, const Usage& usage) {
      used[e] += usage.at_step(joint_steps * step);
    });
  const auto use = [&](Index node, double usage) { used_at[at(node)] = std::max(used_at[at(node)], usage); };
  for (std::size_t e = 0; e < used.size(); ++e) use(model.end_a[e], used[e]), use(model.end_b[e], used[e]);
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    const auto first = used.begin() + model.sliding_first[t];
    const double greatest = *std::max_element(first, first + thread.elements);
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      for_each_host(model, model.joints[at(j)],
                    [&](std::size_t node, double) { use(static_cast<Index>(node), greatest); });
  }
  for (std::size_t i = 0; i < used_at.size(); ++i) used_at[i] = inverse[i] / std::max(1 - used_at[i], 1e-3);
  return used_at;
}

}  // namespace cinch
