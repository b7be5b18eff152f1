// The law of one element where it turns taut or slack, and what its damper's power is booked as.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "kernels/axial_law.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

using namespace test;

constexpr double stiffness = 1000, rest_length = 1, mass = 0.1;  // N/m, m, kg; the other end is held

struct Outcome {
  double energy, dissipated;  // after turning taut and slack again, J
};

enum class Law { full, same_rate, none };  // `same_rate`: as if the pull did not change the rate

// A mass flies away from the held end at 1 m/s, along the element, and comes back; `phase`: share of a step
// that it starts later. The steps are those of the solver.
Outcome bounce(Law law, double damping, double dt, double phase) {
  const double give = law == Law::full ? dt * dt / mass : 0;
  double x = rest_length - (1 + phase) * dt, v = 1, dissipated = 0, before = 0;
  bool was_taut = false;
  for (;;) {
    const auto pull = law == Law::none ? plain::axial_law<false> : plain::axial_law<true>;
    const plain::Axial item = pull(x * x, x * v, stiffness, damping, rest_length, dt, give);
    dissipated += dt * 0.5 * (item.damper + before) * item.rate;
    before = item.damper;
    v -= dt / mass * item.tension;
    x += dt * v;
    was_taut = was_taut || item.energy > 0;
    if (was_taut && x < rest_length && before == 0) return {0.5 * mass * v * v, dissipated};
  }
}

// Mean square of the share of energy that a bounce wins or loses.
double wins(Law law, double damping, double dt) {
  double sum = 0;
  for (double phase = 0.005; phase < 1; phase += 0.01) {
    const Outcome after = bounce(law, damping, dt, phase);
    const double error = (after.energy + after.dissipated) / (0.5 * mass) - 1;
    sum += 0.01 * error * error;
  }
  return std::sqrt(sum);
}

// Alone, an element pulls at its own rate only, and the rule is exact as long as it turns slack within the
// 5/4 steps that it looks ahead.
TEST(AxialLaw, ABounceWinsAndLosesNoEnergy) {
  const double omega = std::sqrt(stiffness / mass);
  for (const double step : {0.02, 0.05, 0.1, 0.2}) EXPECT_LT(wins(Law::full, 0, step / omega), 1e-12) << step;
  for (const double damping : {0.0, 0.2 * mass * omega, 2 * mass * omega})
    for (const double step : {0.05, 0.1, 0.5}) {
      SCOPED_TRACE(testing::Message() << damping << " " << step);
      const double full = wins(Law::full, damping, step / omega);
      const double same_rate = wins(Law::same_rate, damping, step / omega);
      EXPECT_LT(full, 0.2 * same_rate) << "what the pull does to the rate";
      EXPECT_LT(full, 0.1 * wins(Law::none, damping, step / omega)) << "what the law is for";
    }
}

// Of what a mass had, a bounce leaves exp(-2 zeta (pi - 2 asin zeta) / sqrt(1 - zeta^2)): a half period less
// the time in which the damper holds the spring.
double left_by_a_bounce(double zeta) {
  return std::exp(-2 * zeta * (std::numbers::pi - 2 * std::asin(zeta)) / std::sqrt(1 - zeta * zeta));
}

// However late in a step it begins. Greatest error over the phases, in a step of so much over omega.
double bounce_error(double zeta, double step) {
  const double omega = std::sqrt(stiffness / mass);
  double worst = 0;
  for (double phase = 0.005; phase < 1; phase += 0.01) {
    const double left = bounce(Law::full, 2 * zeta * mass * omega, step / omega, phase).energy / (0.5 * mass);
    worst = std::max(worst, std::abs(left - left_by_a_bounce(zeta)));
  }
  return worst;
}

// With a damper that pulls with c dl/dt as soon as there is stretch, three times as much.
TEST(AxialLaw, ABounceLosesWhatItShouldWheneverItBegins) {
  for (const double zeta : {0.05, 0.106, 0.3}) {
    SCOPED_TRACE(zeta);
    EXPECT_LT(bounce_error(zeta, 0.14), 0.006);
    EXPECT_LT(bounce_error(zeta, 0.28), 0.015);
  }
}

// A damper that would take more than the whole rate in a step takes the rate.
TEST(AxialLaw, ADamperDoesNotTurnTheRateRound) {
  const double dt = 1e-3, rate = 3, give = dt * dt / mass, change = rate * dt, l = 1 + 0.9 * change;
  for (const double damping : {10.0, 60.0, 90.0, 150.0}) {
    const plain::Axial item = plain::axial_law(l * l, l * rate, 0, damping, rest_length, dt, give);
    const double share = give * item.tension / change;  // that is taken
    EXPECT_NEAR(share, std::max(damping * dt / mass, std::min(1.0, 1.4 * damping * dt / mass)), 1e-12);
  }
}

TEST(AxialLaw, IsThatOfTheSpringAwayFromTheSwitch) {
  const double l = 1.01, rate = 3;
  const plain::Axial near = plain::axial_law(l * l, l * rate, stiffness, 2, rest_length, 1e-3, 2e-6);
  const plain::Axial far = plain::axial_law<false>(l * l, l * rate, stiffness, 2, rest_length, 1e-3, 2e-6);
  EXPECT_EQ(near.tension, far.tension);
  EXPECT_GT(near.spare, 0);
  EXPECT_NEAR(near.tension, stiffness * 0.01 + 2 * rate, 1e-9);
  EXPECT_NEAR(near.energy, 0.5 * stiffness * 0.01 * 0.01, 1e-12);
}

TEST(AxialLaw, HasNoJumpWhereTheSwitchBegins) {
  const double l = 1.001, dt = 1e-3;
  for (const double give : {0.0, 2e-4, 1e-3, 3e-3})
    for (const double damping : {0.0, 0.2, 5.0}) {
      const auto spring = [&](double rate) {
        const plain::Axial item =
            plain::axial_law(l * l, l * rate, stiffness, damping, rest_length, dt, give);
        return item.tension - item.damper;
      };
      const auto drag = [&](double rate) {  // jumps, as the force before the switch does
        return plain::drag_at_switch(l - rest_length, rate * dt, damping * rate, give);
      };
      for (double rate = -3; rate < 3; rate += 1e-3)
        EXPECT_NEAR(spring(rate + 1e-6), spring(rate - 1e-6),
                    5e-5 + std::abs(drag(rate + 1e-6) - drag(rate - 1e-6)))
            << rate << " " << give << " " << damping;
    }
  for (const double sign : {-1.0, 1.0})
    EXPECT_NEAR(plain::axial_law(l * l, l * sign * 1e9, stiffness, 0, rest_length, dt, 0).tension,
                0.5 * stiffness * 0.001, 1e-5);
}

TEST(AxialLaw, SlackElementsPullAtNothing) {
  for (const double l : {0.0, 0.5, 1.0}) {
    const plain::Axial item = plain::axial_law(l * l, l * -2, stiffness, 5, rest_length, 1e-3, 2e-6);
    EXPECT_EQ(item.tension, 0);
    EXPECT_EQ(item.damper, 0);
    EXPECT_EQ(item.energy, 0);
    EXPECT_TRUE(std::isfinite(item.rate));
  }
}

// ---- whole scenes

// Two masses that fly apart, a single element between them: a link, no run.
TEST(AxialLaw, TwoMassesOnAnElementKeepTheirEnergy) {
  Scene scene = thread_scene(1e7, 0, R"(
elements = 1
length_m = 1
points_m = [[0, 0, 0], [0.99, 0, 0]]
start = { mass_kg = 0.1, velocity_m_s = [-1, 0, 0] }
end = { mass_kg = 0.03, velocity_m_s = [1, 0, 0] }
)");
  scene.time.step = 0;
  const double stable = prepare(scene).stable_step;
  for (const double part : {0.05, 0.12, 0.2}) {
    scene.time.step = part * stable;
    Simulation simulation(scene, 1);
    ASSERT_EQ(simulation.model().topology.links.size(), 1u);
    const double per_gain = simulation.model().mass[1] / simulation.preparation().timeline.after();
    while (simulation.time() < 0.05) {  // a look tells the tension that moves the masses
      simulation.advance_to(simulation.step() + 1);
      const Look& look = simulation.look();
      ASSERT_NEAR(look.pull(0).tension, look.gain(1).norm() * per_gain, 1e-9) << part << " " << look.time();
    }
    run_until(simulation, 0.2);
    EXPECT_LT(std::abs(simulation.summary().energy.residual), 1e-12) << part;
    EXPECT_LT(simulation.look().velocity(1).x(), -0.5) << "it must have bounced";
  }
}

// Central differences alone win 70 % here.
TEST(AxialLaw, AnUndampedThreadThatSlackensKeepsItsEnergy) {
  Simulation simulation(slackening_thread(6.2e-6), 1);
  EXPECT_NEAR(simulation.preparation().timeline.after() / simulation.preparation().stable_step, 0.4, 0.01);
  run_until(simulation, 2);
  EXPECT_LT(simulation.summary().relative_residual, 2e-4);
}

// The threads of the capture's net turn taut thousands of times as it flies, at any moment of a step. Where
// what a jerk takes hangs on that, chance adds up: steps of 0.4 of the stable one lost 0.013 m^2 of the mouth
// at 1 s.
TEST(AxialLaw, ANetFliesAlikeInStepsOfAnyLength) {
  const Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "capture.toml");
  constexpr int runs = 8;
  const auto mean_area = [&](double step) {  // m^2
    double sum = 0;
    for (int run = 0; run < runs; ++run) {
      Scene one = scene;
      one.time.step = step;
      for (Mechanism& mechanism : one.mechanisms) mechanism.launch_velocity *= 1 + 1e-4 * run;
      Simulation simulation(one, 1);
      run_until(simulation, 1);
      sum += mouth_area(simulation.look().ring_centers());
    }
    return sum / runs;
  };
  EXPECT_NEAR(mean_area(3.4e-6), mean_area(1.1e-6), 0.004);
}

// The net of the capture flies out, its threads slack and taut by turns.
TEST(AxialLaw, TheLedgerOfADampedNetCloses) {
  Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "capture.toml");
  scene.time.step = 3e-6;
  Simulation simulation(scene, 1);
  run_until(simulation, 0.5);
  const Summary summary = simulation.summary();
  EXPECT_GT(summary.energy.dissipated_damper, 0.05 * summary.energy.kinetic);
  EXPECT_LT(summary.relative_residual, 3e-4);
}

}  // namespace
}  // namespace cinch
