// Cuts any graph of elements into runs: stretches whose end nodes rise by one, which load contiguously. What
// is too short for a run is a link.
#pragma once
#include <span>
#include <vector>

#include "base/index.hpp"
#include "base/large.hpp"

namespace cinch {

/// Slots [slot, slot + count): slot + k joins nodes a + k and a + k + offset, offset > 0. A slot may be void:
/// no element, so that one run bridges small gaps.
struct Run {
  Index slot, count, a, offset;
  Index origin;     ///< number of the run in the whole scene's topology
  bool neighbours;  ///< offset 1 there; a piece that lacks nodes may bring others to 1
};

/// A single element.
struct LinkEnds {
  Index a, b;  ///< a < b
  Index element;
};

struct Topology {
  std::vector<Run> runs;            ///< by offset, then by node; slots rise without gaps
  LargeVector<Index> slot_element;  ///< slot: the user's number of its element, -1 where void
  std::vector<LinkEnds> links;      ///< by first node
};

/// Every element lies in one run or is one link; its end a is the lower of its two nodes.
Topology cut_runs(std::span<const Index> end_a, std::span<const Index> end_b);

}  // namespace cinch
