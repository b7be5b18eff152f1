#include "plan/closing.hpp"

#include <algorithm>

#include "store/fields.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void add_velocity(State& state, Index node, const Vec3& jump) {
  state.vx[at(node)] += jump.x();
  state.vy[at(node)] += jump.y();
  state.vz[at(node)] += jump.z();
}

// What has moved took its momentum along.
void keep_momentum(const Model& after, const Assembly& assembly, State& state) {
  for (const LaidThread& laid : assembly.laid) {
    if (laid.excess.empty()) continue;
    Vec3 momentum = Vec3::Zero();
    for (const Load& load : laid.excess)
      momentum += load.mass * Vec3(state.vx[at(load.node)], state.vy[at(load.node)], state.vz[at(load.node)]);
    const std::vector<Index> nodes = assembly.laid_nodes(laid);
    double mass = 0;
    for (const Index node : nodes) mass += after.mass[at(node)];
    for (const Index node : nodes) add_velocity(state, node, momentum / mass);
  }
}

// As they stood before. What dampers have taken is booked with all of the phase before; their last forces are
// as unknown as those of elements.
void keep_joint(const kernel::JointState& before, kernel::JointState& joint) {
  joint = before;
  joint.dissipated = joint.due = 0;
  joint.rings = 0;
  joint.last_length = joint.last_straight = -1;
}

// Threads that slide through rings already have the same joints in both models: no ring lies on a closing
// thread.
void keep_joints(const Model& model_before, const Model& model_after, const State& before, State& state) {
  for (std::size_t t = 0; t < model_before.sliding_threads.size(); ++t) {
    const auto& first = model_after.sliding_first;
    const auto same = std::find(first.begin(), first.end(), model_before.sliding_first[t]) - first.begin();
    const kernel::SlidingThread& from = model_before.sliding_threads[t];
    const Index to = model_after.sliding_threads[static_cast<std::size_t>(same)].joint_begin;
    for (Index j = from.joint_begin; j < from.joint_end; ++j)
      keep_joint(before.joints[at(j)], state.joints[at(to + j - from.joint_begin)]);
  }
}

}  // namespace

State lay_closing_threads(const Model& model_before, const Model& model_after, const Assembly& assembly,
                          const State& before) {
  State state(model_after);
  state.step = before.step;
  for (const NodeField& field : node_fields) {
    const auto& from = before.*field.values;
    auto& to = state.*field.values;
    std::copy(from.begin(), from.end(), to.begin());
    for (const Lay& lay : assembly.lays)
      to[at(lay.node)] = (1 - lay.s) * to[at(lay.a)] + lay.s * to[at(lay.b)];
  }
  for (const Lay& lay : assembly.lays) {
    state.x[at(lay.node)] += lay.offset.x();
    state.y[at(lay.node)] += lay.offset.y();
    state.z[at(lay.node)] += lay.offset.z();
  }
  keep_momentum(model_after, assembly, state);
  keep_joints(model_before, model_after, before, state);
  state.balls = before.balls;  // what targets and rings have felt so far goes on
  if (!before.rings.empty()) state.rings = before.rings;
  return state;
}

void separate(const Assembly& assembly, State& state) {
  for (const Lay& lay : assembly.lays) add_velocity(state, lay.node, lay.jump);
  for (const Recoil& recoil : assembly.recoils) add_velocity(state, recoil.node, recoil.jump);
}

void hold_supports(const Model& model, State& state) {
  for (const kernel::Constraint& c : model.constraints) {
    const Vec3 axis(c.ax, c.ay, c.az);
    const Vec3 v(state.vx[at(c.node)], state.vy[at(c.node)], state.vz[at(c.node)]);
    add_velocity(state, c.node, axis.dot(v) * axis - v);
  }
}

}  // namespace cinch
