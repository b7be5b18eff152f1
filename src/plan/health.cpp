#include "plan/health.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec3 place(const State& state, Index node) {
  return {state.x[at(node)], state.y[at(node)], state.z[at(node)]};
}

// A node that a taut thread draws to a ring in its element.
struct AtRing {
  Index node = -1, joint = -1;
  double share =
      1;  // of the stretch of the element: how far the node is from where the thread meets the ring
};

// The nearest one that is nearer than its element is stretched, on a way over the rim or at a thread's end,
// which cannot pass: its pull turns round within a small part of the element, which the stable step does not
// know.
AtRing nearest_to_ring(const Model& model, const State& state) {
  AtRing found;
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j) {
      const kernel::Joint& joint = model.joints[at(j)];
      const kernel::JointState& now = state.joints[at(j)];
      const Vec3 offset(now.offset[0], now.offset[1], now.offset[2]);
      const Vec3 center = 0.5 * (place(state, joint.host_a) + place(state, joint.host_b));
      const bool over_rim = offset.norm() > 0.999 * joint.opening;
      for (const Index end : {now.element, now.element + 1}) {
        const Index node = model.sliding_nodes[at(thread.node_begin + end)];
        const double share = (place(state, node) - center - offset).norm() * thread.stiffness / now.tension;
        if ((over_rim || end == 0 || end == thread.elements) && share < found.share) found = {node, j, share};
      }
    }
  }
  return found;
}

std::string likely_cause(const Preparation& preparation, const Phase& phase, const State& state) {
  char text[400];
  const Model& model = phase.model;
  const AtRing near = nearest_to_ring(model, state);
  if (near.joint < 0)
    std::snprintf(text, sizeof text,
                  "the time step %.3g s is too large for threads that turn slack and taut or for impacts "
                  "(stable step %.3g s); take half of it, or more damping",
                  phase.plan.dt, phase.bound.step);
  else
    std::snprintf(
        text, sizeof text,
        "%s is drawn to ring '%s', nearer than its element is stretched: its pull turns round within "
        "the time step %.3g s (stable step %.3g s); give it a mass, or take a far smaller step",
        node_label(preparation.assembly, near.node).c_str(),
        preparation.assembly.rings[at(model.joints[at(near.joint)].ring)].name.c_str(), phase.plan.dt,
        phase.bound.step);
  return text;
}

}  // namespace

Fastest fastest_node(const State& state) {
  Index fastest = 0;
  double greatest = -1;
  for (std::size_t i = 0; i < state.vx.size() && greatest < HUGE_VAL; ++i) {
    const double x = state.vx[i], y = state.vy[i], z = state.vz[i], squared = x * x + y * y + z * z;
    if (!(squared <= greatest)) fastest = static_cast<Index>(i), greatest = squared;
  }
  const std::size_t i = at(fastest);
  return {fastest, state.vx.empty() ? 0 : std::hypot(state.vx[i], state.vy[i], state.vz[i])};
}

void check_energy(const Preparation& preparation, const Phase& phase, const State& state, double residual,
                  double scale, double limit) {
  if (std::abs(residual) <= limit * scale + least_energy) return;  // not so for what is no number
  const Fastest fastest = fastest_node(state);
  const auto i = at(fastest.node);
  char text[1000];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %.3g J have %s, %.3g times what the scene began with and what was put in "
      "(time.residual_limit = %.3g); fastest: %s at (%.6g, %.6g, %.6g) m with %.3g m/s; likely "
      "cause: %s",
      preparation.timeline.time_of(state.step), std::abs(residual),
      residual < 0 ? "come from nowhere" : "been lost", scale > 0 ? std::abs(residual) / scale : HUGE_VAL,
      limit, node_label(preparation.assembly, fastest.node).c_str(), state.x[i], state.y[i], state.z[i],
      fastest.speed, likely_cause(preparation, phase, state).c_str());
  throw NumericalError(text);
}

bool speeds_allowed(const State& state, double speed_limit) {
  const double limit = speed_limit * speed_limit;
  bool allowed = true;
  for (std::size_t i = 0; i < state.vx.size(); ++i) {
    const double x = state.vx[i], y = state.vy[i], z = state.vz[i];
    allowed &= x * x + y * y + z * z <= limit;  // false for what is not a number, too
  }
  return allowed;
}

void report_runaway(const Preparation& preparation, const Phase& phase, const State& state,
                    double speed_limit) {
  const double time = preparation.timeline.time_of(state.step);
  const auto [worst, fastest] = fastest_node(state);
  char text[600];
  std::snprintf(text, sizeof text,
                "error: at t = %.9g s %s at (%.6g, %.6g, %.6g) m moves at %.3g m/s (time.speed_limit_m_s = "
                "%.3g); likely "
                "cause: the time step %.3g s is too large (stable step %.3g s, limited by %s)",
                time, node_label(preparation.assembly, worst).c_str(), state.x[at(worst)], state.y[at(worst)],
                state.z[at(worst)], fastest, speed_limit, phase.plan.dt, phase.bound.step,
                phase.limited_by.c_str());
  throw NumericalError(text);
}

}  // namespace cinch
