// Forces of sliding joints that hold for several steps: their order, their books, how long they may hold.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.hpp"
#include "plan/piece.hpp"
#include "plan/stable_step.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

Scene case_scene(const char* name, int elements) {
  Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / name);
  for (Thread& thread : scene.threads) thread.elements = elements;
  for (Ring& ring : scene.rings) ring.joint = RingJoint::sliding;
  scene.time.step = 0;
  scene.time.joint_steps = 0;
  return scene;
}

Scene ring_pull(int elements) { return case_scene("ring_pull.toml", elements); }

// The net lies open, the mouth begins to close.
Scene closing_net(int elements) {
  Scene scene = case_scene("capture.toml", elements);
  for (Net& net : scene.nets) net.stowed_factor = 1;
  for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 1;
  scene.targets.clear();
  scene.closing.time = 0.001;
  scene.time.safety = 0.8;
  return scene;
}

int steps_held(const Scene& scene) { return prepare(scene).phases.back().plan.joint_steps; }

// A taut thread that quivers over the rim of a fixed ring, after 0.05 s.
Scene plucked_thread(double step, int held) {
  Scene scene = thread_scene(1e7, 0, R"(
elements = 3
points_m = [[0, 0, 0], [0.5, 0.05, 0], [1, 0, 0]]
length_m = 0.9
start = { support = "fixed" }
end = { support = "fixed" }
[ring.r]
joint = "sliding"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.02
youngs_modulus_Pa = 70e9
center_m = [0.5, 0.0395, 0]
normal = [1, 0.2, 0]
support = "fixed"
)");
  scene.time.step = step;
  scene.time.allow_unstable = true;
  scene.time.joint_steps = held;
  return scene;
}

std::vector<Vec3> plucked(double step, int held) {
  Simulation sim(plucked_thread(step, held), 1);
  run_until(sim, 0.05);
  EXPECT_EQ(sim.state().joints[0].passes, 0);
  EXPECT_GT(sim.look().pull(0).tension, 0);
  return {place(sim, 1), place(sim, 2)};
}

// Forces that held without being computed ahead would leave an error of first order, as dampers do.
TEST(HeldJoints, PathsAreOfSecondOrderInTheTimeThatForcesHold) {
  const double step = 0.05 / 1024;
  const std::vector<Vec3> exact = plucked(step / 32, 1);
  const auto error = [&](double of_step) {
    const std::vector<Vec3> found = plucked(of_step, 8);
    return std::max((found[0] - exact[0]).norm(), (found[1] - exact[1]).norm());
  };
  const double coarse = error(step), middle = error(step / 2), fine = error(step / 4);
  EXPECT_GT(coarse, 1e-7);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.35) << coarse << ' ' << middle;
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.35) << middle << ' ' << fine;
}

// Looks at every step of some stretches while threads are taut and nodes pass.
TEST(HeldJoints, TheLedgerClosesAtEveryStep) {
  Scene scene = closing_net(12);
  scene.time.joint_steps = 4;
  Simulation sim(scene, 1);
  int passes = 0;
  for (const double time : {0.03, 0.06, 0.1, 0.2, 0.4}) {
    run_until(sim, time);
    double least = 1, most = -1;
    for (int k = 0; k < 24; ++k) {
      sim.advance_to(sim.step() + 1);
      const Summary summary = sim.summary();
      const double share = summary.energy.residual / summary.energy.work_separation;
      least = std::min(least, share), most = std::max(most, share);
    }
    EXPECT_LT(std::max(std::abs(least), std::abs(most)), 5e-4) << time;
    EXPECT_LT(most - least, 1e-4) << time;
  }
  for (const auto& joint : sim.state().joints) passes += joint.passes;
  EXPECT_GT(passes, 20);
}

TEST(HeldJoints, MomentumIsKeptToRounding) {
  Scene scene = closing_net(12);
  scene.time.joint_steps = 5;
  Simulation sim(scene, 1);
  run_until(sim, 0.2);
  EXPECT_LT(sim.summary().linear_momentum_drift, 1e-12);
}

// The support takes the couple that turns the ring, for as long as it holds. What angular momentum is left
// over comes from forces at places a little ahead.
TEST(HeldJoints, CouplesOfSupportsAreBookedForAsLongAsTheyHold) {
  Simulation sim(plucked_thread(0.05 / 4096, 8), 1);
  run_until(sim, 0.05);
  const double(&couple)[3] = sim.state().rings[0].couple_impulse;
  const double size = Vec3(couple[0], couple[1], couple[2]).norm();
  EXPECT_GT(size, 1e-6);
  EXPECT_LT(sim.summary().angular_momentum_drift.value(), 1e-4 * size);
}

// ---- looks

// Another thread may still be taking the joints from the state.
TEST(HeldJoints, ALookLeavesThemInTheStateUntilItIsOver) {
  Simulation sim(plucked_thread(1e-5, 1), 1);
  sim.look();
  sim.advance_to(100);
  State& state = sim.state();
  const double before = state.joints.at(0).tension;
  Piece piece(sim.model(), sim.phase().plan,
              node_share(sim.model(), sim.phase().plan.dt, sim.phase().plan.joint_steps));
  Glance out;
  out.elastic.assign(at(sim.model().ledger_rows() * kernel::lanes), 0.0);
  piece.glance(state, 0, out);
  EXPECT_EQ(state.joints[0].tension, before);
  piece.tell_joints(state);
  EXPECT_NE(state.joints[0].tension, before);
  sim.look();
  EXPECT_EQ(sim.state().joints[0].tension, state.joints[0].tension);
}

// ---- how long

TEST(HeldJoints, AutomaticallyOnlyWhereAnotherPartLimitsTheStep) {
  EXPECT_EQ(steps_held(ring_pull(12)), 1);
  EXPECT_GT(steps_held(closing_net(12)), 2);
  EXPECT_LE(steps_held(closing_net(2)), 8);
  EXPECT_LT(steps_held(closing_net(26)), steps_held(closing_net(12)));
  const auto held_at = [](double safety) {
    Scene scene = closing_net(12);
    scene.time.safety = safety;
    return steps_held(scene);
  };
  EXPECT_EQ(held_at(0.8), held_at(1));
  EXPECT_LE(held_at(0.4), held_at(0.8) / 2) << "the time goes with the square of the step";
  EXPECT_EQ(held_at(0.2), 1);
  Scene contact = closing_net(12);
  for (Ring& ring : contact.rings) ring.joint = RingJoint::contact;
  EXPECT_EQ(steps_held(contact), 1);
}

TEST(HeldJoints, TheLongestThatIsAllowedIsStable) {
  for (const int elements : {6, 12, 26}) {
    SCOPED_TRACE(elements);
    Scene scene = closing_net(elements);
    const Preparation p = prepare(scene);
    scene.time.joint_steps = joint_steps(p.whole(), p.timeline.after(), 1, 1000);
    Simulation sim(scene, 1);
    run_until(sim, 0.4);
    EXPECT_LT(sim.summary().relative_residual, 0.01);
    ++scene.time.joint_steps;
    try {
      prepare(scene);
      ADD_FAILURE() << "not refused";
    } catch (const CaseError& error) {
      const std::string most = "the largest that works is " + std::to_string(scene.time.joint_steps - 1);
      EXPECT_NE(std::string(error.what()).find(most), std::string::npos) << error.what();
    }
  }
}

TEST(HeldJoints, TooManyAreRefusedWhereTheyAreGiven) {
  const auto file = std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "capture.toml";
  try {
    prepare(read_case(file, {{"rings.r.joint", "sliding"}, {"time.joint_steps", "1000"}}));
    ADD_FAILURE() << "not refused";
  } catch (const CaseError& error) {
    EXPECT_EQ(std::string(error.what()).find("--set time.joint_steps=1000: error: "), 0u) << error.what();
  }
}

TEST(HeldJoints, FarMoreIsNot) {
  Scene scene = closing_net(26);
  scene.time.joint_steps = 14;
  scene.time.allow_unstable = true;
  Simulation sim(scene, 1);
  EXPECT_THROW(run_until(sim, 0.1), NumericalError);
}

}  // namespace
