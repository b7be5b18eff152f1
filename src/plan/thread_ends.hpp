// Threads that have been drawn to their end in a ring that slides on them. The joint keeps the end there, as
// a knot or a mass too large for the opening would; a free end would leave the ring, which is not computed.
#pragma once
#include <vector>

#include "plan/look.hpp"

namespace cinch {

struct DrawnEnd {
  Index joint;  ///< of the model
  Index node;   ///< the thread's first or last
};

/// Those ends that are at a ring in their element: nearer than its opening is wide, or through it by no more
/// than a quarter of the element, as what comes fast flies on before its thread draws it back. A thread that
/// bends back in the ring's plane has no side that tells: its end counts from that quarter on.
std::vector<DrawnEnd> drawn_ends(const Look& now);

}  // namespace cinch
