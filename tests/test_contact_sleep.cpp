// Pairs that sleep: nothing touches before they wake, however short the host of a ring has become.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "kernels/ring_sleep.hpp"
#include "oracle/closest.hpp"
#include "store/fields.hpp"
#include "support/dice.hpp"
#include "support/memory_archive.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

// ----------------------------------------------------------------------------------------------------
// The bound

struct PairPlaces {
  Vec3 a, b, host_a, host_b;

  Vec3 center() const { return 0.5 * (host_a + host_b); }
  double distance(double radius) const {
    return oracle::closest_to_circle(a, b, center(), (host_b - host_a).normalized(), radius).distance;
  }
};

// Within, and often on, a ball about the origin.
Vec3 within(Dice& dice, double radius) {
  return radius * std::min(1.0, dice.between(0, 2)) * dice.direction();
}

// All nodes by at most `way`, by chance.
PairPlaces scattered(const PairPlaces& p, double way, Dice& dice) {
  return {p.a + within(dice, way), p.b + within(dice, way), p.host_a + within(dice, way),
          p.host_b + within(dice, way)};
}

// The way that closes a gap soonest: the host's ends go apart along `across`, which turns the wire towards
// the element, or the element goes towards the wire and the centre comes to meet it.
PairPlaces turned(const PairPlaces& p, double way, const Vec3& across) {
  return {p.a, p.b, p.host_a - way * across, p.host_b + way * across};
}

PairPlaces met(const PairPlaces& p, double way, const Vec3& towards) {
  return {p.a + way * towards, p.b + way * towards, p.host_a - way * towards, p.host_b - way * towards};
}

// What a motion can close of a gap, by the head of ring_sleep.hpp.
double closed_by(double motion, double radius, double length) {
  return motion + std::sqrt(2) * radius * std::min(1.0, motion / length);
}

TEST(ContactSleep, NoMotionClosesMoreOfAGapThanTheBound) {
  constexpr double radius = 0.1;
  Dice dice(7);
  double closest = 0;  // to the bound
  for (int k = 0; k < 5000; ++k) {
    const double length = radius * std::pow(10, dice.between(-3, 1));
    const Vec3 along = 0.5 * length * dice.direction(), start = 2 * radius * within(dice, 1);
    const PairPlaces p{start, start + within(dice, 3 * radius), -along, along};
    const double way = 0.5 * radius * std::pow(10, dice.between(-4, 0));
    const double gap = p.distance(radius), most = closed_by(2 * way, radius, length);
    const Vec3 normal = along.normalized(), towards = -start.normalized();
    const Vec3 radial = (start - start.dot(normal) * normal).normalized();
    for (const PairPlaces& moved : {scattered(p, way, dice), scattered(p, way, dice), turned(p, way, radial),
                                    turned(p, way, -radial), met(p, way, towards), met(p, way, -towards)}) {
      const double closed = gap - moved.distance(radius);
      ASSERT_LE(closed, most * (1 + 1e-9) + 1e-12) << k << ": gap " << gap << ", host " << length;
      closest = std::max(closest, closed / most);
    }
  }
  EXPECT_GT(closest, 0.8) << "nor is the bound a loose one";
}

TEST(ContactSleep, PairsSleepForAsLongAsTheBoundAllows) {
  constexpr double radius = 0.1;
  Dice dice(7);
  for (int k = 0; k < 1000; ++k) {
    const double length = radius * std::pow(10, dice.between(-3, 1));
    const double gap = radius * std::pow(10, dice.between(-4, 1));
    EXPECT_NEAR(closed_by(plain::ring_sleep(gap, radius, 1 / length), radius, length), gap, 1e-12 * gap)
        << "gap " << gap << ", host " << length;
  }
}

TEST(ContactSleep, ARingThatDoesNotTurnSleepsForItsGap) {
  EXPECT_EQ(plain::ring_sleep(0.03, 0.1, 0), 0.03);
  EXPECT_EQ(plain::ring_sleep(-0.001, 0.1, 0), -0.001);
}

TEST(ContactSleep, OneOnAHostFoldedToAPointIsOutOfReachOrAwake) {
  const double folded = std::numeric_limits<double>::infinity();
  EXPECT_EQ(plain::ring_sleep(0.1, 0.1, folded), 0);
  EXPECT_NEAR(plain::ring_sleep(0.2, 0.1, folded), 0.2 - std::sqrt(2) * 0.1, 1e-15);
}

// ----------------------------------------------------------------------------------------------------
// Hosts whose ends pass each other

// A ring of 100 mm radius on an element of 120 mm at rest, slack, whose ends pass each other 8 mm apart: the
// wire turns through half a circle, on whose way a thread hangs.
Scene turning_over(double speed, double step, double margin) {
  char text[1500];
  std::snprintf(text, sizeof text, R"(schema = 1
[time]
end_s = 0.1
step_s = %.9g
[contact]
margin_m = %.9g
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 970
[thread.host]
material = "m"
diameter_m = 0.002
elements = 1
length_m = 0.12
points_m = [[-0.05, -0.004, 0], [0.05, 0.004, 0]]
start = { mass_kg = 0.1, velocity_m_s = [%.9g, 0, 0] }
end = { mass_kg = 0.1, velocity_m_s = [-%.9g, 0, 0] }
[thread.main]
material = "m"
diameter_m = 0.002
elements = 40
points_m = [[-0.0707, 0.0707, -0.2], [-0.0707, 0.0707, 0.2]]
[ring.r]
joint = "contact"
on = "thread.host"
element = 0
diameter_m = 0.2
wire_diameter_m = 0.004
mass_kg = 0.01
youngs_modulus_Pa = 7e8
threads = ["main"]
)",
                step, margin, speed, speed);
  return scene_of(text);
}

double first_touch(const Simulation& simulation) { return simulation.state().rings.front().first_time; }

TEST(ContactSleep, AWireOnAHostThatPassesThroughItselfIsSeenInTimeWhateverTheMargin) {
  std::vector<std::uint64_t> hashes;
  for (const double margin : {1e-6, 0.0, 0.0005, 0.01, 0.2}) {  // the first: none ever sleeps
    Simulation simulation(turning_over(1, 1e-6, margin), 1);
    simulation.advance_to(45900);
    EXPECT_NEAR(first_touch(simulation), 0.045753, 2e-6) << "margin " << margin;
    hashes.push_back(state_hash(simulation.state()));
  }
  EXPECT_EQ(std::count(hashes.begin(), hashes.end(), hashes.front()), 5);
}

TEST(ContactSleep, NorDoesARestartWakeIt) {
  const Scene scene = turning_over(1, 1e-6, 0);
  Simulation simulation(scene, 1);
  simulation.advance_to(45750);
  MemoryArchive saved;
  simulation.save(saved);
  MemoryArchive from(saved.entries);
  Simulation next(scene, prepare(scene), 2, from);
  for (Simulation* each : {&simulation, &next}) each->advance_to(45900);
  EXPECT_NEAR(first_touch(next), 0.045753, 2e-6);
  EXPECT_EQ(state_hash(next.state()), state_hash(simulation.state()));
}

// Ten times as fast the wire goes 2 mm in a step where the host is short, and 0.4 mm by its length at rest.
TEST(ContactSleep, AStepTooLongForAWireOnAShortHostStopsTheRun) {
  for (const int threads : {1, 2}) {
    Simulation simulation(turning_over(10, 1.2e-5, 0), threads);
    try {
      run_until(simulation, 0.01);
      FAIL() << "touched at " << first_touch(simulation);
    } catch (const NumericalError& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("comes towards ring 'r'"), std::string::npos) << said;
    }
  }
}

}  // namespace
