// The sliding joints that one thread evaluates: those of threads of which it has a node, or that pass through
// a ring of whose host it has one.
#pragma once
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "kernels/kernel_table.hpp"
#include "plan/near_contacts.hpp"
#include "store/state.hpp"

namespace cinch {

class SlidingJoints {
 public:
  /// All joints of the scene, in the user's numbers.
  void take_all(const Model& model);
  /// Those that put a force on a node for which `own` holds.
  void take_share(const Model& model, const std::function<bool(Index)>& own);
  /// All nodes that they need, in the user's numbers.
  std::vector<Index> nodes_needed() const;
  /// From users' numbers to those of a piece.
  void renumber(const std::function<Index(Index)>& local);

  bool empty() const { return threads_.empty(); }
  /// Begins with the joints as they stand in `state`, which books their rings until the next call, and with
  /// the forces that hold there. `nodes`: of the piece.
  void take(State& state, std::size_t nodes);
  /// Hands back the joints that are booked here, and their forces.
  void give(State& state) const;
  /// Hands back what they feel, but not how they moved: after an evaluation that was but a look. Others may
  /// still be taking the same joints from the state: to be called when all threads have.
  void tell(State& state) const;

  /// Evaluates the forces that are to hold from `step` on, and books until they are evaluated again.
  void evaluate(const NodeView& nodes, const StepPlan& plan, std::int64_t step);
  /// Evaluates those of the nodes as they stand; books nothing, and no node passes a ring.
  void glance(const NodeView& nodes, const StepPlan& plan, std::int64_t step);
  /// What rings push their hosts' ends apart with, at each step. `motion` (m) as of NearContacts: by which two
  /// nodes can have come closer; it grows from take() on.
  void push(const NodeView& nodes, const StepPlan& plan, double motion);
  /// What nodes of threads take beside the force of straight elements; forces of the rings on their hosts.
  std::span<const kernel::Load> on_threads() const { return {on_threads_.data(), count(total().threads)}; }
  std::span<const kernel::Load> on_hosts() const { return {on_hosts_.data(), count(total().hosts)}; }
  /// Both together by node, along one axis, N: they stand until they are evaluated again.
  const double* standing(std::size_t axis) const { return standing_[axis].data(); }
  std::span<const kernel::Load> pushing() const { return {pushing_.data(), count(pushes_)}; }
  std::size_t memory() const;  ///< bytes, see memory.hpp

 private:
  /// Where a state keeps the loads of a thread that hold.
  struct Held {
    kernel::Load *on_threads, *on_hosts;
    kernel::SlidingLoads& count;
  };
  Held held_of(State& state, std::size_t thread) const;
  void add_thread(const Model& model, std::size_t thread, bool booked);
  kernel::SlidingArguments arguments(const NodeView& nodes, const StepPlan& plan, double time,
                                     double booked_dt, double ahead, double since);
  void make_room(const Model& model);
  void clear_standing();
  void add_standing();
  kernel::SlidingLoads total() const { return ends_.empty() ? kernel::SlidingLoads{0, 0} : ends_.back(); }
  static std::size_t count(Index n) { return static_cast<std::size_t>(n); }

  const KernelTable* kernels_ = &kernels();
  std::vector<kernel::SlidingThread> threads_;
  std::vector<Index> nodes_;
  std::vector<double> mobility_;  ///< of those nodes, 1/kg
  std::vector<kernel::Joint> joints_;
  std::vector<Index> number_;                        ///< joint: its number in the scene
  std::vector<Index> scene_thread_;                  ///< thread: its number in the scene
  std::unordered_map<Index, Index> users_, locals_;  ///< node, where a piece has numbers of its own
  std::vector<bool> books_ring_;                     ///< ring
  std::vector<kernel::JointState> states_;
  std::vector<kernel::RingTally*> tallies_;  ///< ring
  AlignedVector<double> scratch_;
  std::vector<kernel::Load> on_threads_, on_hosts_, pushing_;  ///< room for all
  AlignedVector<double> standing_[3];                          ///< node
  Index pushes_ = 0;
  double long_until_ = 0;  ///< motion up to which no host is short
  std::vector<kernel::SlidingLoads> ends_;  ///< thread: behind its loads
};

}  // namespace cinch
