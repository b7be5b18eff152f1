#include "store/saved_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "store/fields.hpp"

namespace cinch {
namespace {

constexpr std::int64_t endless = std::numeric_limits<std::int64_t>::max();

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
  archive.column("joints/length", joints, &Joint::length);
  archive.column("joints/tension", joints, &Joint::tension);
  archive.column("joints/energy", joints, &Joint::energy);
  archive.column("joints/along", joints, &Joint::along);
  archive.column("joints/due", joints, &Joint::due);
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
  archive.whole("state/step", state.step, 0, endless);
  transfer_nodes(archive, state);
  archive.values("state/dissipated", std::span(state.dissipated));
  if (!state.rings.empty()) transfer_rings(archive, state.rings, least, model.elements);
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    transfer_ball(archive, "targets/" + std::to_string(b), state.balls[b], least, model.elements);
  if (!state.joints.empty()) transfer_joints(archive, state.joints, model);
  require_order(archive, state, model);
  if (!state.reactions.empty()) transfer_reactions(archive, state.reactions);
}

}  // namespace cinch
