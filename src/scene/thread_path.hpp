// The points that a thread is laid along.
#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace cinch {

class ThreadPath {
 public:
  /// Throws CaseError for points too close to each other to tell apart.
  explicit ThreadPath(const Thread& thread);

  double length() const { return reach_.back(); }  ///< m
  /// Where node k of the thread lies if it is no other part's.
  Vec3 node(int k) const;

 private:
  const Thread& thread_;
  std::vector<double> reach_;  ///< of each point, from the first on, m
};

}  // namespace cinch
