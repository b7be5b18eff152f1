// Which scenes are the paper's: its numbers judge no other.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input/case_reader.hpp"
#include "report/paper_scene.hpp"

namespace cinch {
namespace {

using Changes = std::vector<Override>;

Scene changed(const std::string& name, const Changes& changes) {
  return read_case(CINCH_SOURCE_DIR "/cases/" + name + ".toml", changes);
}

PaperCase known_as(const std::string& name, const Changes& changes = {}) {
  const Recognised found = recognise(changed(name, changes));
  EXPECT_EQ(found.as == PaperCase::none, !found.difference.empty()) << found.difference;
  return found.as;
}

std::string difference(const std::string& name, const Changes& changes) {
  const Recognised found = recognise(changed(name, changes));
  EXPECT_EQ(found.as, PaperCase::none);
  return found.difference;
}

Changes of_all(const std::vector<std::string>& parts, const std::string& key, const std::string& value) {
  Changes changes;
  for (const std::string& part : parts) changes.push_back({part + "." + key, value});
  return changes;
}

const std::vector<std::string> closing_threads{"thread.c_top", "thread.c_right", "thread.c_bottom",
                                               "thread.c_left"},
    mechanisms{"mechanism.m1", "mechanism.m2", "mechanism.m3", "mechanism.m4"};

TEST(ReportScene, ThePapersCasesAreKnownFromTheResolvedText) {
  for (const auto& [name, as] : {std::pair{"ring_pull", PaperCase::ring_pull},
                                 {"edge_closure", PaperCase::edge_closure},
                                 {"capture", PaperCase::capture}}) {
    const Scene scene = changed(name, {});
    EXPECT_EQ(recognise(scene).as, as) << recognise(scene).difference;
    EXPECT_EQ(recognise(parse_case(scene.resolved_toml, "mine.toml")).as, as) << "whatever its name";
  }
}

TEST(ReportScene, WhatOnlyTheComputationNeedsMayBeAnything) {
  for (const char* method : {"sliding", "paper"})
    EXPECT_EQ(known_as("ring_pull", {{"case.method", method}, {"time.end_s", "3"}}), PaperCase::ring_pull);
  EXPECT_EQ(known_as("ring_pull", {{"thread.main.elements", "800"}, {"time.step_s", "4e-7"}}),
            PaperCase::ring_pull);
  EXPECT_EQ(known_as("edge_closure", {{"rings.r.joint", "sliding"}, {"thread.closing.elements", "24"}}),
            PaperCase::edge_closure);
  EXPECT_EQ(known_as("capture", {{"contact.distance", "golden"}, {"output.frame_interval_s", "0.1"}}),
            PaperCase::capture);
}

// Those of cases/paper.
TEST(ReportScene, WhatThePaperLeavesOpenMayBeAnything) {
  const std::vector<Changes> open{
      {{"closing.time_s", "1.2"}},
      {{"closing.time_s", "1.6"}, {"time.end_s", "2.1"}},
      {{"net.main.elements_per_side", "2"}},
      {{"material.closing.damping_ratio", "0.02"}, {"material.net.damping_ratio", "0.02"}},
      {{"contact.alpha_ring_s_m", "0.3"}, {"contact.alpha_target_s_m", "0.3"}},
      {{"contact.couple", "paper"}, {"contact.shared_node", "paper"}},
      {{"rings.r.diameter_m", "0.016"}},
      {{"material.closing.youngs_modulus_Pa", "87e9"}},
      {{"net.main.stowed_factor", "0.05"}},
      {{"mechanism.m1.launch_speed_m_s", "1.00023"}},
      of_all(closing_threads, "length_m", "1.19"),
      of_all(closing_threads, "length_m", "1.205"),
      of_all(mechanisms, "towing_length_m", "0.05"),
  };
  for (const Changes& changes : open)
    EXPECT_EQ(known_as("capture", changes), PaperCase::capture) << changes.front().key;
  EXPECT_EQ(known_as("edge_closure", {{"material.closing.youngs_modulus_Pa", "87e9"}}),
            PaperCase::edge_closure);
}

TEST(ReportScene, AnotherSceneOfTheSamePartsIsToldApart) {
  EXPECT_EQ(difference("ring_pull", {{"thread.main.start.mass_kg", "5"}}),
            "ball's mass 5 kg, the paper's 0.1 kg (Sec. 5.1)");
  EXPECT_EQ(difference("ring_pull", {{"ring.r1.axis", "[0, 0, 1]"}}),
            "ring guided along Y: no, the paper's: yes (Sec. 5.1)");
  EXPECT_EQ(difference("ring_pull", {{"thread.main.start.velocity_m_s", "[0, 0, -2]"}}),
            "ball's velocity along Z -2 m/s, the paper's -1 m/s (Sec. 5.1)");
  EXPECT_EQ(difference("ring_pull", {{"thread.main.points_m", "[[0, -0.2, 0], [0, 6.8, 0]]"},
                                     {"thread.main.diameter_m", "0.01"}}),
            "place of the thread's end along Y 6.8 m, the paper's 0.8 m (Sec. 5.1); 3 more differ");
  EXPECT_EQ(difference("capture", {{"target.ball.radius_m", "0.3"}}),
            "target's radius 0.3 m, the paper's 0.15 m (Table 4)");
  EXPECT_EQ(difference("capture", {{"closing.time_s", "0.5"}}),
            "closing time 0.5 s, the paper's 1.2 s to 1.6 s (Fig. 14)");
}

// Each of these alone makes it another scene.
TEST(ReportScene, NothingThatThePaperFixesMayDiffer) {
  const std::vector<std::pair<std::string, Changes>> others{
      {"ring_pull", {{"material.thread.youngs_modulus_Pa", "2e9"}}},
      {"ring_pull", {{"ring.r1.mass_kg", "0.2"}}},
      {"ring_pull", {{"ring.r1.diameter_m", "0.03"}}},
      {"ring_pull", {{"ring.r1.normal", "[0, 1, 1]"}}},
      {"ring_pull", {{"thread.main.length_m", "1.1"}}},
      {"ring_pull", {{"thread.main.end.support", "free"}}},
      {"ring_pull", {{"gravity.acceleration_m_s2", "[0, 0, -9.81]"}}},
      {"edge_closure", {{"gravity.acceleration_m_s2", "[0, 0, -1.62]"}}},
      {"edge_closure", {{"thread.closing.end.mass_kg", "0.2"}}},
      {"edge_closure", {{"thread.closing.overhang_end_m", "0.115"}}},
      {"edge_closure", {{"material.net.density_kg_m3", "970"}}},
      {"edge_closure", {{"net.main.node.top_left.support", "free"}}},
      {"edge_closure", {{"rings.r.cells", "[4, 5, 6, 7]"}}},
      {"edge_closure", {{"rings.r.edges", "[\"top\"]"}}},
      {"edge_closure", {{"closing.time_s", "0.1"}}},
      {"edge_closure", {{"start.equilibrium", "false"}}},
      {"capture", {{"net.main.size_m", "[2, 2]"}}},
      {"capture", {{"net.main.velocity_m_s", "[0, 0, 1]"}}},
      {"capture", {{"target.ball.center_m", "[0, 0, 1.2]"}}},
      {"capture", {{"mechanism.m3.launch_angle_deg", "40"}}},
      {"capture", {{"mechanism.m3.launch_speed_m_s", "2"}}},
      {"capture", {{"mechanism.m2.split_mass_kg", "0.2"}}},
      {"capture", {{"mechanism.m4.separation_b_m_s", "[2, -2, 0]"}}},
      {"capture", {{"thread.c_left.length_m", "1.3"}}},
      {"capture", {{"thread.c_left.diameter_m", "0.003"}}},
      {"capture", {{"rings.r.mass_kg", "0.001"}}},
  };
  for (const auto& [name, changes] : others)
    EXPECT_EQ(known_as(name, changes), PaperCase::none) << name << " " << changes.front().key;
}

TEST(ReportScene, ScenesOfOtherPartsAreLikeNone) {
  const Recognised large = recognise(changed("large_capture", {}));
  EXPECT_EQ(large.as, PaperCase::none);
  EXPECT_EQ(large.difference, "");
}

}  // namespace
}  // namespace cinch
