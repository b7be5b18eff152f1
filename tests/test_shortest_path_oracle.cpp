// The reference for shortest paths through discs, itself checked against closed forms and brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "oracle/shortest_path.hpp"

namespace {

using cinch::Vec3;
using oracle::Disc;
using oracle::shortest_path;
using oracle::ShortestPath;
using Discs = std::vector<Disc>;
using Points = std::vector<Vec3>;

constexpr double pi = std::numbers::pi;
constexpr double tolerance = 2e-11;  // m

// ----------------------------------------------------------------------------------------------------
// Paths by hand

double length_through(const Vec3& a, const Points& waypoints, const Vec3& b) {
  double sum = 0;
  Vec3 last = a;
  for (const Vec3& point : waypoints) {
    sum += (point - last).norm();
    last = point;
  }
  return sum + (b - last).norm();
}

/// Nearest point of the disc.
Vec3 nearest_in(const Disc& disc, const Vec3& point) {
  Vec3 arm = point - disc.center;
  arm -= arm.dot(disc.normal) * disc.normal;
  return disc.center + arm * std::min(1.0, disc.radius / arm.norm());
}

/// Place in the plane of the disc, in radii along two axes.
Vec3 in_plane(const Disc& disc, double x, double y) {
  const Vec3 first = disc.normal.unitOrthogonal();
  return disc.radius * (x * first + y * disc.normal.cross(first));
}

void expect_feasible(const Vec3& a, const Discs& discs, const Vec3& b, const ShortestPath& path) {
  ASSERT_EQ(path.waypoints.size(), discs.size());
  for (std::size_t k = 0; k < discs.size(); ++k) {
    const Vec3 arm = path.waypoints[k] - discs[k].center;
    EXPECT_NEAR(arm.dot(discs[k].normal), 0, 1e-14);
    EXPECT_LE(arm.norm(), discs[k].radius + 1e-14);
  }
  EXPECT_NEAR(path.length, length_through(a, path.waypoints, b), 1e-14);
}

void expect_length(const Vec3& a, const Discs& discs, const Vec3& b, double length) {
  const ShortestPath path = shortest_path(a, discs, b);
  expect_feasible(a, discs, b, path);
  EXPECT_NEAR(path.length, length, tolerance);
}

// ----------------------------------------------------------------------------------------------------
// Random problems

struct Task {
  Vec3 a, b;
  Discs discs;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  Vec3 direction() {
    std::normal_distribution<double> gauss;
    return Vec3(gauss(engine_), gauss(engine_), gauss(engine_)).normalized();
  }
  Vec3 point_in(const Disc& disc) {
    const double rho = std::sqrt(between(0, 1)), angle = between(0, 2 * pi);
    return disc.center + in_plane(disc, rho * std::cos(angle), rho * std::sin(angle));
  }

  /// Ends 1 mm to 1 m apart; centres near the straight line, in any order, so that many discs intersect and
  /// many ends lie on the wrong side.
  Task task(int discs) {
    Task task;
    task.a = between(0, 1) * direction();
    task.b = task.a + scale(1e-3, 1) * direction();
    for (int k = 0; k < discs; ++k) {
      const double radius = scale(1e-6, 0.05);
      const Vec3 on_line = task.a + between(-0.2, 1.2) * (task.b - task.a);
      task.discs.push_back({on_line + between(0, 2) * radius * direction(), direction(), radius});
    }
    return task;
  }

 private:
  std::mt19937 engine_;
};

// ----------------------------------------------------------------------------------------------------
// Brute force

/// Least value of f in the disc, on a grid of 7 by 7 places drawn closer about the best again and again.
template <class Function>
double least_in(const Disc& disc, const Function& f) {
  Vec3 best = disc.center;
  double least = f(best);
  for (double half = 1; half > 1e-5; half *= 0.7) {
    const Vec3 middle = best;
    for (int i = 0; i < 7 * 7; ++i) {
      const double x = half * (i / 7 - 3) / 3, y = half * (i % 7 - 3) / 3;
      const Vec3 point = nearest_in(disc, middle + in_plane(disc, x, y));
      const double value = f(point);
      if (value < least) least = value, best = point;
    }
  }
  return least;
}

/// Shortest length through two discs: for each place of the first waypoint a grid of the second.
double on_grid(const Vec3& a, const Discs& discs, const Vec3& b) {
  return least_in(discs[0], [&](const Vec3& first) {
    return least_in(discs[1], [&](const Vec3& second) { return length_through(a, {first, second}, b); });
  });
}

// ----------------------------------------------------------------------------------------------------
// Closed forms

TEST(ShortestPathOracle, NoDiscsLeaveTheStraightLine) {
  expect_length({0.1, 0.2, 0.3}, {}, {0.4, 0.6, 0.3}, 0.5);
}

TEST(ShortestPathOracle, StraightThroughTheOpenings) {
  const Vec3 tilted = Vec3(2, 1, -1).normalized();
  const Discs discs = {
      {{0.1, 0.01, 0}, {1, 0, 0}, 0.05}, {{0.4, 0, 0.02}, tilted, 0.04}, {{0.8, 0, 0}, {1, 0, 0}, 1e-6}};
  expect_length({0, 0, 0}, discs, {1, 0, 0}, 1);
}

TEST(ShortestPathOracle, PointLikeDiscsGiveTheSumOfDistances) {
  const Vec3 a(0, 0, 0), b(0.3, 0, 0.1);
  const Points centers = {{0.1, 0.2, 0}, {-0.1, 0.1, 0.3}, {0.2, 0.2, 0.2}, {0.2, 0.2, 0.2}};
  Discs tiny, dots;
  for (const Vec3& center : centers) {
    tiny.push_back({center, Vec3(1, 2, 3).normalized(), 1e-6});
    dots.push_back({center, Vec3(1, 2, 3).normalized(), 0});
  }
  const double sum = length_through(a, centers, b);
  expect_length(a, dots, b, sum);
  EXPECT_NEAR(shortest_path(a, tiny, b).length, sum, 8e-6);  // 2 R for each disc
  EXPECT_LT(shortest_path(a, tiny, b).length, sum);
}

TEST(ShortestPathOracle, SymmetricBendOverARim) {
  for (const double h : {0.0005, 0.02, 0.5})
    for (const double c : {1e-6, 0.001, 0.05})
      for (const double beyond : {1e-7, 0.001, 0.1}) {
        const double d = c + beyond;
        expect_length({-h, 0, d}, {{{0, 0, 0}, {1, 0, 0}, c}}, {h, 0, d}, 2 * std::hypot(h, beyond));
      }
}

TEST(ShortestPathOracle, ReflectionWhereBothEndsLieOnOneSide) {
  expect_length({0.03, 0.01, 0}, {{{0, 0, 0}, {1, 0, 0}, 0.05}}, {0.02, -0.02, 0}, std::hypot(0.05, 0.03));
  // The mirror image is seen past the rim.
  expect_length({0.03, 0, 0.04}, {{{0, 0, 0}, {1, 0, 0}, 0.01}}, {0.03, 0, 0.04}, 2 * std::hypot(0.03, 0.03));
}

TEST(ShortestPathOracle, EndsInThePlaneOfTheDisc) {
  const Disc disc{{0, 0, 0}, {0, 0, 1}, 0.05};
  expect_length({-0.2, 0, 0}, {disc}, {0.3, 0, 0}, 0.5);  // any point of a chord
  expect_length({0.01, 0, 0}, {disc, disc, disc}, {0.02, 0.01, 0}, std::hypot(0.01, 0.01));
  expect_length({-0.2, 0.1, 0}, {disc}, {0.2, 0.1, 0}, 2 * std::hypot(0.2, 0.05));
  expect_length({0.06, 0, 0}, {disc, disc}, {0.5, 0, 0}, 0.01 + 0.45);  // there and back
}

TEST(ShortestPathOracle, BackAndForthBetweenParallelDiscs) {
  const Disc left{{-0.1, 0, 0}, {1, 0, 0}, 0.01}, right{{0.1, 0, 0}, {1, 0, 0}, 0.02};
  expect_length({-0.2, 0, 0}, {right, left, right, left}, {0.2, 0, 0}, 0.3 + 3 * 0.2 + 0.3);
}

// Two discs that cross on the z axis, the line at height h above it. Taken in the order opposite to the line,
// the path dips to the axis, where both waypoints coincide.
TEST(ShortestPathOracle, DiscsInOppositeOrderMeetWhereTheyIntersect) {
  const double h = 0.01, l = 0.1, angle = pi / 6;
  const Disc early{{0, 0, 0.002}, {std::cos(angle), std::sin(angle), 0}, 0.03};
  const Disc late{{0, 0, -0.004}, {std::cos(angle), -std::sin(angle), 0}, 0.02};
  ASSERT_LE(h * std::cos(angle) - l * std::sin(angle), std::hypot(h, l) * std::sin(angle));
  expect_length({-l, h, 0}, {late, early}, {l, h, 0}, 2 * std::hypot(h, l));
  expect_length({-l, h, 0}, {early, late}, {l, h, 0}, 2 * l);
  // Ends beyond the reach of the discs along the axis: both waypoints stop at the rim of the smaller one.
  const double rise = 0.1, reach = 0.016;
  expect_length({-l, h, rise}, {late, early}, {l, h, rise}, 2 * std::hypot(h, l, rise - reach));
}

// ----------------------------------------------------------------------------------------------------
// Brute force and chance

TEST(ShortestPathOracle, NoGridOfTwoWaypointsIsShorter) {
  Dice dice(7);
  for (int n = 0; n < 3; ++n) {
    const double tilt = dice.between(0.05, 1.2), height = dice.between(0, 0.03), l = dice.between(0.01, 0.1);
    const Disc early{0.01 * dice.direction(), {std::cos(tilt), std::sin(tilt), 0}, 0.03};
    const Disc late{0.01 * dice.direction(), {std::cos(tilt), -std::sin(tilt), 0}, 0.02};
    const Vec3 a(-l, height, 0.01), b(l, height, -0.02);
    const ShortestPath path = shortest_path(a, {late, early}, b);
    expect_feasible(a, {late, early}, b, path);
    const double grid = on_grid(a, {late, early}, b);
    EXPECT_LE(path.length, grid + tolerance);
    EXPECT_GE(path.length, grid - 1e-6);
  }
}

TEST(ShortestPathOracle, NoRandomWaypointsAreShorter) {
  Dice dice(11);
  for (int n = 0; n < 70; ++n) {
    const Task task = dice.task(n % 7);
    const ShortestPath path = shortest_path(task.a, task.discs, task.b);
    expect_feasible(task.a, task.discs, task.b, path);
    for (int trial = 0; trial < 500; ++trial) {
      // Far and near: each waypoint a part of the way to a random point of its disc.
      const double part = dice.scale(1e-6, 1);
      Points points = path.waypoints;
      for (std::size_t k = 0; k < points.size(); ++k)
        points[k] += part * (dice.point_in(task.discs[k]) - points[k]);
      ASSERT_LE(path.length, length_through(task.a, points, task.b) + tolerance);
    }
  }
}

TEST(ShortestPathOracle, TheWayBackIsAsLong) {
  Dice dice(13);
  for (int n = 0; n < 70; ++n) {
    const Task task = dice.task(n % 7);
    const Discs reversed(task.discs.rbegin(), task.discs.rend());
    const double back = shortest_path(task.b, reversed, task.a).length;
    EXPECT_NEAR(shortest_path(task.a, task.discs, task.b).length, back, tolerance);
  }
}

}  // namespace
