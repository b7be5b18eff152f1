// The one integer type of the store and the kernels.
#pragma once

namespace cinch {
using Index = int;  ///< node, element, ring or candidate number; 2^31 nodes exceed any machine we target
}  // namespace cinch
