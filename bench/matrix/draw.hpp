// Scenes at random: each from its seed alone, so that what is found can be drawn again.
#pragma once
#include <cmath>
#include <random>
#include <string>

#include "scene/scene.hpp"

namespace cinch::matrix {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool chance(double share) { return uniform(0, 1) < share; }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

 private:
  std::mt19937 engine_;
};

/// What to draw: masses, stiffnesses, dampers and places at random.
enum class Family {
  graph,     ///< any nodes joined by any elements, over six decades
  chain,     ///< threads end to end
  junction,  ///< threads from one knot
  net        ///< a net with masses, supports, rings and a tether
};

/// A scene of any family but `graph`: taut threads and nets, at rest.
Scene draw_scene(Dice& dice, Family family);

std::string name(Family family);

}  // namespace cinch::matrix
