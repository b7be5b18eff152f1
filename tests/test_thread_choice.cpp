// How many threads step a scene: what is measured decides, against machines with given paces.
#include <gtest/gtest.h>

#include <functional>

#include "plan/thread_choice.hpp"

namespace {

using namespace cinch;
using Pace = std::function<double(int threads)>;  // s a step

constexpr double changing_over = 2e-3;  // s

// Steps for so many seconds of a machine's time; returns how many steps were done.
double step_on(ThreadChoice& choice, const Pace& pace, double seconds, bool flown = false) {
  double spent = 0, steps = 0;
  int last = choice.threads();
  while (spent < seconds) {
    const int threads = choice.threads();
    const std::int64_t stretch = choice.steps(4096);
    const double took = static_cast<double>(stretch) * pace(threads) + (threads != last ? changing_over : 0);
    choice.note(stretch, took, flown);
    last = threads;
    spent += took, steps += static_cast<double>(stretch);
  }
  return steps;
}

// Cores 0 and 1 share a cache, and so on: 4 threads are best.
double four_are_best(int threads) {
  return threads == 1 ? 3e-6 : threads == 2 ? 2e-6 : threads == 4 ? 1.5e-6 : 4e-6;
}
double one_is_best(int threads) { return threads == 1 ? 3e-6 : 40e-6; }

TEST(ThreadChoice, TakesWhatIsFastest) {
  ThreadChoice choice(1, 16);
  step_on(choice, four_are_best, 1);
  EXPECT_NEAR(step_on(choice, four_are_best, 10) * 1.5e-6, 10, 0.5);
}

TEST(ThreadChoice, ComesDownToWhatIsFastest) {
  ThreadChoice choice(16, 16);
  step_on(
      choice, [](int threads) { return threads == 16 ? 9e-6 : four_are_best(threads); }, 3);
  EXPECT_NEAR(step_on(choice, four_are_best, 10) * 1.5e-6, 10, 0.5);
}

TEST(ThreadChoice, LosesLittleWhereOneIsBest) {
  ThreadChoice choice(1, 2);
  EXPECT_GT(step_on(choice, one_is_best, 1) * 3e-6, 0.93) << "whatever a run lasts";
  EXPECT_GT(step_on(choice, one_is_best, 100) * 3e-6, 99);
}

TEST(ThreadChoice, ComesBackWhenTheMachineIsBusy) {
  ThreadChoice choice(1, 2);
  const auto idle = [](int threads) { return threads == 1 ? 3e-6 : 1.6e-6; };
  step_on(choice, idle, 5);
  EXPECT_NEAR(step_on(choice, idle, 5) * 1.6e-6, 5, 0.3);
  step_on(choice, one_is_best, 20);
  EXPECT_GT(step_on(choice, one_is_best, 10) * 3e-6, 9);
}

TEST(ThreadChoice, SmallDifferencesChangeNothing) {
  ThreadChoice choice(2, 4);
  step_on(
      choice, [](int threads) { return threads == 2 ? 2.05e-6 : 2e-6; }, 1);
  EXPECT_EQ(choice.threads(), 2);
}

TEST(ThreadChoice, FreeFlightSaysNothing) {
  ThreadChoice choice(1, 2);
  step_on(choice, four_are_best, 1);
  EXPECT_EQ(choice.threads(), 2);
  choice.note(1000, 1e-5, true);
  EXPECT_EQ(choice.threads(), 1) << "what it began with";
  step_on(choice, four_are_best, 1, true);
  EXPECT_EQ(choice.threads(), 1);
}

TEST(ThreadChoice, TriesNothingWithoutAChoice) {
  ThreadChoice choice(3, 1);
  EXPECT_EQ(choice.steps(4096), 4096);
  step_on(choice, four_are_best, 1);
  EXPECT_EQ(choice.threads(), 3);
  EXPECT_FALSE(ThreadChoice::worth_it(500));
  EXPECT_TRUE(ThreadChoice::worth_it(1184)) << "capture while it closes";
  EXPECT_FALSE(ThreadChoice::worth_it(2'000'000));
}

}  // namespace
