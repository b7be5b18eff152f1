#include "store/state.hpp"

#include <bit>

#include "base/fnv.hpp"
#include "store/fields.hpp"

namespace cinch {

HeldLoads::HeldLoads(const Model& model)
    : loads(model.joints.size() * kernel::joint_loads, kernel::Load{}),
      count(model.sliding_threads.size(), kernel::SlidingLoads{}) {}

State::State(const Model& model) : held(model) {
  for (const NodeField& field : node_fields)
    (this->*field.values).assign(static_cast<std::size_t>(model.nodes), 0.0);
  dissipated.assign(static_cast<std::size_t>(model.ledger_rows() * kernel::lanes), 0.0);
  kernel::RingTally untouched{};
  untouched.first_time = untouched.peak_time = -1;
  untouched.stiffest_element = -1;
  rings.assign(model.rings.size(), untouched);
  balls.resize(model.balls.size());
  for (const Index element : model.joint_element) {
    kernel::JointState joint{};
    joint.element = element;
    joints.push_back(joint);
  }
  reactions.assign(model.constraints.size(), kernel::Reaction{});
}

// A velocity that never was -0 never becomes it: sums of forces may differ in the sign of their zeros.
void drop_negative_zeros(State& state) {
  for (auto* field : {&state.vx, &state.vy, &state.vz})
    for (double& v : *field) v += 0.0;
}

State initial_state(const Model& model, const Assembly& assembly) {
  State state(model);
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.nodes); ++i) {
    const AssemblyNode& node = assembly.nodes[i];
    state.x[i] = node.position.x(), state.y[i] = node.position.y(), state.z[i] = node.position.z();
    state.vx[i] = node.velocity.x(), state.vy[i] = node.velocity.y(), state.vz[i] = node.velocity.z();
  }
  return state;
}

std::uint64_t state_hash(const State& state) {
  Fnv hash;
  hash.add(static_cast<std::uint64_t>(state.step));
  for (const NodeField& field : node_fields)
    for (const double value : state.*field.values) hash.add(std::bit_cast<std::uint64_t>(value));
  return hash.hash();
}

}  // namespace cinch
