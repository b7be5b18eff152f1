// Which part of a block's work is whole groups of a chain, that one pass can compute and move.
#pragma once
#include <vector>

#include "kernels/arguments.hpp"

namespace cinch {

struct ChainRanges {
  std::vector<kernel::Span> spans;               ///< ascending; `stretch` counts in chain_stretches
  std::vector<kernel::Stretch> chain_stretches;  ///< each with the nodes of one of the spans
  std::vector<kernel::Stretch> stretches;        ///< all others
};

/// Cuts chains out of a block's stretches and those of its spans that join neighbours, of which none overlap.
/// Ascending, so that their sums in the ledger have one order wherever chains are cut.
ChainRanges cut_out_chains(const std::vector<kernel::Span>& neighbours,
                           const std::vector<kernel::Stretch>& stretches);

}  // namespace cinch
