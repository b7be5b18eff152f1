// The kernels of one instruction set as a table of function pointers, chosen once when the program starts.
#pragma once
#include "kernels/arguments.hpp"
#include "kernels/vec.hpp"

namespace cinch {

struct KernelTable {
  const char* isa;  ///< "base" (x86-64, or whatever the compiler targets), "v3", "v4"
  /// [damped][ledger]: forces of element blocks [begin, end).
  void (*axial_forces[2][2])(const kernel::AxialArguments&, const kernel::ElementBlock*, const kernel::Span*,
                             Index begin, Index end);
  /// Contacts of rings [begin, end) with their candidates.
  void (*ring_contacts)(const kernel::RingArguments&, Index begin, Index end);
  /// Contacts of candidates [begin, end) with one ball, booked in one tally.
  void (*ball_contacts)(const kernel::BallArguments&, Index begin, Index end, kernel::BallTally& tally);
  /// [gravity]: gathers forces on node blocks [begin, end) and moves them; watch[block] is written.
  void (*update_nodes[2])(const kernel::NodeArguments&, const kernel::NodeBlock*, Index begin, Index end,
                          kernel::Watch* watch);
};

/// The best table for this machine, or the one named by the environment variable CINCH_ISA ("base", "v3",
/// "v4").
const KernelTable& kernels();

namespace CINCH_ISA {
void fill_axial(KernelTable& table);
void fill_ring_contact(KernelTable& table);
void fill_ball_contact(KernelTable& table);
void fill_node_update(KernelTable& table);
}  // namespace CINCH_ISA

}  // namespace cinch
