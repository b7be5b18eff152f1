// What the stage clock finds on few steps are shares of the time of all.
#include <gtest/gtest.h>

#include <numeric>

#include "plan/stage_clock.hpp"

namespace {

using namespace cinch;

TEST(StageClock, SharesOutTheTimeOfAllSteps) {
  StageSeconds sampled{};
  sampled[0] = 1, sampled[1] = 3;
  const StageSeconds seconds = share_out(sampled, 8);
  EXPECT_DOUBLE_EQ(seconds[0], 2);
  EXPECT_DOUBLE_EQ(seconds[1], 6);
  EXPECT_EQ(seconds[2], 0);
}

TEST(StageClock, GivesNothingWhereNoStepWasTimed) { EXPECT_EQ(share_out({}, 8), StageSeconds{}); }

TEST(StageClock, TimesOneStretchInSoMany) {
  StageSeconds seconds{};
  for (std::int64_t i = 1; i < std::int64_t{StageClock::timed_every}; ++i)
    StageClock(i, seconds).tick(StageId::contacts);
  EXPECT_EQ(seconds, StageSeconds{});
  StageClock clock(StageClock::timed_every, seconds);
  while (seconds == StageSeconds{}) clock.tick(StageId::contacts);
  EXPECT_GT(seconds[static_cast<std::size_t>(StageId::contacts)], 0);
}

// Joints that hold for 4 steps are evaluated in every fourth: all timed steps or none would be such.
TEST(StageClock, IsOutOfStepWithWhatHappensEveryFewSteps) {
  for (std::uint64_t every = 2; every <= 32; ++every) EXPECT_EQ(std::gcd(every, StageClock::timed_every), 1U);
}

}  // namespace
