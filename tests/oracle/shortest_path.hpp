// Shortest path through discs, found the slow and sure way: the reference for paths of threads through rings.
#pragma once
#include <vector>

#include "base/vec3.hpp"

namespace oracle {

/// A flat disc in space, rim included.
struct Disc {
  cinch::Vec3 center, normal;  ///< m; unit normal
  double radius;               ///< m
};

/// Shortest path from a to b: its length is that of a path through the waypoints, never less.
struct ShortestPath {
  double length;                       ///< m
  std::vector<cinch::Vec3> waypoints;  ///< m, one in each disc, in the discs' order
};

/// Shortest path from a through one point of each disc, in order, to b. The discs may intersect and the
/// waypoints may coincide; where several paths are equally short it is one of them. The length is right to
/// 1e-11 m, which a lower bound proves; throws std::runtime_error where the proof fails.
ShortestPath shortest_path(const cinch::Vec3& a, const std::vector<Disc>& discs, const cinch::Vec3& b);

}  // namespace oracle
