// What valid cases say and may not mean: each warning once, with its place and its cause.
#include <gtest/gtest.h>

#include "plan/case_warnings.hpp"
#include "support/pendulum.hpp"
#include "support/quick_cases.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

std::vector<std::string> warnings_of(const Scene& scene) { return case_warnings(scene, prepare(scene)); }

void expect_pieces(const std::string& text, std::initializer_list<const char*> pieces) {
  for (const char* piece : pieces)
    EXPECT_NE(text.find(piece), std::string::npos) << "no \"" << piece << "\" in: " << text;
}

const std::string head = R"(schema = 1
[time]
end_s = 0.01
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
)";

// ---- great strain at the start

// thread.b hangs on the end of thread.a at x = 1, wherever its points begin; `keys`: further ones of
// thread.a.
Scene two_threads(const std::string& begin, const std::string& keys = "") {
  return scene_of(head + R"([thread.a]
material = "m"
diameter_m = 0.002
elements = 4
points_m = [[0, 0, 0], [1, 0, 0]]
)" + keys + R"([thread.b]
material = "m"
diameter_m = 0.002
elements = 4
start = { on = "thread.a.end" }
points_m = [[)" + begin +
                  ", 0, 0], [2, 0, 0]]\n");
}

TEST(GreatStrain, OfAThreadThatHangsOnADistantNodeIsToldWithTheGap) {
  const auto warnings = warnings_of(two_threads("1.5"));
  ASSERT_EQ(warnings.size(), 1u);
  // 0.625 m to its second node, for elements of 0.125 m
  expect_pieces(warnings[0],
                {"test.toml:12:9: warning: element 0 of thread.b (nodes 4 and 5) begins with 400 %",
                 "allowed without this warning: 5 %; thread.a.end, on which it hangs there, "
                 "lies 0.5 m from where points_m lead"});
}

TEST(GreatStrain, IsNotThatOfWhatIsLaidAsLongAsItIs) {
  EXPECT_TRUE(warnings_of(two_threads("1")).empty());
  EXPECT_TRUE(warnings_of(two_threads("1", "length_m = 0.96\n")).empty()) << "4.2 %";
  EXPECT_TRUE(warnings_of(two_threads("1", "length_m = 2\n")).empty()) << "slack";
  EXPECT_TRUE(warnings_of(two_threads("0.8")).empty()) << "a gap that leaves it slack";
}

TEST(GreatStrain, OfAThreadTooShortForItsPointsHasNoGap) {
  const auto warnings = warnings_of(two_threads("1", "length_m = 0.5\n"));
  ASSERT_EQ(warnings.size(), 1u);
  expect_pieces(warnings[0],
                {"test.toml:7:9: warning: element 0 of thread.a (nodes 0 and 1) begins with 100 %"});
  EXPECT_EQ(warnings[0].find("hangs"), std::string::npos) << warnings[0];
}

TEST(GreatStrain, OfANetAndItsTowingThreadsIsToldOnceForEach) {
  Scene scene = read_case(case_file(capture()), {{"net.main.stowed_factor", "2"}});
  const auto warnings = warnings_of(scene);
  ASSERT_EQ(warnings.size(), 5u) << "the closing threads are laid when it has drawn together";
  expect_pieces(warnings[0], {"/cases/capture.toml:", ": warning: element 0 of net.main ", " with 100 % of"});
  for (std::size_t m = 1; m <= 4; ++m)
    expect_pieces(warnings[m],
                  {("element 0 of mechanism.m" + std::to_string(m) + " ").c_str(), " with 100 %"});
  EXPECT_TRUE(warnings_of(read_case(case_file(capture()))).empty());
}

TEST(GreatStrain, IsNoMatterWhereAnEquilibriumIsSoughtFirst) {
  Scene scene = two_threads("1", "length_m = 0.5\nstart = { support = \"fixed\" }\n");
  EXPECT_EQ(warnings_of(scene).size(), 1u);
  scene.equilibrium = true;
  EXPECT_TRUE(warnings_of(scene).empty());
}

// ---- of closing threads

Scene capture_with_top(const std::string& along, std::vector<Override> sets = {}) {
  sets.push_back({"thread.c_top.along", along});
  return read_case(case_file(capture()), sets);
}

// The launcher stands 0.1 m outwards of the corner where the thread would begin.
TEST(GreatStrain, OfAClosingThreadThatHangsBesideItsPathIsToldHoweverItsNetIsStowed) {
  for (const char* stowed : {"0.1", "0.5", "1"}) {
    const auto warnings = warnings_of(capture_with_top(
        "[\"net.main.top\"]", {{"net.main.stowed_factor", stowed}, {"thread.c_top.length_m", "1"}}));
    ASSERT_EQ(warnings.size(), 1u) << stowed;
    expect_pieces(warnings[0],
                  {": warning: element 0 of thread.c_top (nodes ", "; mechanism.m1.b, on which it hangs",
                   "lies 0.1 m from where it is laid (along net.main.top)"});
  }
}

TEST(GreatStrain, OfAClosingThreadTooShortIsToldByItsLengthAlone) {
  const auto warnings =
      warnings_of(capture_with_top("[\"net.main.top\"]", {{"thread.c_top.length_m", "0.5"}}));
  ASSERT_EQ(warnings.size(), 1u);
  expect_pieces(warnings[0], {"closing thread 'c_top' of length_m = 0.5 m is laid over 1 m"});
}

// ---- nets

TEST(ThickNet, IsToldOf) {
  const auto net = [](const char* diameter, int elements) {
    return scene_of(head + "[net.n]\nmaterial = \"m\"\nsize_m = [0.3, 0.2]\nmesh_m = 0.1\ndiameter_m = " +
                    diameter + "\nelements_per_side = " + std::to_string(elements) + "\n");
  };
  EXPECT_TRUE(warnings_of(net("0.02", 4)).empty());
  const auto warnings = warnings_of(net("0.03", 4));
  ASSERT_EQ(warnings.size(), 1u);
  expect_pieces(warnings[0],
                {"test.toml:7:6: warning: net 'n' has threads of diameter_m = 0.03 m", ": 0.025 m (mesh_m"});
  EXPECT_EQ(warnings_of(net("0.1", 1)).size(), 1u);
}

// ---- steps

TEST(LongStep, IsToldOfWhereFramesOrRowsCannotKeepUp) {
  const auto thread = [](const char* step, const std::string& output) {
    return warnings_of(scene_of(pendulum_case(
        "[time]\nend_s = 0.1\nstep_s = " + std::string(step) + "\n[output]\n" + output + "\n", "1e3")));
  };
  const auto probes = thread("0.002", "probe_interval_s = 1e-3");
  ASSERT_EQ(probes.size(), 1u);
  expect_pieces(probes[0], {"test.toml:4:",
                            ": warning: time.step_s = 0.002 s is longer than "
                            "output.probe_interval_s = 0.001 s: rows of probes come every step"});
  EXPECT_EQ(thread("0.02", "probe_interval_s = 1e-3").size(), 2u) << "frames, too";
  EXPECT_TRUE(thread("0.002", "probe_interval_s = 0.002").empty());
  EXPECT_TRUE(thread("0.002", "").empty());
  EXPECT_TRUE(thread("\"auto\"", "probe_interval_s = 1e-3").empty());
}

TEST(LongStep, OfBothPhasesIsToldOnce) {
  const auto with = [](std::vector<Override> sets) {
    sets.push_back({"output.probe_interval_s", "1e-6"});
    return warnings_of(read_case(case_file(capture()), sets));
  };
  EXPECT_EQ(with({{"time.step_s", "2e-6"}}).size(), 1u);
  const auto closing = with({{"closing.step_s", "2e-6"}});
  ASSERT_EQ(closing.size(), 1u);
  expect_pieces(closing[0], {": warning: closing.step_s = 2e-06 s is longer than output.probe_interval_s"});
  EXPECT_EQ(with({{"closing.step_s", "2e-6"}, {"time.end_s", "1"}}).size(), 1u)
      << "of the closing time alone";
}

}  // namespace
