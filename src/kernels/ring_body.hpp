// A ring on an element is a body between its ends: they are held apart as by a spring that only pushes, once
// the host is a small part of its rest length. The host's tension is over by then. Shorter and shorter hosts
// would turn faster and faster, and in the end by any angle in a step.
#pragma once
#include "kernels/contact_item.hpp"

namespace cinch::CINCH_ISA {

/// A host whose ends may be too near, as they stand.
struct ShortHost {
  V3 along;       ///< from one end to the other, m
  double length;  ///< m
  double spare;   ///< by how much it is longer than it must be, m; negative: its ends are too near
};

inline ShortHost short_host(const kernel::ContactArguments& c, const kernel::Joint& joint) {
  const V3 along = at(c.x, c.y, c.z, joint.host_b) - at(c.x, c.y, c.z, joint.host_a);
  const double length = norm(along);
  return {along, length, length - joint.host_least};
}

}  // namespace cinch::CINCH_ISA
