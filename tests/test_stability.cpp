// The stability matrix' quick cells: none may end in garbage that nobody is told of. And that the matrix
// itself sees garbage, told by scenes that make some.
#include <gtest/gtest.h>
#include <signal.h>

#include "../bench/matrix/groups.hpp"
#include "../bench/matrix/isolated.hpp"
#include "../bench/matrix/motion_scenes.hpp"
#include "../bench/matrix/search.hpp"
#include "../bench/matrix/spectrum.hpp"
#include "../bench/matrix/watch.hpp"
#include "plan/stable_step.hpp"

namespace {

using namespace cinch;
using namespace cinch::matrix;

// ---- the cells

void expect_no_garbage(std::vector<Cell> (*group)(Extent), std::size_t least) {
  const std::vector<Cell> cells = group(Extent::quick);
  EXPECT_GE(cells.size(), least);
  for (const Cell& cell : cells) {
    const Outcome outcome = judge(cell);
    EXPECT_NE(words(outcome.verdict), "FAILED")
        << cell.group << ": " << cell.parameter << ": " << cell.value << ": " << outcome.message;
  }
}

TEST(Stability, StiffThingsHoldWithTheAutomaticStep) { expect_no_garbage(stiffness, 100); }
TEST(Stability, SlackAndTautThreadsHoldOrAreStopped) { expect_no_garbage(slack, 30); }
TEST(Stability, TheStableStepIsSharpAndNeverOptimistic) { expect_no_garbage(matrix::step, 50); }
TEST(Stability, HardAndAwkwardMotionHoldsOrIsStopped) { expect_no_garbage(motion, 70); }
TEST(Stability, ThreadsGiveTheSameBits) { expect_no_garbage(threads, 10); }

// ---- the messages of what is stopped

std::string message_of(const SceneMaker& make, const Watch& how) {
  const Outcome outcome = watch(make, how);
  EXPECT_EQ(words(outcome.verdict), "stopped") << outcome.message;
  return outcome.message;
}

void expect_pieces(const std::string& message, std::initializer_list<const char*> pieces) {
  for (const char* piece : pieces)
    EXPECT_NE(message.find(piece), std::string::npos) << piece << " in: " << message;
}

TEST(StoppedCell, TellsTheElementAndTheRingOfAnImpact) {
  expect_pieces(message_of([] { return thread_in_ring(500); }, {1000, 1}),
                {"at t = ", "the contact of element ", "of thread.main", "with ring 'r'",
                 "likely cause: an impact too hard"});
}

TEST(StoppedCell, TellsTheElementAndTheBallOfAnImpact) {
  expect_pieces(message_of([] { return thread_on_ball(500); }, {1000, 1}),
                {"at t = ", "the contact of element ", "of thread.main", "with target 'ball'"});
}

TEST(StoppedCell, TellsTheNodeOfAGrowingChain) {
  const auto growing = [] {
    Scene scene = at_fraction(tense_chain(40, 0), 1.01);
    scene.time.speed_limit = 6;
    return scene;
  };
  expect_pieces(message_of(growing, {20000, 1}),
                {"at t = ", "s node ", "of thread.main at (", "moves at ", "the time step ",
                 "is too large (stable step ", "limited by element "});
}

TEST(StoppedCell, TellsTheNodeWithoutASpeed) {
  const auto broken = [] {
    Scene scene = tense_chain(40, 0);
    scene.threads[0].nodes[3].velocity = Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    return scene;
  };
  expect_pieces(message_of(broken, {10, 1}), {"at t = ", "s node 3 of thread.main at (", "moves at nan m/s"});
}

TEST(StoppedCell, TellsTheEndThatIsDrawnIntoARing) {
  expect_pieces(message_of([] { return end_into_ring(0, 0.5); }, {20000, 400}),
                {"at t = ", "J have come from nowhere",
                 "likely cause: node 10 of thread.main is drawn to ring 'r'", "give it a mass"});
}

TEST(StoppedCell, TellsTheElementThatLimitsAStepInACaseThatRefusesIt) {
  const auto above = [] {
    Scene scene = at_fraction(tense_chain(40, 0), 1.01);
    scene.time.allow_unstable = false;
    return scene;
  };
  expect_pieces(message_of(above, {}), {"time.step_s = ", "is above the stable step", "of thread.main"});
}

TEST(PressedNet, HoldsHoweverItsContactsCount) {
  for (const SharedNode rule : {SharedNode::once, SharedNode::paper})
    for (const double alpha : {0.0, 0.05}) {
      const auto make = [=] {
        Scene scene = net_on_ball(1e5, 1, alpha);
        scene.contact.shared_node = rule;
        return scene;
      };
      const Outcome outcome = watch(make, {4000, 40});
      EXPECT_EQ(words(outcome.verdict), "held") << outcome.message;
    }
}

// ---- the matrix sees garbage

TEST(Watch, SeesEnergyThatNobodyIsToldOf) {  // no limit of speed, no check of energy
  const Outcome outcome = watch([] { return at_fraction(tense_chain(40, 0), 1.05); }, {200, 20});
  EXPECT_EQ(words(outcome.verdict), "FAILED");
  EXPECT_NE(outcome.message.find("energy grew by "), std::string::npos) << outcome.message;
}

TEST(Watch, WantsItemTimeAndCauseInAMessage) {
  EXPECT_EQ(flaw_of_message("error: at t = 1 s node 3 of thread.a runs; likely cause: wind"), "");
  EXPECT_EQ(flaw_of_message("error: node 3 of thread.a runs; likely cause: wind"), "no time");
  EXPECT_EQ(flaw_of_message("error: at t = 1 s it runs; likely cause: wind"), "no item");
  EXPECT_EQ(flaw_of_message("error: at t = 1 s node 3 of thread.a runs"), "no cause");
}

Cell cell_of(Must must, const Outcome& outcome) {
  Cell cell("g", "p", "v", must, [=] { return outcome; });
  cell.names = {"thread.a"};
  cell.most_residual = 0.01;
  return cell;
}

TEST(Verdict, IsHeldAgainstWhatTheCellMust) {
  const Outcome held{Verdict::held, 0.001, 1, ""}, loose{Verdict::held, 0.02, 1, ""};
  const Outcome named{Verdict::stopped, 0, 1, "node 1 of thread.a"},
      nameless{Verdict::stopped, 0, 1, "node 1"};
  const auto verdict = [](Must must, const Outcome& outcome) {
    return words(judge(cell_of(must, outcome)).verdict);
  };
  EXPECT_EQ(verdict(Must::hold, held), "held");
  EXPECT_EQ(verdict(Must::either, held), "held");
  EXPECT_EQ(verdict(Must::stop, held), "FAILED");
  EXPECT_EQ(verdict(Must::hold, loose), "FAILED");
  EXPECT_EQ(verdict(Must::stop, named), "stopped");
  EXPECT_EQ(verdict(Must::either, nameless), "FAILED");
  EXPECT_EQ(verdict(Must::hold, named), "FAILED");
}

TEST(Isolated, ACrashAHangAndAnErrorAreFailures) {
  const Outcome fine{Verdict::held, 0.5, 7, "a \"word\""};
  const Outcome back = isolated([&] { return fine; }, 60);
  EXPECT_EQ(back.verdict, fine.verdict);
  EXPECT_EQ(back.residual, fine.residual);
  EXPECT_EQ(back.steps, fine.steps);
  EXPECT_EQ(back.message, fine.message);
  EXPECT_EQ(isolated(
                [&] {
                  raise(SIGKILL);
                  return fine;
                },
                60)
                .message,
            "crashed by signal 9");
  EXPECT_EQ(isolated(
                [&]() -> Outcome {
                  for (;;) pause();
                },
                1)
                .message,
            "not done after 1 s");
  EXPECT_EQ(isolated([&]() -> Outcome { throw std::runtime_error("odd"); }, 60).verdict, Verdict::failed);
}

// ---- eigenvalues

TEST(Spectrum, OfTwoMassesOnASpringIsTheTextbooks) {
  Model model;
  model.nodes = 2;
  model.mass = {1, 3};
  model.end_a = {0}, model.end_b = {1};
  model.stiffness = {100}, model.damping = {2}, model.rest_length = {1};
  model.elements = 1;
  const std::vector<Vec3> place{Vec3::Zero(), Vec3(0.6, 0, 0.8)};
  const double step = 0.01, expected = (step * step / 4 * 100 + step / 2 * 2) * (1 + 1.0 / 3);
  EXPECT_NEAR(largest_usage(model, place, step), expected, 1e-14);
  EXPECT_NEAR(critical_step(model, place) / stable_step(model).step, 1,
              1e-9);  // one element: the bound is exact
  model.constraints.push_back({1, 0, 0, 0, 3});
  EXPECT_NEAR(largest_usage(model, place, step), expected / (1 + 1.0 / 3), 1e-14);
}

TEST(Spectrum, TensionStiffensAcross) {
  Model model;
  model.nodes = 2;
  model.mass = {1, 1};
  model.end_a = {0}, model.end_b = {1};
  model.stiffness = {100}, model.damping = {0}, model.rest_length = {1};
  model.elements = 1;
  model.constraints = {{0, 0, 0, 0, 1},
                       {1, 0, 1, 0, 1}};  // guided across the element, stretched to twice its length
  EXPECT_NEAR(largest_usage(model, {Vec3::Zero(), Vec3(2, 0, 0)}, 0.1), 0.01 / 4 * 100 / 2, 1e-14);
}

TEST(Search, FindsNothingButComesClose) {
  const Found found = search(Family::chain, 300);
  EXPECT_EQ(found.trials, 300);
  EXPECT_EQ(found.counter_examples, 0);
  EXPECT_GT(found.worst, 0.99);
}

}  // namespace
