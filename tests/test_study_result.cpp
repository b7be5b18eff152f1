// What the study of error against run time makes of its runs.
#include <gtest/gtest.h>

#include <cmath>

#include "../bench/study_result.hpp"

namespace {

using namespace cinch::study;

RunResult run(int elements, double error, double seconds, double uncertainty = 0) {
  RunResult result;
  result.setting.method = "sliding";
  result.setting.elements = elements;
  result.errors = {{"error", error}, {"uncertainty", uncertainty}};
  result.seconds = seconds;
  return result;
}

TEST(StudyResult, WithinAnErrorForCertainCountsChanceAndReference) {
  const Problem problem;
  ProblemResult result{&problem, 0.002, {run(6, 0.0085, 1), run(8, 0.007, 2, 0.002), run(12, 0.007, 3)}};
  EXPECT_EQ(best_within(result, 0.01), &result.runs[2]);
  result.reference_error = 0.001;
  EXPECT_EQ(best_within(result, 0.01), &result.runs[0]);
  result.reference_error = 0.004;
  EXPECT_EQ(best_within(result, 0.01), nullptr);
}

TEST(StudyResult, TheBestMayBeAskedToKeepItsEnergy) {
  const Problem problem;
  ProblemResult result{&problem, 0, {run(6, 0.005, 1), run(8, 0.005, 2), run(12, 0.005, 3)}};
  result.runs[0].residual = 2e-4, result.runs[1].residual = 1e-4;
  EXPECT_EQ(best_within(result, 0.01), &result.runs[0]);
  EXPECT_EQ(best_within(result, 0.01, small_residual), &result.runs[1]);
  EXPECT_EQ(best_within(result, 0.001, small_residual), nullptr);
}

TEST(StudyResult, ASeriesTellsBothSteps) {
  Setting setting{"sliding", 8, 0, 0.4, false, 6, 128, 0.8};
  EXPECT_EQ(setting.series(), "sliding, 0.4, then 0.8 of the stable step, forces held for 6 steps");
  setting.closing_fraction = 0;
  EXPECT_EQ(setting.series(), "sliding, 0.4 of the stable step, forces held for 6 steps");
}

TEST(StudyResult, ASettingsStepsAreTheScenes) {
  const Problem problem = capture(Extent::trial);
  const auto shares = [&](const Setting& setting) {
    const cinch::Preparation p = prepare(problem.scene(setting));
    return std::pair(p.phases[0].plan.dt / p.phases[0].bound.step,
                     p.phases[1].plan.dt / p.phases[1].bound.step);
  };
  const auto [flight, closing] = shares({"sliding", 8, 0, 0.4, false, 1, 1, 0.8});
  EXPECT_NEAR(flight, 0.4, 1e-12);
  EXPECT_NEAR(closing, 0.8, 1e-12);
  EXPECT_NEAR(shares({"sliding", 8, 0, 0.3, false, 1, 1}).second, 0.3, 1e-12);
}

TEST(StudyResult, AMeanIsNearerThanWhatItIsOf) {
  EXPECT_DOUBLE_EQ(error_of_mean(0.3, 10), 0.1);
  EXPECT_EQ(error_of_mean(0.3, 2), 0.3);
  EXPECT_EQ(error_of_mean(0.3, 1), 0.3) << "of one nothing is known";
}

TEST(StudyResult, AnOrderIsThatOfErrorsThatFall) {
  const Problem problem;
  ProblemResult result{
      &problem,
      0,
      {run(20, 0.04, 1), run(10, 0.16, 1), run(40, 0.01, 1), run(80, 0.02, 1), run(160, 1e-5, 1)}};
  const std::string series = result.runs[0].setting.series();
  EXPECT_NEAR(observed_order(result, series), 2, 1e-12);
  result.runs[2] = run(40, 0.05, 1);
  EXPECT_TRUE(std::isnan(observed_order(result, series))) << "two that fall make no order";
}

}  // namespace
