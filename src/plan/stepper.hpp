// Moves a state through time: the one place that knows about threads.
// clang-format off
//
// Each thread has its piece of the scene. One step of a piece, in order:
//   contacts  those that are near, from places and speeds at the step's begin
//   block by block: element forces, then gather, kick and drift of the block's nodes
//   forces of contacts on their nodes, supports
//   post      what other pieces have as ghosts, and the greatest speed
//   meet      wait for their posts; every thread decides alike: go on, or leave the parallel region because the list
//             of pairs may be used up or a speed is out of bounds
// Steps in which no element pulls and nothing touches are done at once (free_flight.hpp).
// Without contacts a piece may do several steps between two meetings. What two pieces both need is computed by both,
// in the same order as on one thread, so the bits do not depend on the threads.
// clang-format on
#pragma once
#include <cstdint>

#include "plan/contact_list.hpp"
#include "plan/exchange.hpp"
#include "plan/free_flight.hpp"
#include "plan/jumps.hpp"

namespace cinch {

class Stepper {
 public:
  /// `model` must outlive the stepper; `node_share` as stable_step.hpp makes it.
  Stepper(const Model& model, const StepPlan& plan, std::vector<double> node_share, int threads);

  /// Advances by `steps` steps. In scenes with contacts it stops early when a speed is above the limit: see
  /// healthy().
  void advance(State& state, std::int64_t steps);

  /// Goes on with so many threads, to the same bits.
  void use_threads(int threads, State& state);
  /// Threads keep to cores from now on, where that can be: see core_binding.hpp.
  void bind_threads() { bind_ = true; }
  bool binds_threads() const { return bind_; }

  /// To be called when the state was set back to that of an earlier step.
  void start_over();

  /// Saves what `state` alone does not tell of how it goes on, to the last bit; or restores it, to be called
  /// before the first step, with a restored `state`.
  void transfer(Archive& archive, State& state);

  /// Computes the forces of the state as it stands; moves and books nothing, but rings and balls tell the
  /// force that they feel now.
  void glance(State& state, Glance& out);

  /// False once a node's speed was above the limit, or the step too long for a contact: see jump().
  bool healthy() const { return healthy_; }
  const std::optional<Jump>& jump() const { return jump_; }
  /// Seconds of each stage so far; steps are shared out as sampled ones are.
  StageSeconds seconds() const;

  const Model& model() const { return *model_; }
  const StepPlan& plan() const { return plan_; }
  const ContactList& contacts() const { return contacts_; }
  int threads() const { return threads_; }
  std::int64_t flown() const { return flown_; }  ///< steps that were done without forces, see free_flight.hpp
  std::size_t memory_of_pieces() const;          ///< bytes, see memory.hpp

 private:
  enum class Verdict { go_on, renew_contacts, look_closer, unhealthy };
  struct Progress {
    std::int64_t done, windows;  ///< steps of this run; stretches between two meetings since the beginning
    double motion;               ///< m, of the margin, since the list of pairs was made
    Verdict verdict;
  };

  template <class Visit>
  void each_by_its_thread(Visit visit) const;
  void make_whole_piece();
  void share_out(State& state);
  void make_pieces(const std::vector<std::vector<Index>>& shares);
  int sweep_depth(const std::vector<std::vector<Index>>& shares) const;
  void renew_contacts(State& state);
  void hand_out_contacts(State& state);
  void hand_out_dampers();
  bool gather_dampers();
  void transfer_dampers(Archive& archive);
  void look_closer(const State& state);
  double approach(double greatest) const;
  void judge(double greatest, Progress& progress) const;
  double asleep_until() const;
  bool fly(State& state, std::int64_t most, Progress& progress);
  Progress run(State& state, std::int64_t steps);
  Progress run_threads(State& state, std::int64_t steps, const Progress& from);
  Progress run_thread(State& state, std::int64_t steps, int thread, Progress from);

  const Model* model_;
  StepPlan plan_;
  int threads_;
  bool bind_ = false;
  std::vector<double> node_share_;
  ContactList contacts_;
  std::vector<std::unique_ptr<Piece>> pieces_;  ///< thread; of several threads made at the first advance
  std::vector<int> owner_;                      ///< node: its piece (several threads)
  Exchange exchange_;                           ///< (several threads)
  double motion_ = 0;
  AlignedVector<double> dampers_;  ///< element: restored, and not yet handed to the pieces
  bool contacts_valid_ = false, healthy_ = true;
  std::optional<Jump> jump_;
  std::optional<FreeFlight> flight_;  ///< where nodes may fly freely
  std::int64_t flown_ = 0;
  std::int64_t windows_ = 0;
  StageSeconds sampled_{};            ///< of the steps that were timed
  double stepping_ = 0, search_ = 0;  ///< s: all steps; broadphase
};

}  // namespace cinch
