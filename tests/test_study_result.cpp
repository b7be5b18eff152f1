// What the study of error against run time makes of its runs.
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <set>

#include "../bench/problem/closing_masses.hpp"
#include "../bench/study_measure.hpp"

namespace {

using namespace cinch::study;

RunResult run(int elements, double error, double seconds, double uncertainty = 0) {
  RunResult result;
  result.setting.method = "sliding";
  result.setting.elements = elements;
  result.errors = {{"error", error}};
  result.uncertainties = {{"error", uncertainty}};
  result.seconds = seconds;
  return result;
}

TEST(StudyResult, WithinAnErrorForCertainCountsChanceAndReference) {
  const Problem problem;
  ProblemResult result{
      &problem, {{"error", 0.002}}, {run(6, 0.0085, 1), run(8, 0.007, 2, 0.002), run(12, 0.007, 3)}};
  EXPECT_EQ(best_within(result, 0.01), &result.runs[2]);
  result.reference_errors[0].second = 0.001;
  EXPECT_EQ(best_within(result, 0.01), &result.runs[0]);
  result.reference_errors[0].second = 0.004;
  EXPECT_EQ(best_within(result, 0.01), nullptr);
}

TEST(StudyResult, TheBestMayBeAskedToKeepItsEnergy) {
  const Problem problem;
  ProblemResult result{&problem, {}, {run(6, 0.005, 1), run(8, 0.005, 2), run(12, 0.005, 3)}};
  result.runs[0].residual = 2e-4, result.runs[1].residual = 1e-4;
  EXPECT_EQ(best_within(result, 0.01), &result.runs[0]);
  EXPECT_EQ(best_within(result, 0.01, small_residual), &result.runs[1]);
  EXPECT_EQ(best_within(result, 0.001, small_residual), nullptr);
}

TEST(StudyResult, WhereNoneIsWithinAnErrorItIsSaidWhy) {
  const Problem problem;
  ProblemResult result{&problem, {{"error", 0.002}}, {run(6, 0.02, 1), run(8, 0.009, 2, 0.004)}};
  EXPECT_EQ(why_none(result, 0.01),
            "the nearest is off by 0.9 %, by chance 0.4 % more, the reference by 0.2 %");
  EXPECT_EQ(why_none(result, 0.001), "the reference's own error of 0.2 % decides nothing so small");
  result.runs[0].residual = 1e-5, result.runs[1].residual = 1e-3;
  EXPECT_EQ(why_none(result, 0.01, small_residual), "the nearest is off by 2 %, the reference by 0.2 %");
  EXPECT_EQ(why_none(result, 0.01, 1e-9), "no run");
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
      {},
      {run(20, 0.04, 1), run(10, 0.16, 1), run(40, 0.01, 1), run(80, 0.02, 1), run(160, 1e-5, 1)}};
  const std::string series = result.runs[0].setting.series();
  EXPECT_NEAR(observed_order(result, series), 2, 1e-12);
  result.runs[2] = run(40, 0.05, 1);
  EXPECT_TRUE(std::isnan(observed_order(result, series))) << "two that fall make no order";
}

// A run whose only number is off by `apart` from the exact solution.
RunResult off_by(double step, double apart) {
  RunResult result = run(8, apart, 1);
  result.taken.step = step;
  result.apart = {{0}, {{apart}}};
  return result;
}

TEST(StudyResult, AnOrderInTheStepIsThatOfChanges) {
  Problem problem;
  problem.errors = [](const Track& a, const Track& b) { return Errors{{"error", greatest(a, b, 0, 1)}}; };
  ProblemResult result{&problem, {}, {}};
  for (const double step : {0.8, 0.4, 0.1, 0.2})  // what elements make of it stays
    result.runs.push_back(off_by(step, 0.3 - 0.1 * step * step));
  EXPECT_TRUE(step_orders(result).empty()) << "without an exact solution";
  problem.exact = [](double) { return std::vector<double>{0}; };
  ASSERT_EQ(step_orders(result).count("sliding, 8 elements"), 1u);
  EXPECT_NEAR(step_orders(result)["sliding, 8 elements"], 2, 1e-9);
  result.runs[0].apart.samples[0][0] = 0.29;
  EXPECT_TRUE(step_orders(result).empty()) << "chance";
  result.runs.erase(result.runs.begin());
  EXPECT_TRUE(step_orders(result).empty()) << "three tell nothing of chance";
}

TEST(StudyResult, RunsOfAReferenceBeginLikeNoOthers) {
  const Problem weight = weight_on_a_thread(Extent::trial);
  Problem problem;
  problem.end = 0.001, problem.samples = 1;
  problem.scene = weight.scene, problem.sample = weight.sample, problem.errors = weight.errors;
  std::mutex lock;
  std::multiset<int> begun;
  problem.perturb = [&](cinch::Scene&, int run) {
    const std::lock_guard guard(lock);
    begun.insert(run);
  };
  Setting setting{"threads", 4, 0, 0.4};
  setting.runs = 3;
  problem.settings = {setting};
  problem.reference = {setting, setting};
  const Reference reference = reference_of(problem);
  EXPECT_EQ(begun, (std::multiset<int>{3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(reference.errors.size(), 1u);
  begun.clear();
  const RunResult found = run(problem, setting, reference.track);
  EXPECT_EQ(begun, (std::multiset<int>{0, 1, 2}));
  EXPECT_EQ(found.uncertainties.size(), found.errors.size());
  EXPECT_NEAR(found.taken.fraction, 0.4, 1e-12);
}

TEST(StudyResult, EachOfThePapersRulesCanStandAlone) {
  using namespace cinch;
  const auto rules = [](const char* method) {
    const Contact found = ring_pull(Extent::trial).scene({method, 50, 1e-6}).contact;
    return std::tuple(found.distance == DistanceMethod::golden, found.couple == RingCouple::paper,
                      found.shared_node == SharedNode::paper);
  };
  EXPECT_EQ(rules("contact"), std::tuple(false, false, false));
  EXPECT_EQ(rules(papers_distance), std::tuple(true, false, false));
  EXPECT_EQ(rules(papers_couple), std::tuple(false, true, false));
  EXPECT_EQ(rules(papers_nodes), std::tuple(false, false, true));
  EXPECT_EQ(rules(papers_rules), std::tuple(true, true, true));
}

TEST(StudyResult, AnotherDampingIsAnotherProblem) {
  const Problem problem = damped_ring_pull(Extent::trial, 0.5);
  EXPECT_EQ(problem.name, "ring_pull_damped_0.5");
  EXPECT_EQ(problem.scene({"sliding", 6, 0, 0.4}).materials.at("thread").damping_ratio, 0.5);
}

double value_of(const Errors& errors, const std::string& name) {
  for (const auto& [measure, value] : errors)
    if (measure == name) return value;
  return NAN;
}

// Samples at 0.1 s, the closing time, and at 0.2 and 0.3 s.
TEST(StudyResult, VelocitiesCountFromTheClosingTimeOnAndAnyMassesPlace) {
  Track right{{0.1, 0.2, 0.3}, std::vector(3, std::vector<double>(closing_numbers, 1.0))}, found = right;
  const std::size_t last_mass = 1 + 3 * 7, its_velocity = last_mass + 3 * 8;
  found.samples[0][its_velocity] += 1;
  EXPECT_EQ(value_of(errors_of_closing(found, right, 0.1), "split_mass_velocity"), 0);
  found.samples[1][its_velocity] += 0.4;
  found.samples[1][last_mass] += 0.03;
  found.samples[2].back() = 1.2;
  const Errors errors = errors_of_closing(found, right, 0.1);
  const double separation = 2 * std::sqrt(2.0);
  EXPECT_NEAR(value_of(errors, "split_mass_velocity"), 0.4 / 4 / separation, 1e-12) << "of 16 in all";
  EXPECT_NEAR(value_of(errors, "split_mass_velocity_greatest"), 0.4 / separation, 1e-12);
  EXPECT_NEAR(value_of(errors, "split_mass_path"), 0.03, 1e-12);
  EXPECT_NEAR(value_of(errors, "ring_force"), 0.2, 1e-12);
  EXPECT_EQ(value_of(errors, "error"), value_of(errors, "split_mass_path"));
}

}  // namespace
