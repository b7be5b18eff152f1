// The force reduction: who computes and who adds which force to which node, in an order that the scene alone
// decides.
//
// Elements write their force once; nodes gather what belongs to them in the pass that moves them. No two
// threads write one node, nothing is atomic, and a node's sum has the same order (its runs in order, then
// links, then contact loads) for any number of threads: so are the bits.
//
// Nodes go block by block in ascending order: the elements whose lower end lies in the block write their
// forces, then the block's nodes move. Every element is computed before one of its nodes moves, as its other
// end lies further on. So a force need not outlive the way to its upper end, and the buffer stays in the
// second-level cache; most forces of a chain, which its pass may keep in registers, are never written at all.
// Each run has a stretch of the buffer as long as a block, with room before it for the last forces of the
// block before (a ring as long as that way where the two ends lie far apart; a shorter run just room for its
// forces).
#pragma once
#include <vector>

#include "kernels/arguments.hpp"
#include "store/numbering.hpp"

namespace cinch {

/// What belongs to a block of nodes, as stretches of the lists below.
struct Block {
  Index patch_begin, patch_end;
  Index span_begin, neighbour_begin, span_end;  ///< last come those that join neighbours, ascending
  Index link_begin, link_end;
  Index stretch_begin, chain_stretch_end, stretch_end;  ///< first come those that such a span names
  Index kick_begin, kick_end;
  Index constraint_begin, constraint_end;
};

struct ForceReduction {
  std::vector<Index> edges;  ///< block + 1: its first node, whole groups
  std::vector<Block> blocks;
  std::vector<kernel::Patch> patches;
  std::vector<kernel::Span> spans;
  std::vector<kernel::Link> links;  ///< parameters left open
  std::vector<kernel::Stretch> stretches;
  std::vector<kernel::Kick> kicks;
  Index force_count = 0;  ///< length of the force buffer; what is not written stays zero
};

/// A run goes in whole groups: the first node of its first one, and how many.
inline Index first_group_node(const Run& run) { return run.a / kernel::lanes * kernel::lanes; }
inline Index group_count(const Run& run) {
  return (run.a + run.count - first_group_node(run) + kernel::lanes - 1) / kernel::lanes;
}

/// Cuts the nodes of `numbering` into blocks of about `block_size` and lays out what each computes and
/// gathers. The groups of a span find their parameters in the order of the runs, group by group.
/// `constraints` are in local numbers, ascending.
ForceReduction reduce_forces(const Topology& topology, const Numbering& numbering,
                             const std::vector<kernel::Constraint>& constraints,
                             Index block_size = kernel::block_size);

}  // namespace cinch
