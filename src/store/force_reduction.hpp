// The force reduction: who adds which force to which node, in an order that the model alone decides.
//
// Elements write their force once; each node gathers what belongs to it. No two threads write one node,
// nothing is atomic, and the sum's order (runs in order, first ends before second ends, then contact loads)
// is the same for any number of threads: so are the bits.
#pragma once
#include <vector>

#include "kernels/arguments.hpp"

namespace cinch {

/// What each node adds up: every node lies in one stretch, stretches and their sources rise without gaps.
struct ElementGather {
  std::vector<kernel::GatherStretch> stretches;
  std::vector<kernel::GatherSource> sources;
};

/// Cuts the nodes into blocks and lists, block by block, the stretches of nodes and what they gather.
/// `constraints` must be in ascending node order.
void cut_node_blocks(Index nodes, const std::vector<kernel::Span>& runs,
                     const std::vector<kernel::Constraint>& constraints,
                     std::vector<kernel::NodeBlock>& blocks, ElementGather& gather);

/// The contact loads of each node block, by node and then by slot.
struct LoadGather {
  std::vector<kernel::LoadEntry> entries;
  std::vector<Index> begin;  ///< node block + 1

  /// node_of_slot[slot] is the node that takes the slot's load.
  void rebuild(const std::vector<Index>& node_of_slot, Index node_blocks);
};

}  // namespace cinch
