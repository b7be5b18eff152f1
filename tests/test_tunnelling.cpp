// A thread never gets through a ring's wire, or out of its opening, without a word.
#include <gtest/gtest.h>

#include <cstdio>

#include "base/error.hpp"
#include "plan/contact_health.hpp"
#include "support/memory_archive.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

// What all scenes here are made of.
const std::string material = R"([material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
)";

const std::string fixed_ring = R"([ring.r]
joint = "contact"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.01
youngs_modulus_Pa = 7e10
center_m = [0, 0, 0]
normal = [0, 1, 0]
support = "fixed"
)";

struct Shot {
  double speed = 10;  // of the ring, m/s
  double step = 0;    // s; 0: automatic
  double ring_modulus = 7e10;
  int elements = 20;
};

// A ring of 20 mm flies with its wire first at a thread between two fixed ends, in the plane across it: if
// the thread got through the wire, it would pass through the ring. Contact from 3 mm on.
Scene shot(const Shot& s) {
  char text[1200];
  std::snprintf(text, sizeof text, R"(schema = 1
[time]
end_s = %.9g
step_s = %s
[thread.main]
material = "m"
diameter_m = 0.002
elements = %d
points_m = [[0, -0.5, 0], [0, 0.5, 0]]
start = { support = "fixed" }
end = { support = "fixed" }
[ring.r]
joint = "contact"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.01
youngs_modulus_Pa = %g
center_m = [0.02, 0.013, 0]
normal = [0, 1, 0]
velocity_m_s = [%g, 0, 0]
)",
                0.03 / s.speed, s.step > 0 ? std::to_string(s.step * 1e6).append("e-6").c_str() : "\"auto\"",
                s.elements, s.ring_modulus, -s.speed);
  return scene_of(text + material);
}

std::string failure(Simulation& simulation, double until) {
  try {
    for (double t = simulation.time(); t < until; t += until / 50) {
      run_until(simulation, std::min(t + until / 50, until));
      simulation.note_events(simulation.look());
      simulation.check_energy(simulation.look());
    }
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Whether the thread's centre line goes through the ring.
bool inside(const Simulation& simulation) {
  const Vec3 center = place(simulation, simulation.preparation().assembly.rings[0].node);
  const Part& thread = simulation.preparation().assembly.parts[0];
  int times = 0;
  for (std::size_t k = 1; k < thread.nodes.size(); ++k) {
    const Vec3 a = place(simulation, thread.nodes[k - 1]) - center,
               b = place(simulation, thread.nodes[k]) - center;
    if ((a.y() < 0) == (b.y() < 0)) continue;
    const Vec3 middle = a + a.y() / (a.y() - b.y()) * (b - a);
    times += std::hypot(middle.x(), middle.z()) < 0.01 ? (a.y() < 0 ? 1 : -1) : 0;
  }
  return times != 0;
}

TEST(Tunnelling, AStepTooLongToSeeTheTouchStopsTheRun) {
  Simulation simulation(shot({.speed = 400, .step = 8e-6}));
  const std::string said = failure(simulation, 5e-5);
  EXPECT_TRUE(has(said, "element ") && has(said, "of thread.main") && has(said, "comes towards ring 'r'"))
      << said;
  EXPECT_TRUE(has(said, "allowed: 0.0015 m") && has(said, "likely cause")) << said;
  // the step that it advises is short enough, for this
  Simulation shorter(shot({.speed = 400, .step = 3.3e-6}));
  EXPECT_FALSE(has(failure(shorter, 5e-5), "comes towards"));
}

TEST(Tunnelling, TargetsAreWatchedLikeRings) {
  Simulation simulation(scene_of(std::string(R"(schema = 1
[time]
end_s = 1e-3
step_s = 1e-5
[thread.main]
material = "m"
diameter_m = 0.002
elements = 10
points_m = [[0, -0.5, 0], [0, 0.5, 0]]
velocity_m_s = [300, 0, 0]
[target.pin]
center_m = [0.02, 0.01, 0]
radius_m = 0.003
youngs_modulus_Pa = 7e10
)") + material));
  EXPECT_TRUE(has(failure(simulation, 1e-3), "comes towards target 'pin'"));
}

// 400 m/s along itself, through the ring's opening, 3 mm from the wire.
TEST(Tunnelling, MotionAlongTheThreadIsNoJump) {
  Simulation simulation(scene_of(std::string(R"(schema = 1
[time]
end_s = 2e-4
step_s = 8e-6
[thread.main]
material = "m"
diameter_m = 0.002
elements = 20
points_m = [[0.004, -0.5, 0], [0.004, 0.5, 0]]
velocity_m_s = [0, 400, 0]
)") + material + fixed_ring));
  EXPECT_EQ(failure(simulation, 2e-4), "");
}

TEST(Tunnelling, AContactTooSoftForThePullStopsTheRun) {
  Simulation simulation(shot({.speed = 20, .ring_modulus = 1e5}));
  const std::string said = failure(simulation, 0.0015);
  EXPECT_TRUE(has(said, "is pressed") && has(said, "into ring 'r'") && has(said, "of the 0.003 m")) << said;
}

// Any speed, any modulus, elements shorter and longer than the ring: the thread stays out of it, or the run
// stops.
TEST(Tunnelling, NoShotGetsThroughUnnoticed) {
  int stopped = 0, held = 0;
  for (const double speed : {0.3, 3.0, 30.0, 100.0, 200.0, 350.0, 500.0})
    for (const double modulus : {1e5, 1e7, 1e9, 7e10})
      for (const int elements : {7, 20, 200}) {
        SCOPED_TRACE(std::to_string(speed) + " m/s, " + std::to_string(modulus) + " Pa, " +
                     std::to_string(elements));
        Simulation simulation(shot({speed, 0, modulus, elements}));
        const std::string said = failure(simulation, 0.03 / speed);
        ++(said.empty() ? held : stopped);
        EXPECT_FALSE(said.empty() && inside(simulation));
      }
  EXPECT_GT(held, 20);
  EXPECT_GT(stopped, 10);
}

// A ring of 100 mm on an element of 10 mm that spins: its wire comes at the bar ten times as fast as any node
// moves.
TEST(Tunnelling, AWireThatTurnsFasterThanAnyNodeIsSeenInTime) {
  Simulation simulation(scene_of(std::string(R"(schema = 1
[time]
end_s = 2e-3
step_s = 1e-7
[thread.hub]
material = "m"
diameter_m = 0.002
elements = 1
points_m = [[0, -0.005, 0], [0, 0.005, 0]]
start = { mass_kg = 0.1, velocity_m_s = [1, 0, 0] }
end = { mass_kg = 0.1, velocity_m_s = [-1, 0, 0] }
[thread.bar]
material = "m"
diameter_m = 0.002
elements = 4
points_m = [[0.046, 0.02, -0.2], [0.046, 0.02, 0.2]]
start = { support = "fixed" }
end = { support = "fixed" }
[ring.r]
joint = "contact"
diameter_m = 0.1
wire_diameter_m = 0.004
mass_kg = 0.001
youngs_modulus_Pa = 7e10
on = "thread.hub"
element = 0
threads = ["bar"]
)") + material));
  EXPECT_EQ(failure(simulation, 2e-3), "");
  const RingRecord ring = simulation.summary().ring_records[0];
  EXPECT_NEAR(ring.first_contact_time, 1.75e-3, 5e-5);  // 0.35 rad at 200 rad/s
}

// ----------------------------------------------------------------------------------------------------
// Out of the opening

// Its end is drawn out of a fixed ring.
Scene drawn_out(const char* leaving) {
  return scene_of(std::string(R"(schema = 1
[time]
end_s = 0.1
[contact]
leaving = ")") + leaving +
                  R"("
[thread.main]
material = "m"
diameter_m = 0.002
elements = 50
points_m = [[0, -0.05, 0], [0, 0.2, 0]]
velocity_m_s = [0, 1, 0]
)" + material + fixed_ring);
}

TEST(Tunnelling, AThreadThatLeavesItsRingStopsTheRun) {
  Simulation simulation(drawn_out("stop"));
  const std::string said = failure(simulation, 0.1);
  EXPECT_TRUE(
      has(said, "thread.main has left ring 'r' at (0, 0, 0) m: it passed through it 1 time(s), now 0"))
      << said;
  EXPECT_NEAR(simulation.time(), 0.05, 0.003);
  ASSERT_EQ(simulation.summary().events.size(), 1u);
  EXPECT_EQ(simulation.summary().events[0].kind, "thread_left");
}

TEST(Tunnelling, OrIsAnEvent) {
  Simulation simulation(drawn_out("event"));
  EXPECT_EQ(failure(simulation, 0.1), "");
  const Summary summary = simulation.summary();
  ASSERT_EQ(summary.events.size(), 1u) << "it is told once";
  EXPECT_EQ(summary.events[0].kind, "thread_left");
  EXPECT_EQ(summary.events[0].name, "r: thread.main");
  EXPECT_NEAR(summary.events[0].time, 0.05, 0.003);
}

TEST(Tunnelling, AfterARestartItIsStillWatched) {
  const Scene scene = drawn_out("stop");
  Simulation simulation(scene);
  EXPECT_EQ(failure(simulation, 0.03), "");
  MemoryArchive saved;
  simulation.save(saved);
  MemoryArchive from(saved.entries);
  Simulation next(scene, prepare(scene), 1, from);
  EXPECT_TRUE(has(failure(next, 0.1), "has left ring 'r'"));
}

}  // namespace
