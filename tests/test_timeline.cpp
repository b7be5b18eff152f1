// Steps before the closing time and from it on: when they are, how long, and what changing them costs.
#include <gtest/gtest.h>

#include <set>

#include "app/schedule.hpp"
#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "plan/simulation.hpp"
#include "support/pendulum.hpp"
#include "support/quick_cases.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

TEST(Timeline, OneLengthOfStepIsAPlainProduct) {
  for (const Timeline& timeline : {Timeline(1e-6 / 3), Timeline(1e-6 / 3, 1e-6 / 3, 1000)})
    for (const std::int64_t step : {0, 1, 999, 1000, 1001, 123456789}) {
      EXPECT_EQ(timeline.time_of(step), static_cast<double>(step) * (1e-6 / 3));
      EXPECT_EQ(timeline.step_at(timeline.time_of(step)), step);
    }
}

TEST(Timeline, GoesOnFromTheClosingStep) {
  const Timeline timeline(0.5, 0.125, 4);
  EXPECT_EQ(timeline.time_of(3), 1.5);
  EXPECT_EQ(timeline.time_of(4), 2);
  EXPECT_EQ(timeline.time_of(5), 2.125);
  EXPECT_EQ(timeline.time_of(12), 3);
  EXPECT_EQ(timeline.step_at(1.7), 3);
  EXPECT_EQ(timeline.step_at(2), 4);
  EXPECT_EQ(timeline.step_at(2.05), 4);
  EXPECT_EQ(timeline.step_at(2.07), 5);
  for (const std::int64_t step : {0, 3, 4, 5, 1000})
    EXPECT_EQ(timeline.step_at(timeline.time_of(step)), step);
  EXPECT_EQ(timeline.step_at(1e300), 9'000'000'000'000'000'000) << "no overflow";
}

TEST(Timeline, WhatIsDueAtIntervalsIsSoAtTheNearestSteps) {
  app::Schedule schedule(0.4, Timeline(0.5, 0.125, 2));
  std::vector<std::int64_t> due;
  for (std::int64_t step = 0; step <= 12; ++step)
    if (schedule.due(step)) due.push_back(step);
  EXPECT_EQ(due, (std::vector<std::int64_t>{0, 1, 2, 4, 7, 10}));  // 0, 0.5, 1, 1.25, 1.625, 2
}

TEST(Timeline, WhatIsDueAgainAndAgainWithinAStepIsSoOnce) {
  const Timeline timeline(0.5, 0.125, 2);
  const auto due_steps = [&](double interval) {
    app::Schedule schedule(interval, timeline);
    std::set<std::int64_t> due;
    for (std::int64_t step = 0; step <= 12; ++step)
      if (schedule.due(step)) due.insert(step);
    return due;
  };
  for (const double interval : {0.01, 0.1, 0.25, 0.7}) {
    std::set<std::int64_t> expected;
    for (int k = 0; timeline.step_at(k * interval) <= 12; ++k)
      expected.insert(timeline.step_at(k * interval));
    EXPECT_EQ(due_steps(interval), expected) << interval;
  }
  EXPECT_EQ(due_steps(1e-15).size(), 13u) << "more than can be counted one by one";
}

Scene capture_with(std::vector<Override> sets) {
  sets.insert(sets.begin(), {{"case.method", "sliding"}, {"time.step_s", "auto"}});
  return read_case(case_file({"capture", {}, 0}), sets);
}

// Closing threads of 240 elements allow less than half of what the net does.
TEST(Timeline, AutomaticStepsAreThoseOfWhatMovesThen) {
  const Preparation p = prepare(capture_with({}));
  ASSERT_EQ(p.phases.size(), 2u);
  EXPECT_GT(p.phases[0].bound.step, 2 * p.phases[1].bound.step);
  EXPECT_EQ(p.stable_step, p.phases[1].bound.step);
  for (const Phase& phase : p.phases) {
    EXPECT_LE(phase.plan.dt, 0.4 * phase.bound.step);
    EXPECT_GT(phase.plan.dt, 0.399 * phase.bound.step);
    EXPECT_NE(phase.limited_by.find("while " + phase.name), std::string::npos);
  }
  EXPECT_NEAR(p.timeline.time_of(p.closing_step), 1.5, p.timeline.before());
  EXPECT_NEAR(p.timeline.time_of(p.end_step), 2, p.timeline.after());
}

// A pendulum of one element could do with longer steps than its rows are apart.
Scene pendulum(double frames, double probes) {
  Scene scene = parse_case(pendulum_case("[time]\nend_s = 0.1\n" + falling, "1e6"), "pendulum.toml");
  scene.output.frame_interval = frames;
  scene.output.probe_interval = probes;
  return scene;
}

TEST(Timeline, AnAutomaticStepIsNoLongerThanProbesAreApart) {
  const auto step = [](double frames, double probes) {
    return prepare(pendulum(frames, probes)).timeline.after();
  };
  EXPECT_EQ(step(0.01, 0), 0.01);
  EXPECT_EQ(step(0.01, 1e-3), 0.01 / 10);
  EXPECT_EQ(step(0.02, 1e-4), 0.02 / 200) << "which divides to a little more than 200";
  EXPECT_EQ(step(0.01, 0.003), 0.01 / 4) << "which does not divide the frames' interval";
  EXPECT_EQ(step(0.01, 0.02), 0.01);
  EXPECT_EQ(step(0.2, 0.002), 0.2 / 100);
}

TEST(Timeline, EachRowThatIsAskedForHasAStepOfItsOwn) {
  const Timeline timeline = prepare(pendulum(0.01, 1e-3)).timeline;
  app::Schedule rows(1e-3, timeline);
  int count = 0;
  for (std::int64_t step = 0; step <= timeline.step_at(0.1); ++step) count += rows.due(step);
  EXPECT_EQ(count, 101);
}

TEST(Timeline, ACaseSaysHowLongStepsAreFromTheClosingTimeOn) {
  const Preparation own = prepare(capture_with({}));
  const auto steps_with = [](std::vector<Override> sets) {
    const Timeline timeline = prepare(capture_with(std::move(sets))).timeline;
    return std::pair(timeline.before(), timeline.after());
  };
  const double before = own.timeline.before(), bound = own.phases[1].bound.step;
  const auto [first, twice] = steps_with({{"closing.safety", "0.8"}});
  EXPECT_EQ(first, before);
  EXPECT_LE(twice, 0.8 * bound);
  EXPECT_GT(twice, 0.799 * bound);
  EXPECT_EQ(steps_with({{"closing.step_s", "3e-6"}}), std::pair(before, 3e-6));
  EXPECT_EQ(steps_with({{"time.step_s", "1e-6"}}), std::pair(1e-6, 1e-6));
  EXPECT_EQ(steps_with({{"time.step_s", "1e-6"}, {"closing.step_s", "auto"}}),
            std::pair(1e-6, own.timeline.after()));
  EXPECT_EQ(steps_with({{"time.step_s", "1e-6"}, {"closing.safety", "0.8"}}), std::pair(1e-6, twice))
      << "a safety asks for automatic steps";
  EXPECT_EQ(steps_with({{"time.step_s", "1e-6"}, {"closing.step_s", "2e-6"}, {"closing.time_s", "0"}}),
            std::pair(2e-6, 2e-6))
      << "what closes at once has the steps of closing";
}

std::string refusal(std::vector<Override> sets) {
  try {
    prepare(capture_with(std::move(sets)));
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Timeline, AStepAboveTheStableOneIsRefusedByItsKey) {
  const std::string closing = refusal({{"closing.step_s", "4e-6"}});
  EXPECT_NE(closing.find("closing.step_s = 4e-06 s is above the stable step, limited by element 1 of "
                         "thread.c_top (nodes 126 and 127) while closing; the largest step that works is 3."),
            std::string::npos)
      << closing;
  const std::string flight = refusal({{"time.step_s", "9e-6"}, {"closing.step_s", "auto"}});
  EXPECT_NE(flight.find("time.step_s = 9e-06 s is above the stable step"), std::string::npos) << flight;
  EXPECT_NE(flight.find("while deployment"), std::string::npos) << flight;
  const std::string both = refusal({{"time.step_s", "4e-6"}});
  EXPECT_NE(both.find("time.step_s = 4e-06 s is above the stable step"), std::string::npos)
      << "the key that the step comes from: " << both;
}

TEST(Timeline, LooksFramesAndEventsTellTheTime) {
  Simulation simulation(read(capture_in_two_steps()), 1);
  const double closing = 25 * 4e-6, later = closing + 3975 * 2.5e-6;
  simulation.advance_to(4000);
  EXPECT_DOUBLE_EQ(simulation.time(), later);
  EXPECT_EQ(simulation.look().time(), simulation.time());
  EXPECT_EQ(simulation.frame().time, simulation.time());
  EXPECT_DOUBLE_EQ(*simulation.result_model().closing_time, closing);
  const Summary summary = simulation.summary();
  EXPECT_EQ(summary.simulated_seconds, simulation.time());
  int separations = 0;
  for (const Event& event : summary.events) {
    if (event.kind != "separation") continue;
    EXPECT_DOUBLE_EQ(event.time, closing);
    ++separations;
  }
  EXPECT_EQ(separations, 4);
}

// Contacts are told by the time of the step or look that sees them first.
TEST(Timeline, ATouchBehindTheChangeOfStepsHasItsTime) {
  Case one = capture_in_two_steps();
  one.sets.push_back({"net.main.velocity_m_s", "[0, 0, 1]"});
  one.sets.push_back({"target.ball.center_m", "[0.05, 0, 0.1513]"});
  Simulation simulation(read(one), 1);
  const auto touch = [&] {
    for (const Event& event : simulation.summary().events)
      if (event.kind == "target_contact") return event.time;
    return -1.0;
  };
  while (touch() < 0 && simulation.step() < 4000) simulation.advance_to(simulation.step() + 1);
  ASSERT_GT(simulation.step(), 50) << "it touches after the closing time";
  EXPECT_EQ(touch(), simulation.preparation().timeline.time_of(simulation.step()));
}

// Short threads of fine elements pull at once, where a step of the flight is long: what they do in it has not
// happened.
TEST(Timeline, ThreadsAreLaidWithTheVelocitiesOfTheirCarriersWhateverTheSteps) {
  std::vector<Override> sets{{"closing.time_s", "0.3"}, {"closing.safety", "0.02"}};
  for (const char* thread : {"c_top", "c_right", "c_bottom", "c_left"})
    sets.push_back({std::string("thread.") + thread + ".length_m", "0.115"});  // the net is stowed: 4 % short
  for (const char* m : {"m1", "m2", "m3", "m4"})
    sets.push_back({std::string("mechanism.") + m + ".towing_length_m", "0.01"});
  Simulation simulation(capture_with(sets), 1);
  const Preparation& p = simulation.preparation();
  EXPECT_GT(p.timeline.before(), 20 * p.timeline.after());
  simulation.advance_to(p.closing_step);
  ASSERT_TRUE(simulation.closed_phase());
  const Look& look = simulation.look();
  double most = 0, pull = 0;
  for (const Lay& lay : p.assembly.lays) {
    const Vec3 carrier = (1 - lay.s) * look.velocity(lay.a) + lay.s * look.velocity(lay.b);
    if (lay.jump == Vec3::Zero()) most = std::max(most, (look.velocity(lay.node) - carrier).norm());
    pull = std::max(pull, look.gain(lay.node).norm() * p.timeline.before() / p.timeline.after());
  }
  EXPECT_GT(pull, 1) << "in a step of the flight they would gain m/s";
  EXPECT_LT(most, 0.05 * pull);
}

TEST(Timeline, WhereNothingClosesTheKeysOfClosingSayNothing) {
  Scene scene = read(ring_pull());
  scene.closing.step = 1;
  scene.closing.safety = 0.1;
  EXPECT_EQ(prepare(scene).timeline.after(), 1e-6);
}

// Gravity and the ball push between the two instants half a step back, too.
TEST(Timeline, MomentumIsKeptWhereStepsChange) {
  for (const char* step : {"1e-6", "3.7e-6"}) {
    SCOPED_TRACE(step);
    Case one = sliding_capture();
    one.sets.insert(one.sets.end(),
                    {{"gravity.acceleration_m_s2", "[0, 0, -9.81]"}, {"closing.step_s", step}});
    Simulation simulation(read(one), 1);
    simulation.advance_to(simulation.preparation().timeline.step_at(0.002));
    const Summary summary = simulation.summary();
    EXPECT_NE(summary.time_step, summary.closing_time_step);
    EXPECT_LT(summary.linear_momentum_drift, 1e-12);
  }
}

}  // namespace
