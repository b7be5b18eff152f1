// A mild perspective: where a point of the scene falls in a picture.
#pragma once
#include <optional>
#include <vector>

#include "base/result.hpp"

namespace cinch {

/// A point in the picture's plane: metres at the target's distance, x to the right, y up; depth towards the
/// viewer.
struct Seen {
  double x = 0, y = 0, depth = 0, size = 1;  ///< size: of a small thing there, 1 at the target's distance
};

struct Camera {
  Vec3 target = Vec3::Zero();                                              ///< the point looked at, m
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), toward = Vec3::UnitZ();  ///< unit, right-handed
  double distance = 1e9;  ///< of the eye from the target, m; large: no perspective

  /// The eye looks from `from` (any length) at `target`; `above` is up in the picture.
  static Camera looking(const Vec3& target, const Vec3& from, const Vec3& above, double distance);
  Seen see(const Vec3& point) const;
};

/// What decides a good view of a result.
struct ViewHints {
  std::optional<Vec3> gravity;     ///< m/s^2
  Vec3 rightwards = Vec3::Zero();  ///< a direction that should run to the right, or zero
  bool pull_along_y = false;       ///< Sec. 5.1: Y to the right, Z up
};

/// A view for all pictures of a run, chosen from its first and last frame.
Camera choose_camera(const ResultModel& model, const Frame& first, const Frame& last, const ViewHints& hints);

/// True for each node that is part of the scene now: it has an active element, or no element at all.
std::vector<bool> present_nodes(const ResultModel& model, const Frame& frame);

}  // namespace cinch
