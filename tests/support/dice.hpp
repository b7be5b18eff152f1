// Numbers by chance, the same in each run.
#pragma once
#include <random>

#include "base/vec3.hpp"

namespace cinch::test {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 in_box(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Vec3 direction() {
    Vec3 d = in_box(1);
    while (d.norm() > 1 || d.norm() < 0.1) d = in_box(1);
    return d.normalized();
  }

 private:
  std::mt19937 engine_;
};

}  // namespace cinch::test
