// Closest points, found the slow and sure way: the reference that faster searches are held against.
#pragma once
#include "base/vec3.hpp"

namespace oracle {

/// Point a + t (b - a) of a segment, 0 <= t <= 1, and its distance to another body.
struct Closest {
  double t = 0;
  double distance = 0;  ///< m
};

/// Point of the segment a-b closest to the circle about `center` with unit normal `normal`, global minimum.
/// Two minima of the same distance: the one with the smaller t.
Closest closest_to_circle(const cinch::Vec3& a, const cinch::Vec3& b, const cinch::Vec3& center,
                          const cinch::Vec3& normal, double radius);

/// Point of the segment a-b closest to a point.
Closest closest_to_point(const cinch::Vec3& a, const cinch::Vec3& b, const cinch::Vec3& point);

}  // namespace oracle
