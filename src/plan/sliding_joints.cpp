#include "plan/sliding_joints.hpp"

#include <algorithm>
#include <cmath>

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
  scene_thread_.push_back(static_cast<Index>(number));
  nodes_.insert(nodes_.end(), nodes, nodes + thread.elements + 1);
  for (auto node = nodes; node != nodes + thread.elements + 1; ++node)
    mobility_.push_back(mobility(model, *node));
  joints_.insert(joints_.end(), model.joints.begin() + first, model.joints.begin() + last);
  for (Index j = first; j < last; ++j) number_.push_back(j);
  threads_.push_back(thread);
}

void SlidingJoints::make_room(const Model& model) {
  states_.resize(joints_.size());
  tallies_.assign(model.rings.size(), nullptr);
  if (!joints_.empty())
    scratch_.resize(at(kernel::sliding_scratch) + joints_.size() * at(kernel::joint_scratch));
  on_threads_.resize(at(kernel::joint_thread_loads) * joints_.size());
  on_hosts_.resize(at(kernel::joint_loads - kernel::joint_thread_loads) * joints_.size());
  pushing_.resize(2 * joints_.size());
  ends_.assign(threads_.size(), {0, 0});
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
  for (const Index node : nodes_needed()) {
    locals_[node] = local(node);
    users_[local(node)] = node;
  }
  for (Index& node : nodes_) node = local(node);
  for (kernel::Joint& joint : joints_) joint.host_a = local(joint.host_a), joint.host_b = local(joint.host_b);
}

namespace {

// Copies loads and gives their nodes the numbers that they have there; returns behind the last.
kernel::Load* copy_loads(std::span<const kernel::Load> from, kernel::Load* to,
                         const std::unordered_map<Index, Index>& numbers) {
  for (const kernel::Load& load : from) {
    *to = load;
    if (!numbers.empty()) to->node = numbers.at(load.node);
    ++to;
  }
  return to;
}

}  // namespace

SlidingJoints::Held SlidingJoints::held_of(State& state, std::size_t t) const {
  const Index begin = number_[at(threads_[t].joint_begin)];
  const Index end = begin + threads_[t].joint_end - threads_[t].joint_begin;
  return {state.held.on_threads(begin), state.held.on_hosts(begin, end),
          state.held.count[at(scene_thread_[t])]};
}

void SlidingJoints::clear_standing() {
  for (const auto& loads : {on_threads(), on_hosts()})
    for (const kernel::Load& load : loads)
      standing_[0][at(load.node)] = standing_[1][at(load.node)] = standing_[2][at(load.node)] = 0;
}

// In the order of the threads of the scene, whatever piece adds: sums have the same bits in all.
void SlidingJoints::add_standing() {
  for (const auto& loads : {on_threads(), on_hosts()})
    for (const kernel::Load& load : loads) {
      standing_[0][at(load.node)] += load.x;
      standing_[1][at(load.node)] += load.y;
      standing_[2][at(load.node)] += load.z;
    }
}

void SlidingJoints::take(State& state, std::size_t nodes) {
  for (std::size_t j = 0; j < number_.size(); ++j) states_[j] = state.joints[at(number_[j])];
  for (const kernel::Joint& joint : joints_)
    tallies_[at(joint.ring)] = books_ring_[at(joint.ring)] ? &state.rings[at(joint.ring)] : nullptr;
  kernel::Load *to_threads = on_threads_.data(), *to_hosts = on_hosts_.data();
  for (std::size_t t = 0; t < threads_.size(); ++t) {
    const Held held = held_of(state, t);
    to_threads = copy_loads({held.on_threads, count(held.count.threads)}, to_threads, locals_);
    to_hosts = copy_loads({held.on_hosts, count(held.count.hosts)}, to_hosts, locals_);
    ends_[t] = {static_cast<Index>(to_threads - on_threads_.data()),
                static_cast<Index>(to_hosts - on_hosts_.data())};
  }
  for (auto& axis : standing_) axis.assign(nodes, 0.0);
  add_standing();
  long_until_ = -HUGE_VAL;
}

void SlidingJoints::give(State& state) const {
  for (std::size_t t = 0; t < threads_.size(); ++t) {
    const kernel::SlidingThread& thread = threads_[t];
    if (!thread.booked) continue;
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      state.joints[at(number_[at(j)])] = states_[at(j)];
    const kernel::SlidingLoads from = t == 0 ? kernel::SlidingLoads{0, 0} : ends_[t - 1];
    const Held held = held_of(state, t);
    held.count = {ends_[t].threads - from.threads, ends_[t].hosts - from.hosts};
    copy_loads({on_threads_.data() + from.threads, count(held.count.threads)}, held.on_threads, users_);
    copy_loads({on_hosts_.data() + from.hosts, count(held.count.hosts)}, held.on_hosts, users_);
  }
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

kernel::SlidingArguments SlidingJoints::arguments(const NodeView& n, const StepPlan& plan, double time,
                                                  double booked_dt, double ahead, double since) {
  return {{n.x, n.y, n.z, n.vx, n.vy, n.vz, n.share, 0, time, booked_dt, plan.joint_steps * plan.dt},
          ahead,
          since,
          nodes_.data(),
          mobility_.data(),
          threads_.data(),
          static_cast<Index>(threads_.size()),
          joints_.data(),
          states_.data(),
          tallies_.data(),
          ends_.data(),
          scratch_.data()};
}

void SlidingJoints::evaluate(const NodeView& nodes, const StepPlan& plan, std::int64_t step) {
  if (empty()) return;  // another thread has them all
  const double held = plan.joint_steps * plan.dt;
  clear_standing();
  kernels_->sliding_joints(
      arguments(nodes, plan, plan.timeline.time_of(step), held, 0.5 * (held - plan.dt), held),
      on_threads_.data(), on_hosts_.data());
  add_standing();
}

// The last evaluation took nodes where they were (m - 1) / 2 steps later.
void SlidingJoints::glance(const NodeView& nodes, const StepPlan& plan, std::int64_t step) {
  if (empty()) return;
  const int hold = plan.joints_hold(step), steps = hold > 0 ? hold : plan.joint_steps;
  const double since = (steps - 0.5 * (plan.joint_steps - 1)) * plan.dt;
  kernels_->sliding_joints(arguments(nodes, plan, plan.timeline.time_of(step), 0, 0, since),
                           on_threads_.data(), on_hosts_.data());
}

// Hosts that are long enough need not be looked at until motion could have made one short. Less a tenth, as
// places round off.
void SlidingJoints::push(const NodeView& nodes, const StepPlan& plan, double motion) {
  pushes_ = 0;
  if (motion < long_until_) return;
  double spare = 0;
  pushes_ = kernels_->push_hosts(arguments(nodes, plan, 0, 0, 0, 0), pushing_.data(), spare);
  long_until_ = motion + 0.9 * spare;
}

}  // namespace cinch
