// The kernels of one instruction set as a table of function pointers, chosen once when the program starts.
#pragma once
#include "kernels/arguments.hpp"
#include "kernels/vec.hpp"

namespace cinch {

/// Entries that take begin and end work on that stretch of the list before them.
struct KernelTable {
  const char* isa;  ///< "base" (x86-64, or whatever the compiler targets), "v3", "v4"
  /// [damped][what is booked]: element forces of spans. Without damping there is no power to book.
  void (*axial_spans[2][kernel::Book::sums])(const kernel::AxialArguments&, const kernel::Span*, Index begin,
                                             Index end);
  /// [damped][what is booked]: element forces of links.
  void (*axial_links[2][kernel::Book::sums])(const kernel::AxialArguments&, const kernel::Link*, Index begin,
                                             Index end);
  void (*patch_forces)(const kernel::AxialArguments&, const kernel::Patch*, Index begin, Index end);
  /// [gravity][kind]: gathers element forces and moves nodes; returns the greatest squared speed, if watched.
  double (*move_nodes[2][kernel::Moving::kinds])(const kernel::NodeArguments&, const kernel::Stretch*,
                                                 Index begin, Index end);
  /// [damped][power is booked][gravity][kind]: computes a span that names a stretch and moves its nodes, in
  /// one pass; returns what move_nodes does. Null in instruction sets where two passes are as fast.
  double (*update_chain[2][2][2][kernel::Moving::kinds])(const kernel::AxialArguments&,
                                                         const kernel::NodeArguments&, const kernel::Span&,
                                                         const kernel::Stretch&);
  /// Time, at most `enough`, for which all elements of these spans and links stay shorter than `part` of
  /// their rest lengths if no force acts on their nodes, s; 0 where one is not.
  double (*time_to_pull)(const kernel::AxialArguments&, const kernel::Span*, Index span_count,
                         const kernel::Link*, Index link_count, double part, double enough);
  /// [gravity]: moves the nodes [0, nodes) by many steps in which no force acts on them.
  void (*fly_freely[2])(const kernel::NodeArguments&, Index nodes, Index steps);
  /// Adds forces of links to nodes that have moved; returns the greatest squared speed among them.
  double (*kick_nodes)(const kernel::NodeArguments&, const kernel::Kick*, Index begin, Index end);
  /// Adds contact forces likewise; nodes with scale 0 are left alone.
  double (*load_nodes)(const kernel::NodeArguments&, const kernel::Load*, Index count);
  /// Notes where constrained nodes are, before anything moves.
  void (*hold_before)(const kernel::NodeArguments&, const kernel::Constraint*, Index begin, Index end,
                      kernel::Held*);
  /// Takes off what the supports do not allow and books it in `reactions` (constraint).
  void (*hold_after)(const kernel::NodeArguments&, const kernel::Constraint*, Index begin, Index end,
                     const kernel::Held*, kernel::Reaction* const* reactions);
  kernel::NodeEnergies (*node_energies)(const kernel::EnergyArguments&);
  /// Contacts of the pairs pairs[near[i]], i < count, in the order of their rings. Writes forces on nodes to
  /// `loads` (room for four a pair) and to sleep[i] the motion of ring_sleep.hpp, m (0 or less: touches).
  /// Returns the number of loads.
  Index (*ring_contacts)(const kernel::RingArguments&, const kernel::Pair* pairs, const Index* near,
                         Index count, double* sleep, kernel::Load* loads);
  /// The same for balls; two loads a pair, and to gap[i] the distance left to a contact, m (negative:
  /// penetration).
  Index (*ball_contacts)(const kernel::BallArguments&, const kernel::Pair* pairs, const Index* near,
                         Index count, double* gap, kernel::Load* loads);
  /// Rings that slide on threads: moves waypoints, lets nodes pass, writes what nodes of the threads take
  /// beside the force of straight elements and what the rings' hosts take (room for four each a joint). With
  /// contact.dt = 0 no node passes.
  void (*sliding_joints)(const kernel::SlidingArguments&, kernel::Load* on_threads, kernel::Load* on_hosts);
  /// What the rings' bodies push the ends of their hosts apart with (room for two a joint); returns how many.
  /// `spare`: by how much each host is longer than it must be, at least, m.
  Index (*push_hosts)(const kernel::SlidingArguments&, kernel::Load* loads, double& spare);
};

/// The best table for this machine, or the one named by the environment variable CINCH_ISA ("base", "v3",
/// "v4").
const KernelTable& kernels();

namespace CINCH_ISA {
void fill_axial(KernelTable& table);
void fill_ring_contact(KernelTable& table);
void fill_ball_contact(KernelTable& table);
void fill_sliding_joint(KernelTable& table);
void fill_ring_body(KernelTable& table);
void fill_node_update(KernelTable& table);
void fill_energy(KernelTable& table);
void fill_free_flight(KernelTable& table);
}  // namespace CINCH_ISA

}  // namespace cinch
