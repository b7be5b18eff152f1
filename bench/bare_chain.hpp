// The yardstick of the element update: two bare loops over arrays, written for nothing but one chain.
#pragma once
#include <cstdint>

#include "base/aligned.hpp"
#include "base/index.hpp"

namespace cinch::bench {

/// ring_pull's thread with as many elements of 5 mm as asked for, taut by 1 %.
class BareChain {
 public:
  explicit BareChain(std::int64_t elements);
  void advance(std::int64_t steps);
  const double* places() const { return x_.data(); }

 private:
  Index count_;
  AlignedVector<double> x_, y_, z_, vx_, vy_, vz_, fx_, fy_, fz_;
};

/// Its element updates a second here and now: the median of some short stretches.
double bare_rate(std::int64_t elements);

}  // namespace cinch::bench
