#include "store/saved_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "store/fields.hpp"

namespace cinch {
namespace {

constexpr std::int64_t most_steps = 1'000'000'000'000'000;  // a thousand times what a case may ask for

void transfer_nodes(Archive& archive, State& state) {
  for (const NodeField& field : node_fields) {
    const std::string name = std::string("state/") + field.name;
    AlignedVector<double>& values = state.*field.values;
    archive.values(name, std::span(values));
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
      archive.refuse(name, "holds what is no finite number");
  }
}

// `least`: of the items that are named in messages, see sphere_label.
void transfer_rings(Archive& archive, std::vector<kernel::RingTally>& rings, std::int64_t least,
                    std::int64_t elements) {
  using Tally = kernel::RingTally;
  archive.column("rings/force", rings, &Tally::force);
  archive.column("rings/potential", rings, &Tally::potential);
  archive.column("rings/dissipated", rings, &Tally::dissipated);
  archive.column("rings/couple_work", rings, &Tally::couple_work);
  archive.column("rings/couple_impulse", rings, &Tally::couple_impulse);
  archive.column("rings/peak_force", rings, &Tally::peak_force);
  archive.column("rings/peak_time", rings, &Tally::peak_time);
  archive.column("rings/first_time", rings, &Tally::first_time);
  archive.column("rings/first_peak", rings, &Tally::first_peak);
  archive.column("rings/max_penetration", rings, &Tally::max_penetration);
  archive.column("rings/stiffest", rings, &Tally::stiffest);
  archive.column("rings/stiffest_time", rings, &Tally::stiffest_time);
  archive.column("rings/stiffest_element", rings, &Tally::stiffest_element, least, elements - 1);
  archive.column("rings/state", rings, &Tally::state, 0, 2);
}

void transfer_ball(Archive& archive, const std::string& name, std::vector<kernel::BallTally>& pairs,
                   std::int64_t least, std::int64_t elements) {
  using Tally = kernel::BallTally;
  pairs.resize(archive.length(name + "/potential", pairs.size()));
  archive.column(name + "/potential", pairs, &Tally::potential);
  archive.column(name + "/dissipated", pairs, &Tally::dissipated);
  archive.column(name + "/impulse", pairs, &Tally::impulse);
  archive.column(name + "/moment", pairs, &Tally::moment);
  archive.column(name + "/max_penetration", pairs, &Tally::max_penetration);
  archive.column(name + "/first_time", pairs, &Tally::first_time);
  archive.column(name + "/stiffest", pairs, &Tally::stiffest);
  archive.column(name + "/stiffest_time", pairs, &Tally::stiffest_time);
  archive.column(name + "/stiffest_element", pairs, &Tally::stiffest_element, least, elements - 1);
}

void transfer_joints(Archive& archive, std::vector<kernel::JointState>& joints, const Model& model) {
  using Joint = kernel::JointState;
  const std::int64_t last = std::max(model.elements - 1, 0);
  archive.column("joints/element", joints, &Joint::element, 0, last);
  archive.column("joints/passes", joints, &Joint::passes, 0, std::numeric_limits<Index>::max());
  archive.column("joints/offset", joints, &Joint::offset);
  archive.column("joints/dissipated", joints, &Joint::dissipated);
  archive.column("joints/damped", joints, &Joint::damped, 0, last);
  archive.column("joints/rings", joints, &Joint::rings, 0, static_cast<std::int64_t>(joints.size()));
  archive.column("joints/damper", joints, &Joint::damper);
  archive.column("joints/straight_damper", joints, &Joint::straight_damper);
  archive.column("joints/last_length", joints, &Joint::last_length);
  archive.column("joints/last_straight", joints, &Joint::last_straight);
  archive.column("joints/length", joints, &Joint::length);
  archive.column("joints/tension", joints, &Joint::tension);
  archive.column("joints/energy", joints, &Joint::energy);
  archive.column("joints/along", joints, &Joint::along);
  archive.column("joints/due", joints, &Joint::due);
}

// Loads of a thread lie on its nodes, or on those of its rings' hosts.
void require_nodes(const Archive& archive, HeldLoads& held, const Model& model,
                   const kernel::SlidingThread& thread, kernel::SlidingLoads count) {
  const auto nodes = model.sliding_nodes.begin() + thread.node_begin;
  std::vector<Index> own(nodes, nodes + thread.elements + 1), hosts;
  for (Index j = thread.joint_begin; j < thread.joint_end; ++j) {
    const kernel::Joint& joint = model.joints[static_cast<std::size_t>(j)];
    hosts.insert(hosts.end(), {joint.host_a, joint.host_b});
  }
  const auto all_on = [](const kernel::Load* first, Index n, const std::vector<Index>& allowed) {
    return std::all_of(first, first + n, [&](const kernel::Load& load) {
      return std::find(allowed.begin(), allowed.end(), load.node) != allowed.end();
    });
  };
  if (!all_on(held.on_threads(thread.joint_begin), count.threads, own) ||
      !all_on(held.on_hosts(thread.joint_begin, thread.joint_end), count.hosts, hosts))
    archive.refuse("joints/held_node", "names a node that has no such force");
}

void transfer_held(Archive& archive, HeldLoads& held, const Model& model) {
  using Load = kernel::Load;
  archive.column("joints/held_node", held.loads, &Load::node, 0, model.nodes - 1);
  archive.column("joints/held_x", held.loads, &Load::x);
  archive.column("joints/held_y", held.loads, &Load::y);
  archive.column("joints/held_z", held.loads, &Load::z);
  for (std::size_t t = 0; t < held.count.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    const Index joints = thread.joint_end - thread.joint_begin;
    const std::string name = "joints/held_count/" + std::to_string(t);
    archive.whole(name + "/threads", held.count[t].threads, 0, joints * kernel::joint_thread_loads);
    archive.whole(name + "/hosts", held.count[t].hosts, 0,
                  joints * (kernel::joint_loads - kernel::joint_thread_loads));
    require_nodes(archive, held, model, thread, held.count[t]);
  }
}

// Each ring lies in an element of its thread, none before the one that it follows.
void require_order(const Archive& archive, const State& state, const Model& model) {
  for (const kernel::SlidingThread& thread : model.sliding_threads)
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j) {
      const auto here = static_cast<std::size_t>(j);
      const Index least = j > thread.joint_begin ? state.joints[here - 1].element : 0;
      if (state.joints[here].element < least || state.joints[here].element >= thread.elements)
        archive.refuse("joints/element", "is not in the order of the rings along their thread");
    }
}

void transfer_reactions(Archive& archive, std::vector<kernel::Reaction>& reactions) {
  archive.column("supports/impulse", reactions, &kernel::Reaction::impulse);
  archive.column("supports/moment", reactions, &kernel::Reaction::moment);
}

}  // namespace

void transfer(Archive& archive, State& state, const Model& model) {
  const std::int64_t least = kernel::sphere_label(model.nodes - 1);
  archive.whole("state/step", state.step, 0, most_steps);
  transfer_nodes(archive, state);
  archive.values("state/dissipated", std::span(state.dissipated));
  if (!state.rings.empty()) transfer_rings(archive, state.rings, least, model.elements);
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    transfer_ball(archive, "targets/" + std::to_string(b), state.balls[b], least, model.elements);
  if (!state.joints.empty()) {
    transfer_joints(archive, state.joints, model);
    transfer_held(archive, state.held, model);
  }
  require_order(archive, state, model);
  if (!state.reactions.empty()) transfer_reactions(archive, state.reactions);
}

}  // namespace cinch
