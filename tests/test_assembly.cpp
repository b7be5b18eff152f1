// The assembly: where closing threads lie and rings sit, when more than one element joins two nodes.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "scene/assembly.hpp"

namespace cinch {
namespace {

const char* const two_ways = R"(schema = 1
[time]
end_s = 1
[closing]
time_s = 0.5
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 1000
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.2, 0.2]
mesh_m = 0.1
[thread.detour]                # a second, longer way between the knots of the first cell of the top edge
material = "m"
diameter_m = 0.002
elements = 1
points_m = [[-0.1, 0.1, 0], [0, 0.1, 0]]
length_m = 0.3
start = { on = "net.main.knot.0.2" }
end = { on = "net.main.knot.1.2" }
[thread.c]
material = "m"
diameter_m = 0.002
elements = 4
along = ["net.main.top"]
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.001
youngs_modulus_Pa = 70e9
on = "net.main.top"
element = 0
)";

TEST(Assembly, AnEdgeIsTheNetsOwnElementsEvenWhereAThreadRunsBesideIt) {
  const Assembly assembly = assemble(parse_case(two_ways, "two_ways.toml"));
  const Part& net = assembly.parts[0];
  ASSERT_EQ(net.kind, PartKind::net);
  EXPECT_GE(assembly.rings[0].element, net.first_element);
  EXPECT_LT(assembly.rings[0].element, net.first_element + net.elements);
  // 0.2 m of edge in four elements; inner nodes at quarters of it
  for (const AssemblyElement& e : assembly.elements) {
    if (assembly.parts[static_cast<std::size_t>(e.part)].name != "c") continue;
    EXPECT_DOUBLE_EQ(e.rest_length, 0.05);
  }
  EXPECT_DOUBLE_EQ(assembly.lays[1].s, 0.5);
  EXPECT_DOUBLE_EQ(assembly.lays[3].s, 0.5);
}

TEST(Assembly, AThreadHangsOnALauncher) {
  const Assembly assembly = assemble(parse_case(std::string(two_ways) + R"([mechanism.m]
corner = "net.main.top_right"
launcher_mass_kg = 0.05
split_mass_kg = 0.1
towing_material = "m"
towing_diameter_m = 0.002
separation_a_m_s = [0, 0, 0]
separation_b_m_s = [0, 0, 0]
[thread.tail]
material = "m"
diameter_m = 0.002
elements = 2
points_m = [[1, 1, 0], [1, 1, 1]]
start = { on = "mechanism.m.launcher" }
)",
                                                "launcher.toml"));
  const Index launcher = assembly.node_of("mechanism.m.launcher");
  EXPECT_EQ(assembly.node_of("thread.tail.start"), launcher);
  EXPECT_NEAR(assembly.nodes[static_cast<std::size_t>(launcher)].mass, 0.05, 0.005);
}

// What is said of the case above with one change.
std::string refusal(const std::string& before, const std::string& after) {
  std::string text = two_ways;
  const auto at = text.find(before);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, before.size(), after);
  try {
    assemble(parse_case(text, "a.toml"));
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(Assembly, WhatDoesNotHangTogetherIsRefused) {
  const auto expect = [](const std::string& before, const std::string& after, const std::string& words) {
    const std::string said = refusal(before, after);
    EXPECT_NE(said.find(words), std::string::npos) << words << "\nin: " << said;
  };
  expect("along = [\"net.main.top\"]", "along = [\"net.main.top\", \"net.main.bottom\"]",
         "'net.main.bottom' does not begin where 'net.main.top' ends");
  expect("end = { on = \"net.main.knot.1.2\" }", "end = { on = \"net.main.knot.0.2\" }",
         "thread 'detour' has an element with one and the same node");
}

}  // namespace
}  // namespace cinch
