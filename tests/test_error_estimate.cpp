// `cinch check --error`: what finer runs tell is not less than the true error, and not by chance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "scene/finer_threads.hpp"
#include "study/error_estimate.hpp"
#include "study/picture.hpp"
#include "study/run_track.hpp"
#include "support/pendulum.hpp"
#include "support/quick_cases.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

constexpr auto quietly = [](const std::string&) {};

// A mass thrown aside on a heavy thread that is as heavy; the thread waves.
Scene waving_thread(int elements) {
  Scene scene = scene_of(R"(schema = 1
[time]
end_s = 0.2
[output]
probe_interval_s = 0.002
[material.m]
youngs_modulus_Pa = 1e7
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.004
elements = 8
points_m = [[0, 0, 0], [0.5, 0, 0]]
length_m = 0.49
start = { support = "fixed" }
end = { mass_kg = 0.006, velocity_m_s = [0, 2, 0] }
[probe.end]
quantity = "position"
of = "thread.main.end"
[probe.middle]
quantity = "position"
of = "thread.main.node.4"
[probe.pull]
quantity = "tension"
of = "thread.main"
[probe.energy]
quantity = "energy"
)");
  return finer_threads(scene, elements / 8);
}

// As long as it remembers how it began.
Scene briefly_waving_thread() {
  Scene scene = waving_thread(8);
  scene.time.end = 0.004;
  return scene;
}

const ErrorEstimate::Row& row_of(const ErrorEstimate& estimate, const std::string& name) {
  for (const ErrorEstimate::Row& row : estimate.rows)
    if (row.name == name) return row;
  throw std::runtime_error("no row " + name);
}

// Greatest distance over time of the place in three columns.
double apart(const RunTrack& a, const RunTrack& b, std::size_t column) {
  double most = 0;
  for (std::size_t s = 0; s < a.probes.size(); ++s) {
    const auto off = [&](std::size_t d) { return a.probes[s][column + d] - b.probes[s][column + d]; };
    most = std::max(most, std::hypot(off(0), off(1), off(2)));
  }
  return most;
}

// ---- finer threads

TEST(FinerThreads, KeepWhatHasAName) {
  const Scene coarse = scene_of(R"(schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.002
elements = 6
points_m = [[0, 0, 0], [0.5, 0, 0], [0.5, 0.1, 0]]
[thread.main.node.4]
mass_kg = 0.3
[thread.branch]
material = "m"
diameter_m = 0.002
elements = 2
points_m = [[0.4, 0, 0], [0.4, 0, 1]]
start = { on = "thread.main.node.4" }
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.1
youngs_modulus_Pa = 70e9
on = "thread.branch"
element = 1
threads = ["main"]
[probe.p]
quantity = "position"
of = "thread.main.node.4"
)");
  const Scene fine = finer_threads(coarse, 3);
  EXPECT_EQ(fine.threads[0].elements, 18);
  EXPECT_EQ(fine.threads[1].elements, 2) << "it carries a ring";
  EXPECT_EQ(fine.threads[1].start.on, "thread.main.node.12");
  EXPECT_EQ(fine.probes[0].of, "thread.main.node.12");
  const Assembly a = assemble(coarse), b = assemble(fine);
  double mass_a = 0, mass_b = 0;
  for (const AssemblyNode& node : a.nodes) mass_a += node.mass;
  for (const AssemblyNode& node : b.nodes) mass_b += node.mass;
  EXPECT_NEAR(mass_a, mass_b, 1e-15);
  for (int k = 0; k <= 6; ++k) {
    const Vec3 place = a.nodes[at(a.node_of("thread.main.node." + std::to_string(k)))].position;
    EXPECT_LT((b.nodes[at(b.node_of("thread.main.node." + std::to_string(3 * k)))].position - place).norm(),
              1e-15)
        << k;
  }
}

TEST(FinerThreads, RefineWhatMechanismsTow) {
  const Scene coarse = read_case(std::string(CINCH_SOURCE_DIR) + "/cases/capture.toml");
  const Scene fine = finer_threads(coarse, 2);
  EXPECT_EQ(fine.mechanisms[0].towing_elements, 2 * coarse.mechanisms[0].towing_elements);
  EXPECT_EQ(fine.threads[0].elements, 2 * coarse.threads[0].elements);
  EXPECT_EQ(fine.nets[0].elements_per_side, coarse.nets[0].elements_per_side);
}

// ---- pictures

TEST(Picture, SumsUpPointsAndRuns) {
  const Picture a{{3, 4}, {0, 0}}, b{{1, 0}, {0, 2}};
  EXPECT_DOUBLE_EQ(greatest(a), 5);
  EXPECT_DOUBLE_EQ(root_mean_square(a), std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(extent(a), 5);
  EXPECT_DOUBLE_EQ(greatest(difference(a, b)), std::sqrt(20.0));
  EXPECT_EQ(mean({a, b}, 1), a);
  EXPECT_EQ(mean({a, b}, 2), (Picture{{2, 2}, {0, 1}}));
  const Picture spread = deviation({a, b});
  EXPECT_DOUBLE_EQ(spread[0][0], std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(spread[0][1], std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(spread[1][0], 0);
}

// ---- the estimate

TEST(ErrorEstimate, IsNotBelowTheTrueErrorNorFarAbove) {
  const ErrorEstimate estimate = estimate_error(waving_thread(8), {1, 1}, quietly);
  Scene converged = waving_thread(256);
  converged.time.safety = 0.1;
  const RunTrack truth = follow(converged, 1), coarse = follow(waving_thread(8), 1);
  for (const auto& [name, column] : {std::pair{"end", 0}, {"middle", 3}}) {
    const ErrorEstimate::Row& row = row_of(estimate, name);
    const double error = apart(coarse, truth, static_cast<std::size_t>(column));
    EXPECT_GT(error, 1e-4) << name << ": a thread of 8 elements is not exact";
    EXPECT_GT(row.error(), error) << name;
    EXPECT_LT(row.error(), 4 * error) << name;
    EXPECT_GT(row.size, 0.1);
    EXPECT_FALSE(row.by_chance()) << name;
  }
}

TEST(ErrorEstimate, ComparesTheRunsThatItNames) {
  const Scene scene = waving_thread(8);
  Scene half = scene;
  half.time.step = prepare(scene).timeline.after() / 2;
  const RunTrack own = follow(scene, 1), by_step = follow(half, 1),
                 by_threads = follow(finer_threads(half, 2), 1);
  const ErrorEstimate::Row row = row_of(estimate_error(scene, {1, 1}, quietly), "end");
  EXPECT_DOUBLE_EQ(row.difference[ErrorEstimate::of_step], apart(own, by_step, 0));
  EXPECT_DOUBLE_EQ(row.difference[ErrorEstimate::of_threads], apart(by_step, by_threads, 0));
}

TEST(ErrorEstimate, HalvesTheStepsOfAClosingToo) {
  Scene scene = read(capture_in_two_steps());
  scene.time.end = 0.002;
  scene.output.frame_interval = scene.output.probe_interval = 0.0005;
  Scene half = scene;
  half.time.step /= 2;
  half.closing.step = 0.5 * *scene.closing.step;
  const RunTrack own = follow(scene, 1), by_step = follow(half, 1);
  const ErrorEstimate estimate = estimate_error(scene, {1, 1}, quietly);
  double sum = 0, nodes = 0;
  for (std::size_t part = 0; part < own.nodes.size(); ++part)
    for (std::size_t n = 0; n < own.nodes[part].size(); ++n, ++nodes)
      sum += (own.nodes[part][n] - by_step.nodes[part][n]).squaredNorm();
  EXPECT_GT(sum, 0);
  EXPECT_DOUBLE_EQ(row_of(estimate, "all nodes").difference[ErrorEstimate::of_step], std::sqrt(sum / nodes));
}

TEST(ErrorEstimate, HasARowForEachQuantityAndOneForAllNodes) {
  const ErrorEstimate estimate = estimate_error(waving_thread(8), {1, 1}, quietly);
  ASSERT_EQ(estimate.rows.size(), 4u) << "energies are not compared";
  EXPECT_EQ(row_of(estimate, "end").measure, "greatest over time");
  EXPECT_EQ(row_of(estimate, "pull").measure, "peak");
  EXPECT_EQ(row_of(estimate, "pull").unit, "N");
  EXPECT_EQ(row_of(estimate, "all nodes").unit, "m");
  EXPECT_TRUE(estimate.stopped.empty());
}

TEST(ErrorEstimate, FallsWithElements) {
  const auto error = [](int elements) {
    return row_of(estimate_error(waving_thread(elements), {1, 1}, quietly), "end").error();
  };
  EXPECT_LT(error(32), 0.5 * error(8));
}

TEST(ErrorEstimate, IsTheSameForAnyNumberOfThreads) {
  const ErrorEstimate one = estimate_error(waving_thread(8), {2, 1}, quietly);
  const ErrorEstimate three = estimate_error(waving_thread(8), {2, 3}, quietly);
  for (std::size_t i = 0; i < one.rows.size(); ++i)
    EXPECT_EQ(one.rows[i].difference, three.rows[i].difference) << one.rows[i].name;
}

TEST(ErrorEstimate, AnnouncesItsRuns) {
  for (const auto& [each, runs] : {std::pair{1, 4}, {3, 9}}) {
    int count = 0;
    estimate_error(waving_thread(8), {each, 1}, [&](const std::string&) { ++count; });
    EXPECT_EQ(count, runs) << each;
  }
}

TEST(ErrorEstimate, ChanceMovesNodesByNextToNothing) {
  const Scene scene = briefly_waving_thread();
  const RunTrack still = follow(scene, 1), moved = follow(scene, 1, {1e-9, 1}),
                 again = follow(scene, 1, {1e-9, 1});
  EXPECT_EQ(moved.probes, again.probes);
  EXPECT_NE(moved.probes, follow(scene, 1, {1e-9, 2}).probes);
  EXPECT_GT((moved.nodes[0][4] - still.nodes[0][4]).norm(), 1e-11);
  EXPECT_LT((moved.nodes[0][4] - still.nodes[0][4]).norm(), 1e-6);
}

// What nodes gain when they are moved belongs to what a scene begins with, however little that is.
TEST(ErrorEstimate, ChanceIsNoLossOfEnergy) {
  Scene scene = scene_of(R"(schema = 1
[time]
end_s = 0.02
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.002
points_m = [[0, -0.5, 0], [0, 0.5, 0]]
start = { support = "fixed" }
end = { mass_kg = 0.2 }
[probe.end]
quantity = "position"
of = "thread.main.end"
)");
  EXPECT_NO_THROW(follow(scene, 1, {1e-9, 1}));
}

TEST(ErrorEstimate, KnowsWhatIsByChance) {
  ErrorEstimate::Row row;
  row.difference = {0.03, 0.05, 0.01};
  EXPECT_DOUBLE_EQ(row.error(), 0.16);
  EXPECT_FALSE(row.by_chance());
  row.difference[ErrorEstimate::of_chance] = 0.03;
  EXPECT_TRUE(row.by_chance());
}

// Where all is small a bound says more than that it is by chance: twice what each difference may be.
TEST(ErrorEstimate, BoundsWhatIsSmall) {
  ErrorEstimate::Row row;
  row.size = 2;
  row.difference = {1e-4, 2e-4, 3e-4};
  EXPECT_TRUE(row.by_chance());
  EXPECT_DOUBLE_EQ(row.bound(), 2 * (1e-4 + 2 * 3e-4 + 2e-4 + 2 * 3e-4));
  EXPECT_TRUE(row.bounded());
  row.size = 0.2;
  EXPECT_FALSE(row.bounded());
}

// Means of several runs differ less by chance than single ones.
TEST(ErrorEstimate, MoreRunsLeaveLessToChance) {
  const auto chance = [](int runs) {
    return row_of(estimate_error(briefly_waving_thread(), {runs, 1}, quietly), "all nodes")
        .difference[ErrorEstimate::of_chance];
  };
  EXPECT_GT(chance(2), 0);
  EXPECT_LT(chance(16), 0.6 * chance(2));
}

// Dampers that grow with the elements' stiffness: half the step is too long for twice the elements.
TEST(ErrorEstimate, TellsWhatStoppedAFinerRun) {
  Scene scene = waving_thread(8);
  scene.materials["m"].damping_rule = DampingRule::stiffness;
  scene.materials["m"].damping_ratio = 5;
  scene.materials["m"].damping_frequency = 1000;
  scene.time.step = 0.9 * prepare(scene).stable_step;
  const ErrorEstimate estimate = estimate_error(scene, {1, 1}, quietly);
  ASSERT_EQ(estimate.stopped.size(), 1u);
  EXPECT_NE(estimate.stopped[0].find("twice the elements in threads: "), std::string::npos)
      << estimate.stopped[0];
  EXPECT_NE(estimate.stopped[0].find("above the stable step"), std::string::npos) << estimate.stopped[0];
  const ErrorEstimate::Row& row = row_of(estimate, "end");
  EXPECT_TRUE(std::isnan(row.difference[ErrorEstimate::of_threads]));
  EXPECT_TRUE(std::isnan(row.error()));
  EXPECT_GT(row.difference[ErrorEstimate::of_step], 0);
}

// A heavy mass on one light element could do with longer steps than two elements allow.
Scene pendulum() {
  return scene_of(pendulum_case("[time]\nend_s = 0.05\n" + falling, "1e9", R"([probe.end]
quantity = "position"
of = "thread.main.end"
[probe.start]
quantity = "position"
of = "thread.main.start"
)"));
}

TEST(ErrorEstimate, TwiceTheElementsTakeAnAutomaticStepOfTheirOwnWhereTheyNeedIt) {
  const Scene scene = pendulum();
  Scene half = scene;
  half.time.step = prepare(scene).timeline.after() / 2;
  ASSERT_THROW(prepare(finer_threads(half, 2)), CaseError);
  const ErrorEstimate estimate = estimate_error(scene, {1, 1}, quietly);
  EXPECT_TRUE(estimate.stopped.empty()) << estimate.stopped.front();
  const RunTrack by_step = follow(half, 1), by_threads = follow(finer_threads(scene, 2), 1);
  EXPECT_DOUBLE_EQ(row_of(estimate, "end").difference[ErrorEstimate::of_threads],
                   apart(by_step, by_threads, 0));
}

TEST(ErrorEstimate, AGivenStepIsHalvedWhateverTheElements) {
  Scene scene = pendulum();
  scene.time.step = 0.01;
  const ErrorEstimate estimate = estimate_error(scene, {1, 1}, quietly);
  ASSERT_EQ(estimate.stopped.size(), 1u);
  EXPECT_NE(estimate.stopped[0].find("time.step_s = 0.005 s is above"), std::string::npos)
      << estimate.stopped[0];
}

// Lengths of elements that lie askew are rounded, and so is what they pull with.
TEST(ErrorEstimate, KnowsWhatDoesNotMove) {
  Scene scene = pendulum();
  scene.gravity.reset();
  scene.threads[0].elements = 7;
  scene.threads[0].points = {{0.1, 0.2, 0.3}, {0.8, 0.9, 0.7}};
  scene.probes[1].of = "thread.main.node.3";
  const ErrorEstimate still = estimate_error(scene, {1, 1}, quietly);
  EXPECT_GT(row_of(still, "start").size, 0);
  EXPECT_LT(row_of(still, "start").size, 1e-13);
  EXPECT_GT(row_of(still, "start").difference[ErrorEstimate::of_chance], 1e-11);
  EXPECT_TRUE(row_of(still, "start").still);
  EXPECT_TRUE(row_of(still, "end").still);
  EXPECT_FALSE(row_of(still, "all nodes").still) << "its size is the scene's";
  const ErrorEstimate moves = estimate_error(pendulum(), {1, 1}, quietly);
  EXPECT_TRUE(row_of(moves, "start").still) << "it is fixed";
  EXPECT_FALSE(row_of(moves, "end").still);
}

TEST(ErrorEstimate, ThrowsWhatStopsTheCaseItself) {
  Scene scene = waving_thread(8);
  scene.time.speed_limit = 0.5;
  EXPECT_THROW(estimate_error(scene, {1, 1}, quietly), NumericalError);
}

}  // namespace
