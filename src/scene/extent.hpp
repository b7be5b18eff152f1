// How many nodes and elements a scene will have, known before any of them is made.
#pragma once
#include <cstdint>

#include "scene/scene.hpp"

namespace cinch {

struct Extent {
  std::int64_t nodes = 0;  ///< at most: shared ones are counted with each part
  std::int64_t elements = 0;
  SourceRef largest;  ///< the part with most elements
};

Extent extent_of(const Scene& scene);

/// Throws CaseError for a scene of more elements than can be numbered, or that `memory` bytes cannot hold
/// while it starts.
void require_room(const Extent& extent, std::size_t memory);

}  // namespace cinch
