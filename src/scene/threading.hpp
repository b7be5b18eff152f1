// Which threads slide through which rings, and where they do at first.
#pragma once
#include <map>

#include "scene/assembly.hpp"

namespace cinch {

/// The parts that a closing thread is laid along, as one chain of nodes.
struct Carrier {
  std::vector<Index> nodes;
  std::vector<double> reach;  ///< unstretched distance from the first node, m

  /// The reach of the middle of the element between two nodes, m; -1 where it is not on the carrier.
  double middle_of(Index a, Index b) const;
};

/// How a closing thread lies on its carrier.
struct LaidAlong {
  Carrier carrier;
  double overhang, length;  ///< before the carrier; of the whole thread as laid, m
};

/// Finds the threads of all rings with sliding joints, which then have contact with none. A closing thread
/// goes through the rings on what it is laid along; any other through those whose plane it crosses inside the
/// opening. A ring with an automatic joint slides where all threads that it names, or one of all, pass
/// through it once and with room. `carriers`: by the closing thread's part. Throws CaseError for a ring
/// without thread, with a thread that it cannot hold or that passes more than once.
void thread_rings(const Scene& scene, const std::map<Index, LaidAlong>& carriers, Assembly& assembly);

}  // namespace cinch
