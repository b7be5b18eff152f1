#include "scene/thread_path.hpp"

#include "scene/fault.hpp"

namespace cinch {

ThreadPath::ThreadPath(const Thread& thread) : thread_(thread), reach_{0} {
  const std::vector<Vec3>& points = thread.points;
  for (std::size_t p = 1; p < points.size(); ++p) {
    reach_.push_back(reach_.back() + (points[p] - points[p - 1]).norm());
    if (!(reach_[p] > reach_[p - 1]))
      fail(thread.source, "thread '" + thread.name + "': points " + std::to_string(p) + " and " +
                              std::to_string(p + 1) +
                              " of points_m are too close to each other for the thread's length");
  }
}

Vec3 ThreadPath::node(int k) const {
  const std::vector<Vec3>& points = thread_.points;
  const double s = reach_.back() * k / thread_.elements;
  std::size_t p = 1;
  while (p + 1 < reach_.size() && reach_[p] < s) ++p;
  const double along = (s - reach_[p - 1]) / (reach_[p] - reach_[p - 1]);
  return points[p - 1] + along * (points[p] - points[p - 1]);
}

}  // namespace cinch
