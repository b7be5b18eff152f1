// What probes record, against the state that they look at and against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "plan/probes.hpp"
#include "scene/mouth.hpp"
#include "support/quick_cases.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

// A rope with a weight, one that is thrown at a target, and a net that flies freely.
const char* const scenery = R"(schema = 1
[time]
end_s = 0.02
[gravity]
acceleration_m_s2 = [0, 0, -10]
[material.m]
youngs_modulus_Pa = 1e7
density_kg_m3 = 970
[thread.hanging]
material = "m"
diameter_m = 0.002
elements = 4
points_m = [[5, 0, 0], [5, 0, -0.4]]
start = { support = "fixed" }
end = { mass_kg = 1 }
[thread.pressed]
material = "m"
diameter_m = 0.002
elements = 2
points_m = [[-0.1, 0, 0.1009], [0.1, 0, 0.1009]]
[thread.pressed.node.1]
mass_kg = 0.01
velocity_m_s = [0, 0, -1]
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.2, 0.2]
mesh_m = 0.1
center_m = [0, 3, 0]
velocity_m_s = [3, 4, 0]
[target.ball]
center_m = [0, 0, 0]
radius_m = 0.1
youngs_modulus_Pa = 1e6
[probe.rope]
quantity = "tension"
of = "thread.hanging"
[probe.joint]
quantity = "tension"
of = "thread.hanging.node.3"
[probe.knot]
quantity = "position"
of = "net.main.knot.1.1"
[probe.speed]
quantity = "speed"
of = "net.main.knot.1.1"
[probe.velocity]
quantity = "velocity"
of = "net.main.knot.1.1"
[probe.push]
quantity = "force"
of = "thread.pressed.node.1"
[probe.free]
quantity = "force"
of = "thread.hanging.node.1"
)";

// Column: value.
std::map<std::string, double> recorded(Simulation& sim) {
  const std::vector<double> row = sim.probe_row(sim.look());
  EXPECT_EQ(row.size(), sim.probe_columns().size());
  std::map<std::string, double> values;
  for (std::size_t c = 0; c < row.size(); ++c) values[sim.probe_columns()[c].name] = row[c];
  return values;
}

TEST(Probes, TensionOfANodeIsTheGreatestAtIt) {
  Simulation sim(scene_of(scenery), 1);
  run_until(sim, 0.02);
  const auto values = recorded(sim);
  const auto& parts = sim.preparation().assembly.parts;
  const Part& rope =
      *std::find_if(parts.begin(), parts.end(), [](const Part& p) { return p.name == "hanging"; });
  std::vector<double> pulls;
  for (Index e = 0; e < 4; ++e) pulls.push_back(sim.look().pull(rope.first_element + e).tension);
  EXPECT_EQ(values.at("rope"), *std::max_element(pulls.begin(), pulls.end()));
  EXPECT_EQ(values.at("joint"), std::max(pulls[2], pulls[3]));
  EXPECT_GT(values.at("joint"), 0);
  EXPECT_NE(values.at("joint"), values.at("rope")) << "the weight has just begun to pull from below";
}

TEST(Probes, SpeedAndPlaceOfAKnotThatFalls) {
  Simulation sim(scene_of(scenery), 1);
  run_until(sim, 0.02);
  const double t = sim.look().time();
  const auto values = recorded(sim);
  EXPECT_NEAR(values.at("velocity.x"), 3, 1e-9);
  EXPECT_NEAR(values.at("velocity.z"), -10 * t, 1e-9);
  EXPECT_NEAR(values.at("speed"), std::sqrt(25 + 100 * t * t), 1e-9);
  EXPECT_NEAR(values.at("knot.x"), 3 * t, 1e-9);
  EXPECT_NEAR(values.at("knot.y"), 3 + 4 * t, 1e-9);
  EXPECT_NEAR(values.at("knot.z"), -5 * t * t, 1e-9);
}

// Newton's second law for the node, whose threads are slack while it sinks in.
TEST(Probes, ForceOnANodeIsWhatATargetPushesWith) {
  Simulation sim(scene_of(scenery), 1);
  bool pressed = false;
  for (double t = 0.0005; t < 0.003; t += 0.0005) {
    run_until(sim, t);
    const auto values = recorded(sim);
    const Index node = sim.preparation().assembly.node_of("thread.pressed.node.1");
    const Vec3 push(values.at("push.x"), values.at("push.y"), values.at("push.z"));
    EXPECT_EQ(push, sim.look().contact_forces()[at(node)]);
    EXPECT_DOUBLE_EQ(values.at("push.magnitude"), push.norm());
    EXPECT_EQ(values.at("free.magnitude"), 0);
    pressed = pressed || push.z() > 0.01;
  }
  EXPECT_TRUE(pressed);
}

TEST(Probes, OnlyRingsWithANodeHaveAVelocity) {
  const std::string ring = R"(
[ring.r]
joint = "contact"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.1
youngs_modulus_Pa = 70e9
)";
  const std::string probe = "[probe.v]\nquantity = \"velocity\"\nof = \"ring.r\"\n";
  const std::string free = std::string(scenery) + ring + "center_m = [2, 0, 0]\nnormal = [0, 1, 0]\n" + probe;
  EXPECT_EQ(probe_columns(scene_of(free), assemble(scene_of(free))).back().name, "v.z");
  const std::string carried = std::string(scenery) + ring + "on = \"thread.hanging\"\nelement = 1\n" + probe;
  try {
    Simulation(scene_of(carried), 1);
    FAIL() << "not refused";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("has no velocity of its own"), std::string::npos)
        << error.what();
  }
}

// Only sliding joints have a tension and a place on their thread, and that is of one thread.
TEST(Probes, OnlySlidingJointsTellTensionAndPlace) {
  const std::string ring = R"(
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.1
youngs_modulus_Pa = 70e9
on = "thread.hanging"
element = 1
joint = "contact"
)";
  for (const std::string quantity : {"tension", "material_coordinate"}) {
    const std::string probe = "[probe.j]\nquantity = \"" + quantity + "\"\nof = \"ring.r\"\n";
    try {
      Simulation(scene_of(std::string(scenery) + ring + probe), 1);
      FAIL() << "not refused";
    } catch (const CaseError& error) {
      EXPECT_NE(std::string(error.what()).find("probe 'j': 0 threads slide through 'ring.r'"),
                std::string::npos)
          << error.what();
    }
  }
}

// A look computes it once, the next look anew.
TEST(Probes, TheMouthIsThatOfTheLook) {
  const Case one = sliding_capture();
  Simulation sim(read(one), 1);
  double before = 0;
  for (const std::int64_t step : {one.steps / 2, one.steps}) {
    sim.advance_to(step);
    const Look& now = sim.look();
    const double area = now.mouth_area();
    EXPECT_EQ(area, mouth_area(now.ring_centers()));
    EXPECT_EQ(area, now.mouth_area());
    EXPECT_NE(area, before);
    before = area;
  }
}

}  // namespace
