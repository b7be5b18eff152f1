// One thread's share of a scene: the nodes that it moves, ghosts of the others' nodes that its elements and
// contacts need, and everything that a step of them takes. A scene on one thread is one piece without ghosts,
// which works on the state itself; else each piece has its own copy, which its own thread is the first to
// touch.
#pragma once
#include <type_traits>

#include "plan/glance.hpp"
#include "plan/near_contacts.hpp"
#include "plan/palette.hpp"
#include "plan/sliding_joints.hpp"
#include "plan/stage_clock.hpp"
#include "store/force_reduction.hpp"
#include "store/state.hpp"

namespace cinch {

class Piece {
 public:
  /// All nodes of the scene. `node_share` by node, see stable_step.hpp; empty in scenes without contacts.
  Piece(const Model& model, const StepPlan& plan, const std::vector<double>& node_share);
  /// The nodes `own` (ascending). `depth`: steps between two exchanges of ghosts.
  Piece(const Model& model, const StepPlan& plan, const std::vector<double>& node_share,
        const std::vector<Index>& own, int depth);
  Piece(const Piece&) = delete;
  Piece& operator=(const Piece&) = delete;

  const Numbering& numbering() const { return numbering_; }
  const ForceReduction& reduction() const { return reduction_; }
  const Topology& topology() const { return topology_; }
  /// Steps that it can do between two exchanges, all in one sweep over its blocks.
  int levels() const { return levels_; }

  /// Ghosts that only contacts need (user's numbers, ascending); they lie behind the numbered nodes.
  void set_contact_ghosts(std::vector<Index> nodes, const std::vector<double>& node_share);
  /// Local number of any node that is here; -1 where it is not.
  Index local(Index global_node) const;
  /// Local numbers of all ghosts and, in the same order, their users' numbers.
  std::vector<Index> ghost_places() const, ghosts() const;
  /// By local node: whether it does x += dt v between two exchanges, to the last bit, as all do on which
  /// nothing acts behind the pass that moves them but supports.
  std::vector<bool> moved_by_speed() const;

  NearContacts& contacts() { return contacts_; }
  void set_joints(SlidingJoints joints) { joints_ = std::move(joints); }
  const double* share() const { return share_.data(); }  ///< node_share by local node

  /// Works from now on with this state: on it (whole), or on copies of all local nodes.
  void take(State& state);
  /// Copies own nodes to the state.
  void give(State& state) const;
  /// x, y, z, vx, vy, vz (number 0 to 5) of the local nodes.
  double* field(std::size_t number) { return fields_[number]; }

  /// One step of a scene with contacts; returns the greatest squared speed of its own nodes. `motion`: see
  /// NearContacts.
  double step(std::int64_t number, double motion, StageClock& clock);
  /// `steps` <= levels() steps of a scene without contacts.
  void sweep(int steps, StageClock& clock);
  /// What one step from this state would add to the speeds of its own nodes; moves and books nothing. With
  /// several pieces `out` has its final size already.
  void glance(State& state, double motion, Glance& out);
  /// What the joints booked here felt then, into the state: when all pieces have glanced, as each takes from
  /// there what it shares with others.
  void tell_joints(State& state) const;
  /// Time, at most `enough`, for which none of its elements would pull if nothing else did, s; 0 where one
  /// does. They count as shorter than they are, by `spare` of their length.
  double time_to_pull(double spare, double enough) const;
  /// `steps` steps in which nothing pulls and nothing touches.
  void fly(Index steps);
  /// Appends the forces of contacts and joints on its own nodes as last evaluated, in the user's numbers.
  void append_loads(std::vector<kernel::Load>& loads) const;
  /// The dampers' forces of the last step by element, N: those booked here are put into `forces`. False where
  /// none are kept or there was no step.
  bool tell_dampers(AlignedVector<double>& forces) const;
  /// The dampers' forces of the last step by element, of all elements of the scene.
  void set_dampers(const AlignedVector<double>& forces);
  /// The next step books as a first one: see find_dampers.
  void forget_dampers() { knows_dampers_ = false; }
  std::size_t memory() const;  ///< bytes, see memory.hpp

 private:
  using MoveNodes = std::remove_all_extents_t<decltype(KernelTable::move_nodes)>;
  struct ElementKernels {
    std::remove_all_extents_t<decltype(KernelTable::axial_spans)> spans;
    std::remove_all_extents_t<decltype(KernelTable::axial_links)> links;
  };
  /// What a step calls.
  struct StepKernels {
    ElementKernels elements;
    std::remove_all_extents_t<decltype(KernelTable::update_chain)> update_chain;
    MoveNodes move_nodes;
  };

  template <class Visit>
  void for_each_element(Visit&& visit) const;
  void set_up(const Model& model, const std::vector<double>& node_share);
  void set_constraints(const Model& model);
  void set_parameters(const Model& model);
  void allocate(const Model& model, const std::vector<double>& node_share);
  void bind(State& state);
  void find_dampers();
  void make_own_ledger();
  void copy_rows(const AlignedVector<double>& from, AlignedVector<double>& to) const;
  NodeView view() const;
  void use_level(int level);
  ElementKernels element_kernels(kernel::Book::Sum book) const;
  void choose_kernels();
  void compute(const Block& block, Index span_end, const ElementKernels& elements);
  double update_neighbours(const Block& block);
  double move(const Block& block, Index stretch_begin, MoveNodes move_nodes);
  double compute_and_move(const Block& block, StageClock& clock);
  double load_nodes(std::span<const kernel::Load> loads);
  kernel::Book::Sum step_book() const;
  void lend(Glance& out);
  void append(std::span<const kernel::Load> list, std::vector<kernel::Load>& loads) const;
  void hold_before(Index begin, Index end);
  void hold_after(Index begin, Index end);

  const KernelTable& kernels_ = kernels();
  StepKernels step_{};
  StepPlan plan_;
  bool whole_;
  int levels_ = 1;
  std::size_t lag_ = 1;  ///< blocks that a step of a sweep stays behind the one before it
  Numbering numbering_;
  Topology topology_;
  std::vector<kernel::Constraint> constraints_;
  ForceReduction reduction_;
  std::vector<Index> contact_ghosts_;

  AlignedVector<double> own_fields_[6];  ///< of a piece that is not whole
  double* fields_[6] = {};
  AlignedVector<double> scale_, share_;  ///< node
  Palette palette_;                      ///< of the topology's groups
  AlignedVector<double> force_[3];       ///< level x force
  AlignedVector<double> damper_;         ///< group x lanes: the damper's force in the last step, N
  AlignedVector<double> link_damper_;    ///< link: the same
  bool knows_dampers_ = false;
  std::size_t ledger_size_ = 0;
  AlignedVector<double> ledger_;        ///< of a piece that is not whole, where it books: copy of the state's
  std::vector<Index> own_rows_;         ///< of it
  std::vector<kernel::Held> held_;      ///< constraint
  std::vector<Index> reaction_number_;  ///< constraint: its number in the model; -1: not booked here
  std::vector<kernel::Reaction*> reactions_;  ///< constraint
  kernel::Reaction unbooked_{};
  AlignedVector<double> glance_fields_[6];  ///< what a glance moves in place of the nodes
  kernel::AxialArguments axial_{};
  kernel::NodeArguments node_{};
  NearContacts contacts_;
  SlidingJoints joints_;
};

}  // namespace cinch
