// The net's mouth: how far it has closed, and whether a target is inside.
#pragma once
#include <vector>

#include "base/bytes.hpp"
#include "scene/assembly.hpp"

namespace cinch {

/// Area of the convex hull of the ring centres on their best-fit plane, m^2 (0 for fewer than three).
double mouth_area(const std::vector<Vec3>& ring_centers);

/// Greatest distance between two ring centres, m.
double mouth_spread(const std::vector<Vec3>& ring_centers);

/// The closed surface made of a net and a lid over its edge (a fan from the edge's centroid).
class NetSurface {
 public:
  NetSurface(const Net& net, Index first_node);
  /// True when the winding number of the surface about `point` is not zero.
  bool encloses(const std::vector<Vec3>& positions, const Vec3& point) const;
  std::size_t memory() const { return bytes_of(triangles_, edge_); }

 private:
  std::vector<std::array<Index, 3>> triangles_;  ///< of the net
  std::vector<Index> edge_;  ///< its outer nodes, counter-clockwise seen from the net's normal
};

}  // namespace cinch
