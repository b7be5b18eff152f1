// Free flight: steps in which nothing pulls, done at once, give the bits of single steps, and are found.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "support/memory_archive.hpp"
#include "support/outcome.hpp"
#include "support/quick_cases.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

// A net that is thrown by its corners, slack at first, and beats: elements turn taut here and there. An odd
// number of nodes, two materials with dampers.
std::string thrown_net(const std::string& more) {
  return R"(schema = 1
[time]
end_s = 1
step_s = 2e-6
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
damping_ratio = 0.1
[material.soft]
youngs_modulus_Pa = 1e8
density_kg_m3 = 970
damping_ratio = 0.3
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.6, 0.4]
mesh_m = 0.1
center_m = [0.3, -0.2, 5]
stowed_factor = 0.6
[net.main.node]
top_left = { mass_kg = 0.1, velocity_m_s = [-3, 3, 4] }
bottom_right = { mass_kg = 0.1, velocity_m_s = [3, -3, 4] }
[thread.tail]
material = "soft"
diameter_m = 0.003
elements = 7
length_m = 0.4
points_m = [[1, 1, 5], [1.3, 1, 5.1]]
start = { velocity_m_s = [0, 0, 4] }
end = { velocity_m_s = [0.5, 0.1, 2] }
)" + more;
}

constexpr const char* falling = "[gravity]\nacceleration_m_s2 = [0, -0.3, -9.81]\n";
constexpr const char* ball =
    "[target.b]\ncenter_m = [0.3, -0.2, 5.4]\nradius_m = 0.1\nyoungs_modulus_Pa = 2.3e9\n"
    "poissons_ratio = 0.39\n";

Simulation simulation_of(const Scene& scene, int threads, bool fly) {
  return {scene, fly ? prepare(scene) : step_by_step(prepare(scene)), threads};
}

// Looks every `every` steps, as probes do; returns the steps flown.
std::int64_t expect_bits_of_single_steps(const Scene& scene, std::int64_t steps, std::int64_t every) {
  Simulation plain = simulation_of(scene, 1, false), flying = simulation_of(scene, 1, true);
  std::int64_t flown = 0;
  for (std::int64_t step = every; step <= steps; step += every) {
    const std::int64_t before = flying.stepper().flown();
    plain.advance_to(step);
    flying.advance_to(step);
    const std::int64_t now = flying.stepper().flown();
    flown += now - (now < before ? 0 : before);  // each phase has its own stepper
    EXPECT_TRUE(plain.state().x == flying.state().x && plain.state().vz == flying.state().vz) << step;
    if (testing::Test::HasFailure()) break;
  }
  expect_same(outcome_of(flying), outcome_of(plain));
  EXPECT_EQ(plain.stepper().flown(), 0);
  EXPECT_EQ(plain.stepper().contacts().rebuilds(), flying.stepper().contacts().rebuilds());
  return flown;
}

TEST(FreeFlight, OfANetGivesTheBitsOfSingleSteps) {
  const Scene scene = scene_of(thrown_net(""));
  const std::int64_t flown = expect_bits_of_single_steps(scene, 60000, 10000);
  EXPECT_GT(flown, 5000);
  EXPECT_LT(flown, 55000) << "elements must pull meanwhile";
}

TEST(FreeFlight, AsWellUnderGravity) {
  EXPECT_GT(expect_bits_of_single_steps(scene_of(thrown_net(falling)), 60000, 10000), 5000);
}

TEST(FreeFlight, EndsAtContacts) {
  const Scene scene = scene_of(thrown_net(ball));
  EXPECT_GT(expect_bits_of_single_steps(scene, 60000, 10000), 5000);
  Simulation sim = simulation_of(scene, 1, true);
  sim.advance_to(60000);
  EXPECT_TRUE(outcome_of(sim).ball_touched);
}

// All nodes fly alike and would for ever; those that the ball pushes do not make an element taut at once.
TEST(FreeFlight, OfASlackNetEndsAtTheBall) {
  Scene scene = scene_of(thrown_net(ball));
  scene.threads.clear();
  for (Net& net : scene.nets) net.nodes.clear(), net.velocity = Vec3(0, 0, 4);
  const std::int64_t flown = expect_bits_of_single_steps(scene, 60000, 20000);
  EXPECT_GT(flown, 30000);
  Simulation sim = simulation_of(scene, 1, true);
  sim.advance_to(60000);
  EXPECT_TRUE(outcome_of(sim).ball_touched);
}

TEST(FreeFlight, BetweenLooksOfAnyDistance) {
  const Scene scene = scene_of(thrown_net(ball));
  EXPECT_GT(expect_bits_of_single_steps(scene, 21000, 30), 3000);
  EXPECT_EQ(expect_bits_of_single_steps(scene, 3000, 3), 0) << "not worth a look";
}

TEST(FreeFlight, OfACaptureUpToItsClosing) {
  std::vector<Override> settings{{"case.method", "sliding"}, {"time.step_s", "auto"}, {"time.safety", "0.8"}};
  for (const char* thread : {"c_top", "c_left", "c_right", "c_bottom"})
    settings.push_back({std::string("thread.") + thread + ".elements", "12"});
  const Scene scene = read_case(CINCH_SOURCE_DIR "/cases/capture.toml", settings);
  const std::int64_t steps = prepare(scene).timeline.step_at(1.51);
  EXPECT_GT(expect_bits_of_single_steps(scene, steps, steps / 20), steps / 2);
}

TEST(FreeFlight, IsLeftOutWhereSomethingElseActs) {
  const auto obstacle = [](const std::string& more) {
    const Preparation p = prepare(scene_of(thrown_net(more)));
    return p.phases[0].plan.flight_obstacle(p.phases[0].model);
  };
  EXPECT_EQ(obstacle(""), "");
  EXPECT_EQ(obstacle(ball), "");
  EXPECT_EQ(obstacle(falling), "");
  EXPECT_NE(obstacle(std::string(falling) + ball), "");
  EXPECT_NE(obstacle("[net.main.node.\"knot.1.1\"]\nsupport = \"fixed\"\n"), "");
  const Preparation sliding = prepare(read(sliding_capture()));
  EXPECT_EQ(sliding.phases[0].plan.flight_obstacle(sliding.phases[0].model), "");
  EXPECT_NE(sliding.phases[1].plan.flight_obstacle(sliding.phases[1].model), "");
}

TEST(FreeFlight, OfSeveralThreadsAsWell) {
  for (const std::string more : {"", ball, falling}) {
    const Scene scene = scene_of(thrown_net(more));
    Simulation plain = simulation_of(scene, 1, false), flying = simulation_of(scene, 3, true);
    for (const std::int64_t step : {1, 3000, 12000, 20000}) {
      plain.advance_to(step);
      flying.advance_to(step);
      expect_same(outcome_of(flying), outcome_of(plain));
    }
    EXPECT_GT(flying.stepper().flown(), 3000);
  }
}

// Saved while dampers of elements that two threads share have a force: none may keep it for ever.
TEST(FreeFlight, GoesOnAfterARestartOnSeveralThreads) {
  Scene scene = scene_of(thrown_net(""));
  scene.threads.clear();
  Net& net = scene.nets.front();
  net.mesh = 0.02;  // enough nodes for two threads
  net.stowed_factor = 1.001;
  net.nodes.clear();
  for (int i = 0; i <= net.columns(); ++i)
    for (int j = 0; j <= net.rows(); ++j) {  // all elements turn slack within a few steps
      NodeSpec& knot = net.nodes["knot." + std::to_string(i) + "." + std::to_string(j)];
      knot.velocity = Vec3(2.0 * (net.columns() / 2 - i), 2.0 * (net.rows() / 2 - j), 0);
    }
  Simulation begun = simulation_of(scene, 1, true);
  begun.advance_to(2);
  EXPECT_GT(begun.look().pull(0).tension, 0);
  MemoryArchive saved;
  begun.save(saved);
  MemoryArchive for_one(saved.entries), for_two(saved.entries);
  Simulation plain(scene, step_by_step(prepare(scene)), 1, for_one), next(scene, prepare(scene), 2, for_two);
  plain.advance_to(2000);
  next.advance_to(2000);
  EXPECT_EQ(state_hash(plain.state()), state_hash(next.state()));
  EXPECT_GT(next.stepper().flown(), 0);
}

TEST(FreeFlight, OfWhatIsTooFastStopsAtTheSameStep) {
  Scene scene = scene_of(thrown_net(ball));
  scene.time.speed_limit = 3;
  const auto fault = [&](bool fly) {
    Simulation sim = simulation_of(scene, 1, fly);
    try {
      sim.advance_to(20000);
    } catch (const NumericalError& error) {
      return error.what() + std::to_string(sim.step());
    }
    return std::string();
  };
  EXPECT_NE(fault(false), "");
  EXPECT_EQ(fault(true), fault(false));
}

// ----------------------------------------------------------------------------------------------------
// How long

// Time from which on an element is longer than `length`, by bisection of what is convex.
double bisected(const Vec3& r, const Vec3& u, double length) {
  double low = 0, high = 1;
  while ((r + high * u).norm() < length) high *= 2;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((r + middle * u).norm() < length ? low : high) = middle;
  }
  return low;
}

// One link, and one span whose first element alone is not void.
double time_to_pull(const Vec3& r, const Vec3& u, double length, bool span, double enough = 1e9) {
  constexpr int lanes = kernel::lanes;
  AlignedVector<double> field[6], palette(4 * lanes, 1e300);
  palette[2 * lanes] = length;
  for (int f = 0; f < 6; ++f) {
    field[f].assign(2 * lanes, 0.25);
    field[f][1] = 0.25 + (f < 3 ? r : u)[f % 3];
  }
  const Index parameter = 0;
  kernel::AxialArguments g{};
  g.x = field[0].data(), g.y = field[1].data(), g.z = field[2].data();
  g.vx = field[3].data(), g.vy = field[4].data(), g.vz = field[5].data();
  g.parameter = &parameter, g.palette = palette.data();
  const kernel::Span one{0, 1, 1, 0, 0, 0, -1};
  const kernel::Link link{0, 1, 0, 0, 1, 0, length, 0};
  return kernels().time_to_pull(g, &one, span ? 1 : 0, &link, span ? 0 : 1, 1.0, enough);
}

TEST(FreeFlight, LastsUntilAnElementIsTaut) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 r(draw(random), draw(random), draw(random)), u(draw(random), draw(random), draw(random));
    const double length = r.norm() * (1 + std::pow(10, 4 * draw(random) - 4));
    const double expected = bisected(r, u, length);
    for (const bool span : {false, true}) {
      const double slope = (r + expected * u).dot(u) / length;
      EXPECT_NEAR(time_to_pull(r, u, length, span), expected, 1e-9 * expected + 1e-15 / slope);
      EXPECT_EQ(time_to_pull(1.01 * length / r.norm() * r, u, length, span), 0);
      EXPECT_EQ(time_to_pull(r, u, length, span, 0.99 * expected), 0.99 * expected);
      EXPECT_NEAR(time_to_pull(r, u, length, span, 1.01 * expected), expected, 0.009 * expected);
      EXPECT_EQ(time_to_pull(r, Vec3::Zero(), length, span), 1e9) << "at rest to each other";
    }
  }
}

}  // namespace
