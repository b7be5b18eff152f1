// A run that goes wrong tells the first step and node that did, however seldom the solver looks.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "base/error.hpp"
#include "plan/health.hpp"
#include "store/fields.hpp"
#include "support/memory_archive.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

// A net without contacts, stretched by 0.1 %, at three times its stable step; `meshes` a side.
Scene unstable_net(int meshes) {
  const std::string side = std::to_string(0.1 * meshes);
  Scene scene = scene_of(R"(schema = 1
[time]
end_s = 1
speed_limit_m_s = 50
allow_unstable = true
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [)" + side + ", " +
                         side + R"(]
mesh_m = 0.1
stowed_factor = 1.001
)");
  scene.time.step = 3 * prepare(scene).stable_step;
  return scene;
}

std::string fault_of(Simulation& sim, std::int64_t end) {
  try {
    sim.advance_to(end);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

// The same run, looked at after every step.
std::string fault_step_by_step(Simulation& sim, double speed_limit) {
  while (sim.step() < 4000 && speeds_allowed(sim.state(), speed_limit)) sim.stepper().advance(sim.state(), 1);
  try {
    report_runaway(sim.preparation(), sim.phase(), sim.state(), speed_limit);
  } catch (const NumericalError& error) {
    return error.what();
  }
}

// 12 meshes: one block a step; 100 meshes: several steps in one sweep.
class Runaway : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(Runaway, IsToldWithItsFirstStepAndNode) {
  const auto [meshes, threads] = GetParam();
  const Scene scene = unstable_net(meshes);
  Simulation plain(scene, 1), sim(scene, threads);
  const std::string expected = fault_step_by_step(plain, scene.time.speed_limit);
  EXPECT_EQ(fault_of(sim, 4096), expected);
  EXPECT_LT(sim.step(), 4000);
  EXPECT_EQ(sim.step(), plain.step());
  EXPECT_TRUE(sim.state().x == plain.state().x && sim.state().vz == plain.state().vz);
}

INSTANTIATE_TEST_SUITE_P(Health, Runaway,
                         testing::Values(std::pair{12, 1}, std::pair{12, 2}, std::pair{100, 1},
                                         std::pair{100, 3}),
                         [](const auto& one) {
                           return std::to_string(one.param.first) + "_meshes_" +
                                  std::to_string(one.param.second) + "_threads";
                         });

// Whatever makes a speed that is not a number: the node is named.
TEST(Health, ASpeedThatIsNoNumberIsSeen) {
  Scene scene = unstable_net(12);
  scene.time.step *= 0.2;
  Simulation sim(scene, 1);
  EXPECT_EQ(fault_of(sim, 100), "");
  const Index node = 40;
  sim.state().vy[at(node)] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(speeds_allowed(sim.state(), scene.time.speed_limit));
  EXPECT_THROW(sim.advance_to(200), NumericalError);
}

TEST(Health, SpeedsUpToTheLimitAreAllowed) {
  Simulation sim(unstable_net(12), 1);
  State state = sim.state();
  state.vx.back() = 3, state.vy.back() = 4;
  EXPECT_TRUE(speeds_allowed(state, 5));
  EXPECT_FALSE(speeds_allowed(state, 4.99));
  state.vz.back() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(speeds_allowed(state, 1e100));
}

// ---- pauses

// A run that goes wrong, as `cinch run` leaves it, having paused every so many steps.
struct Left {
  std::int64_t step;
  std::uint64_t state;
  std::string fault;
  bool operator==(const Left&) const = default;
};

Left left_by(const Scene& scene, int threads, std::int64_t stretch) {
  Simulation sim(scene, threads);
  constexpr std::int64_t end = 20000;
  std::string fault;
  try {
    while (sim.step() < end) sim.advance_towards(end, sim.step() + stretch);
  } catch (const NumericalError& error) {
    fault = error.what();
    sim.step_back();
  }
  return {sim.step(), state_hash(sim.state()), fault};
}

// A thread that is pressed through a ball after 0.1 s.
Scene pressed_through() {
  return thread_scene(1e9, 0.106, R"(
elements = 40
points_m = [[-0.5, 0, 3.06], [0.5, 0, 3.06]]
velocity_m_s = [0, 0, -30]
start = { mass_kg = 1 }
end = { mass_kg = 1 }
[target.ball]
center_m = [0, 0, 0]
radius_m = 0.05
youngs_modulus_Pa = 1e4
)");
}

// One that falls and is too fast after 0.1 s; it touches nothing, so that speeds are seen at looks alone.
Scene too_fast() {
  Scene scene = thread_scene(1e9, 0.106, R"(
elements = 40
points_m = [[-0.5, 0, 0], [0.5, 0, 0]]
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
)");
  scene.time.speed_limit = 1;
  scene.time.step = 1e-5;
  return scene;
}

TEST(Health, WhatAFailedRunLeavesDoesNotHangOnWhereItPaused) {
  for (const Scene& scene : {too_fast(), pressed_through()}) {
    const Left whole = left_by(scene, 1, 20000);
    EXPECT_NE(whole.fault, "");
    EXPECT_GT(whole.step, 0) << "it fails late enough to have been looked at";
    for (const std::int64_t stretch : {64, 1000, 3001}) {
      SCOPED_TRACE(stretch);
      const Left paused = left_by(scene, 1, stretch);
      EXPECT_EQ(paused.step, whole.step);
      EXPECT_EQ(paused.fault, whole.fault);
      EXPECT_EQ(paused.state, whole.state);
    }
  }
}

// ... nor on where it began again: there are no other looks.
TEST(Health, AfterARestartStatesAreKeptAtTheSameSteps) {
  const Scene scene = pressed_through();
  const Left whole = left_by(scene, 1, 20000);
  Simulation first(scene, 1);
  first.advance_to(std::max<std::int64_t>(whole.step - 77, 1));
  MemoryArchive saved;
  first.save(saved);
  MemoryArchive from(saved.entries);
  Simulation next(scene, prepare(scene), 1, from);
  EXPECT_THROW(next.advance_to(20000), NumericalError);
  next.step_back();
  EXPECT_EQ(next.step(), whole.step);
  EXPECT_EQ(state_hash(next.state()), whole.state);
}

TEST(Health, APauseCanBeLookedAt) {
  Scene scene = unstable_net(12);
  scene.time.step *= 0.2;
  Simulation sim(scene, 1);
  sim.state().vy[40] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(sim.advance_towards(200, 100));
  EXPECT_EQ(sim.step(), 100);
  EXPECT_THROW(sim.check_health(), NumericalError);
}

// ---- energy from nowhere

// An undamped thread wins energy without end at 0.7 of the stable step.
const double creeping = 1.1e-5, sound = 3e-6;  // s

// As `cinch run` does it: a look every 10 ms.
std::string energy_fault(const Scene& scene) {
  Simulation sim(scene, 1);
  try {
    while (sim.time() < scene.time.end) {
      sim.advance_to(sim.step() + 1000);
      sim.check_energy(sim.look());
    }
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

TEST(Health, EnergyFromNowhereStopsTheRun) {
  const std::string fault = energy_fault(slackening_thread(creeping));
  for (const char* piece : {"J have come from nowhere", "(time.residual_limit = 0.05)", "fastest: node ",
                            "of thread.main at (", "likely cause: the time step 1.1e-05 s is too large"})
    EXPECT_NE(fault.find(piece), std::string::npos) << piece << " in: " << fault;
}

TEST(Health, ASoundRunKeepsItsEnergy) { EXPECT_EQ(energy_fault(slackening_thread(sound)), ""); }

TEST(Health, AResidualThatIsNoNumberStopsTheRun) {
  const Simulation sim(slackening_thread(sound), 1);
  const auto check = [&](double residual) {
    check_energy(sim.preparation(), sim.phase(), sim.state(), residual, 1, 0.05);
  };
  EXPECT_NO_THROW(check(0.05));
  EXPECT_THROW(check(std::numeric_limits<double>::quiet_NaN()), NumericalError);
}

TEST(Health, TheEnergyLimitIsTheCases) {
  Scene scene = slackening_thread(sound);
  scene.time.residual_limit = 1e-9;
  EXPECT_NE(energy_fault(scene).find("time.residual_limit = 1e-09"), std::string::npos);
  scene.output.ledger = false;
  EXPECT_EQ(energy_fault(scene), "");
  scene.output.ledger = true, scene.time.allow_unstable = true;
  EXPECT_EQ(energy_fault(scene), "");
}

// ---- contacts side by side

// A net of 3 x 3 knots that lies flat in the wall of a ball so large that all of it sinks in alike.
Scene sunken_net() {
  return scene_of(R"(schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.2, 0.2]
mesh_m = 0.1
elements_per_side = 4
center_m = [0, 0, 1000]
[target.wall]
center_m = [0, 0, 0]
radius_m = 1000
youngs_modulus_Pa = 1e3
)");
}

double contact_energy(SharedNode rule) {
  Scene scene = sunken_net();
  scene.contact.shared_node = rule;
  return Simulation(scene, 1).look().energy().contact;
}

// 48 elements, and 45 nodes: depths differ by 1 %, elements sink in by no more than their deeper ends.
TEST(Health, ANetThatSinksInAsAWholeHoldsWhatItsNodesHold) {
  EXPECT_NEAR(contact_energy(SharedNode::once) / contact_energy(SharedNode::paper), 45 / 48.0, 2e-3);
}

TEST(Health, ASceneWithoutEnergyIsNotWarnedOfItsRounding) {
  Scene scene = thread_scene(1e9, 0.106, R"(
elements = 20
points_m = [[-0.05, 0, -0.007], [0.05, 0, -0.007]]
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.006
youngs_modulus_Pa = 70e9
center_m = [0, 0, 0]
normal = [1, 0, 0]
)");
  Simulation sim(scene, 1);
  sim.advance_to(10000);
  const Summary summary = sim.summary();
  EXPECT_GT(std::abs(summary.energy.residual), 0.01 * summary.energy_initial) << "it just touches the wire";
  EXPECT_LT(summary.relative_residual, 0.01);
  EXPECT_TRUE(summary.warnings.empty()) << summary.warnings.front();
}

}  // namespace
