// Cuts any graph of elements into runs: stretches whose end nodes rise by one, which load contiguously.
#pragma once
#include <array>
#include <vector>

#include "kernels/arguments.hpp"

namespace cinch {

struct Topology {
  std::vector<Index> user_element;  ///< store number -> user's number
  std::vector<kernel::Span>
      runs;  ///< element + k joins a + k and b + k; together they cover the elements in order
};

/// Runs in the order of the user's elements: each begins with the first element not yet taken and goes on as
/// long as an element (a + 1, b + 1) is there.
Topology cut_runs(const std::vector<std::array<Index, 2>>& elements, Index nodes);

/// Cuts runs into spans of at most `kernel::block_size` elements and groups them into blocks of at most that
/// many. The edges depend on the model alone, never on the number of threads.
void cut_element_blocks(const std::vector<kernel::Span>& runs, std::vector<kernel::Span>& spans,
                        std::vector<kernel::ElementBlock>& blocks);

}  // namespace cinch
