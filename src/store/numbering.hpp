// The nodes that one thread works on and their own, dense numbers: all nodes, or those that it moves and the
// ghosts that their elements need.
//
// A node's local number and its user's number have the same rest to kernel::lanes, so that vectors take the
// same nodes together wherever a scene is cut. Numbers left out for that are no node (global -1, never
// moved).
#pragma once
#include <vector>

#include "base/bytes.hpp"
#include "store/topology.hpp"

namespace cinch {

struct Numbering {
  std::vector<Index> global;         ///< local -> user's number; ascending where there is a node
  std::vector<unsigned char> layer;  ///< local: 0 own; ghosts: elements between it and the nearest own node
  int depth = 1;  ///< layers of ghosts: own nodes stay right for as many steps between two exchanges

  Index nodes() const { return static_cast<Index>(global.size()); }
  bool own(Index local) const { return layer[static_cast<std::size_t>(local)] == 0; }
  /// Ghosts of the outermost layer stand still between two exchanges.
  bool moved(Index local) const { return layer[static_cast<std::size_t>(local)] < depth; }
  bool ghost(Index local) const { return !own(local) && global[static_cast<std::size_t>(local)] >= 0; }
  /// Local number of a node, -1 where it is not here.
  Index local(Index global_node) const;
  Index ghosts() const;  ///< how many
  std::size_t memory() const { return bytes_of(global, layer, ranges_); }

  /// All nodes, each with its own number.
  static Numbering all(Index nodes);
  /// The given nodes (ascending) and the ghosts that the elements of `topology` (in user's numbers) bring.
  static Numbering of(const std::vector<Index>& own, const Topology& topology, Index nodes, int depth);

 private:
  struct Range {  // user's [global, global + count) are local [local, ...)
    Index global, local, count;
  };
  std::vector<Range> ranges_;
  void append(Index global_node, unsigned char of_layer);
};

/// The runs and links of `whole` that move something here, in local numbers; runs keep their origin, and what
/// was a run stays one, however short: sums keep their order.
Topology local_topology(const Topology& whole, const Numbering& numbering);

}  // namespace cinch
