#include "plan/sliding_joints.hpp"

#include <algorithm>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void SlidingJoints::add_thread(const Model& model, std::size_t number, bool booked) {
  kernel::SlidingThread thread = model.sliding_threads[number];
  const auto nodes = model.sliding_nodes.begin() + thread.node_begin;
  const Index first = thread.joint_begin, last = thread.joint_end;
  thread.node_begin = static_cast<Index>(nodes_.size());
  thread.joint_begin = static_cast<Index>(joints_.size());
  thread.joint_end = thread.joint_begin + last - first;
  thread.booked = booked;
  nodes_.insert(nodes_.end(), nodes, nodes + thread.elements + 1);
  joints_.insert(joints_.end(), model.joints.begin() + first, model.joints.begin() + last);
  for (Index j = first; j < last; ++j) number_.push_back(j);
  threads_.push_back(thread);
}

void SlidingJoints::make_room(const Model& model) {
  states_.resize(joints_.size());
  tallies_.assign(model.rings.size(), nullptr);
  scratch_.resize(joints_.size() * at(kernel::sliding_scratch));
  on_threads_.resize(4 * joints_.size());
  on_hosts_.resize(6 * joints_.size());
}

void SlidingJoints::take_all(const Model& model) {
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) add_thread(model, t, true);
  books_ring_.assign(model.rings.size(), true);
  make_room(model);
}

void SlidingJoints::take_share(const Model& model, const std::function<bool(Index)>& own) {
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    const auto nodes = model.sliding_nodes.begin() + thread.node_begin;
    bool here = std::any_of(nodes, nodes + thread.elements + 1, own);
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      here = here || own(model.joints[at(j)].host_a) || own(model.joints[at(j)].host_b);
    if (here) add_thread(model, t, own(*nodes));
  }
  books_ring_.assign(model.rings.size(), false);
  for (std::size_t r = 0; r < model.rings.size(); ++r) books_ring_[r] = own(model.rings[r].a);
  make_room(model);
}

std::vector<Index> SlidingJoints::nodes_needed() const {
  std::vector<Index> nodes = nodes_;
  for (const kernel::Joint& joint : joints_) nodes.insert(nodes.end(), {joint.host_a, joint.host_b});
  return nodes;
}

void SlidingJoints::renumber(const std::function<Index(Index)>& local) {
  for (Index& node : nodes_) node = local(node);
  for (kernel::Joint& joint : joints_) joint.host_a = local(joint.host_a), joint.host_b = local(joint.host_b);
}

void SlidingJoints::take(State& state) {
  for (std::size_t j = 0; j < number_.size(); ++j) states_[j] = state.joints[at(number_[j])];
  for (const kernel::Joint& joint : joints_)
    tallies_[at(joint.ring)] = books_ring_[at(joint.ring)] ? &state.rings[at(joint.ring)] : nullptr;
}

void SlidingJoints::give(State& state) const {
  for (const kernel::SlidingThread& thread : threads_)
    for (Index j = thread.joint_begin; thread.booked && j < thread.joint_end; ++j)
      state.joints[at(number_[at(j)])] = states_[at(j)];
}

void SlidingJoints::tell(State& state) const {
  for (const kernel::SlidingThread& thread : threads_)
    for (Index j = thread.joint_begin; thread.booked && j < thread.joint_end; ++j) {
      kernel::JointState& to = state.joints[at(number_[at(j)])];
      const kernel::JointState& from = states_[at(j)];
      to.length = from.length, to.tension = from.tension, to.energy = from.energy, to.along = from.along,
      to.due = from.due;
    }
}

void SlidingJoints::evaluate(const NodeView& n, const StepPlan& plan, double time, double booked_dt) {
  const kernel::ContactArguments contact{n.x,     n.y, n.z,  n.vx,      n.vy,   n.vz,
                                         n.share, 0,   time, booked_dt, plan.dt};
  counts_ =
      kernels_->sliding_joints({contact, nodes_.data(), threads_.data(), static_cast<Index>(threads_.size()),
                                joints_.data(), states_.data(), tallies_.data(), scratch_.data()},
                               on_threads_.data(), on_hosts_.data());
}

}  // namespace cinch
