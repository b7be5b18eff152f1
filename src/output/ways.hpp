// Sliding threads as they run: from node to node and, in between, through the rings. What viewers draw in
// place of straight elements.
#pragma once
#include "base/result.hpp"

namespace cinch {

class Ways {
 public:
  /// All threads of the model that have joints.
  explicit Ways(const ResultModel& model);

  std::size_t points() const { return points_; }
  std::size_t segments() const { return points_ - threads_.size(); }
  /// The two points of each segment, [2 segments]: the same in all frames.
  std::vector<std::int64_t> connectivity() const;

  struct Trace {
    std::vector<Vec3> points;          ///< m
    std::vector<double> tension;       ///< N, of each segment: that of its element
    std::vector<std::uint8_t> active;  ///< of each segment
  };
  Trace trace(const Frame& frame) const;

 private:
  struct Thread {
    std::vector<Index> nodes, elements;
    std::size_t points;
  };
  std::vector<Thread> threads_;
  std::size_t points_ = 0;
};

}  // namespace cinch
