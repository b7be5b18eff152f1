// Parts that combine freely: rings beside a closing scene, threads on rings, supports on closing threads,
// contacts that share a mass, fewer threads than asked for.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "plan/simulation.hpp"
#include "store/fields.hpp"
#include "support/quick_cases.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

const std::string material = R"(schema = 1
[time]
end_s = 0.2
[material.t]
youngs_modulus_Pa = 1e9
density_kg_m3 = 97
)";

const std::string net = R"([net.main]
material = "t"
diameter_m = 0.002
size_m = [0.6, 0.2]
mesh_m = 0.1
center_m = [0, 0, 5]
velocity_m_s = [0, 0, 1]
)";

const std::string ring = R"([ring.r]
joint = "contact"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.05
youngs_modulus_Pa = 70e9
center_m = [0, 0, 0]
normal = [1, 0, 0]
support = "fixed"
)";

Simulation simulate(const std::string& text, double until) {
  Simulation simulation(parse_case(text, "combination.toml"), 1);
  simulation.advance_to(simulation.preparation().timeline.step_at(until));
  return simulation;
}

// A thread over a ring, with 100 g on one side.
std::string hung_over(const std::string& over, int elements, const std::string& other_mass_kg) {
  return material + "[gravity]\nacceleration_m_s2 = [0, 0, -9.81]\n" + over + R"([thread.a]
material = "t"
diameter_m = 0.001
points_m = [[-0.2, 0, -0.05], [0, 0, 0], [0.2, 0, -0.05]]
start = { mass_kg = 0.1 }
elements = )" +
         std::to_string(elements) + "\nend = { mass_kg = " + other_mass_kg + " }\n";
}

// Far away from it a net closes.
std::string closing_net(const std::string& time_s) {
  return net + "[closing]\ntime_s = " + time_s +
         "\n[thread.k]\nmaterial = \"t\"\ndiameter_m = 0.001\nelements = 10\nalong = [\"net.main.top\"]\n";
}

TEST(Combinations, ARingHoldsItsThreadBeforeSomethingElseCloses) {
  const std::string hung = hung_over(ring, 100, "0.1");
  Simulation alone = simulate(hung, 0.1), beside = simulate(hung + closing_net("0.05"), 0.1);
  const RingRecord one = alone.summary().ring_records[0], other = beside.summary().ring_records[0];
  ASSERT_GT(one.peak_force, 1);
  EXPECT_LT(one.first_contact_time, 0.05);  // before the closing time of the other scene
  EXPECT_NEAR(other.first_contact_time, one.first_contact_time, 1e-5);  // their steps differ
  EXPECT_NEAR(other.peak_force, one.peak_force, 0.05 * one.peak_force);
}

// Its joint goes on where it is: nodes have passed the ring by then.
TEST(Combinations, AThreadGoesOnSlidingWhileSomethingElseCloses) {
  std::string sliding = ring;
  sliding.replace(sliding.find("contact"), 7, "sliding");
  const std::string hung = hung_over(sliding, 20, "0.3");
  Simulation alone = simulate(hung, 0.15), beside = simulate(hung + closing_net("0.12"), 0.15);
  ASSERT_TRUE(beside.closed_phase());
  const Preparation& p = alone.preparation();
  const Index heavy = p.assembly.node_of("thread.a.end"),
              also = beside.preparation().assembly.node_of("thread.a.end");
  const kernel::JointState &one = alone.state().joints[0], &other = beside.state().joints[0];
  EXPECT_NE(one.element, p.whole().joint_element[0]) << "nodes have passed";
  EXPECT_EQ(other.element, one.element);
  EXPECT_EQ(other.passes, one.passes);
  EXPECT_LT((alone.look().position(heavy) - beside.look().position(also)).norm(), 1e-4);
  EXPECT_LT(beside.summary().relative_residual, 1e-3);
}

TEST(Combinations, AThreadHangsOnARingsOwnNode) {
  const std::string text = material + ring + R"([thread.a]
material = "t"
diameter_m = 0.002
elements = 20
points_m = [[0, 0, 0.5], [0, 0, 0]]
start = { mass_kg = 0.01, velocity_m_s = [0.5, 0, 0] }
end = { on = "ring.r" }
)";
  Simulation swing = simulate(text, 0.1);
  const Assembly& assembly = swing.preparation().assembly;
  EXPECT_EQ(assembly.node_of("thread.a.end"), assembly.rings[0].node);
  EXPECT_TRUE(assembly.rings[0].parts.empty());  // it lies inside the wire for good
  const Frame now = swing.frame();
  EXPECT_EQ(now.position[static_cast<std::size_t>(assembly.rings[0].node)], Vec3(0, 0, 0));
  EXPECT_NEAR(now.position[static_cast<std::size_t>(assembly.node_of("thread.a.start"))].norm(), 0.5,
              5e-3);  // the thread is still at rest beside it
}

TEST(Combinations, SupportsOfClosingThreadsHoldFromTheClosingTimeOn) {
  Simulation run = simulate(material + net + R"([closing]
time_s = 0.1
[thread.c]
material = "t"
diameter_m = 0.002
elements = 40
along = ["net.main.top"]
overhang_start_m = 0.05
start = { support = "fixed" }
end = { mass_kg = 0.1, support = "guided", axis = [0, 1, 0] }
)",
                            0.1);
  const auto node = [&](const char* name) {
    return static_cast<std::size_t>(run.preparation().assembly.node_of(name));
  };
  const Frame closing = run.frame();
  run.advance_to(run.preparation().end_step);
  const Frame end = run.frame();
  EXPECT_EQ(end.position[node("thread.c.start")], closing.position[node("thread.c.start")]);
  const Vec3 moved = end.position[node("thread.c.end")] - closing.position[node("thread.c.end")];
  EXPECT_EQ(moved.x(), 0);
  EXPECT_EQ(moved.z(), 0);
  EXPECT_LT(run.summary().linear_momentum_drift, 1e-12);  // what the supports took is booked
  EXPECT_LT(run.summary().relative_residual, 1e-3);
}

// Rounded to steps it would be none, but the scene has a phase before it.
TEST(Combinations, AClosingTimeOfLessThanHalfAStepIsTheFirstStep) {
  const auto run = [](const std::string& time) {
    Simulation simulation(parse_case(material + net + R"([mechanism.m]
corner = "net.main.top_right"
launcher_mass_kg = 0.05
split_mass_kg = 0.1
towing_material = "t"
towing_diameter_m = 0.002
launch_speed_m_s = 1
separation_a_m_s = [-2, 1, 0]
separation_b_m_s = [2, -1, 0]
[thread.c]
material = "t"
diameter_m = 0.002
elements = 20
along = ["net.main.top"]
[closing]
time_s = )" + time + "\n",
                                     "closing.toml"),
                          1);
    simulation.advance_to(100);
    return simulation;
  };
  Simulation soon = run("1e-9");
  const double step = soon.preparation().timeline.before();
  Simulation next = run(std::to_string(step));
  EXPECT_EQ(soon.preparation().closing_step, 1);
  EXPECT_EQ(state_hash(soon.state()), state_hash(next.state()));
  EXPECT_NEAR(soon.summary().energy.work_separation, 0.1 * 5, 1e-9);  // once, not twice
  EXPECT_EQ(run("0").preparation().closing_step, 0);
}

// The deployed net flies at 0.8 m/s along Z and closes at once.
Simulation closing_around(const std::string& ball) {
  const test::Case one = test::sliding(
      {"capture",
       {{"net.main.stowed_factor", "1"}, {"closing.time_s", "0.05"}, {"target.ball.center_m", ball}},
       0},
      12, "6.8e-6", 0);
  return Simulation(test::read(one), 1);
}

// Until `end`, in s.
void note_until(Simulation& simulation, double end) {
  for (double t = simulation.time() + 0.02; t <= end; t += 0.02) {
    test::run_until(simulation, t);
    simulation.note_events(simulation.look());
  }
}

std::vector<std::string> capture_events(Simulation& simulation) {
  std::vector<std::string> kinds;
  for (const Event& event : simulation.summary().events)
    if (event.kind != "ring_contact" && event.kind != "separation") kinds.push_back(event.kind);
  return kinds;
}

using Kinds = std::vector<std::string>;

TEST(Combinations, ATargetIsEnclosedOnceTheMouthHasClosedBehindIt) {
  Simulation around = closing_around("[0, 0, 0.25]"), ahead = closing_around("[0, 0, -0.25]");
  note_until(around, 0.36);
  EXPECT_EQ(capture_events(around), (Kinds{"target_contact", "mouth_closed", "target_enclosed"}));
  note_until(ahead, 0.36);
  EXPECT_EQ(capture_events(ahead), Kinds{"mouth_closed"}) << "the net flies away from it";
}

// Nothing holds a mouth shut.
TEST(Combinations, AMouthMayOpenAgainAndATargetBeLost) {
  Simulation simulation = closing_around("[0, 0, 0.25]");
  note_until(simulation, 0.56);
  Kinds kinds{"target_contact", "mouth_closed", "target_enclosed", "mouth_reopened"};
  EXPECT_EQ(capture_events(simulation), kinds) << "what an open mouth holds is not lost yet";
  for (double& z : simulation.state().z) z += 10;
  simulation.advance_to(simulation.step() + 1);
  simulation.note_events(simulation.look());
  kinds.push_back("target_lost");
  EXPECT_EQ(capture_events(simulation), kinds);
}

TEST(Combinations, TowingThreadAndLaunchShareTheDiagonalOfAnOblongNet) {
  const Assembly assembly = assemble(parse_case(material + net + R"([mechanism.m]
corner = "net.main.top_right"
launcher_mass_kg = 0.05
split_mass_kg = 0.1
towing_material = "t"
towing_diameter_m = 0.002
launch_speed_m_s = 1
launch_angle_deg = 90
separation_a_m_s = [0, 0, 0]
separation_b_m_s = [0, 0, 0]
)",
                                                "oblong.toml"));
  const AssemblyNode& corner = assembly.nodes[static_cast<std::size_t>(assembly.elements.back().a)];
  const AssemblyNode& launcher = assembly.nodes[static_cast<std::size_t>(assembly.elements.back().b)];
  const Vec3 towing = (launcher.position - corner.position).normalized();
  EXPECT_LT((towing - launcher.velocity.normalized()).norm(), 1e-12);
  EXPECT_LT((towing - Vec3(3, 1, 0).normalized()).norm(), 1e-12);
}

// Twelve threads meet one ring of 20 mg at the same time: each contact alone would be stable at this step.
TEST(ContactWatch, AddsUpContactsThatShareAMass) {
  std::string text =
      "schema = 1\n[time]\nend_s = 0.1\nsafety = 0.9\n" + material.substr(material.find("[material"));
  text +=
      "[ring.r]\ndiameter_m = 0.1\nwire_diameter_m = 0.004\nmass_kg = 2e-5\nyoungs_modulus_Pa = 70e9\n"
      "center_m = [0, 0, 0]\nnormal = [1, 0, 0]\nvelocity_m_s = [0.4, 0, 0]\n";
  for (int k = 0; k < 12; ++k) {
    const double at = 2 * std::numbers::pi * k / 12, c = std::cos(at), s = std::sin(at);
    char line[400];
    std::snprintf(line, sizeof line,
                  "[thread.t%d]\nmaterial = \"t\"\ndiameter_m = 0.002\nelements = 20\n"
                  "points_m = [[0.01, %.9f, %.9f], [0.01, %.9f, %.9f]]\n"
                  "start = { support = \"fixed\" }\nend = { support = \"fixed\" }\n",
                  k, 0.05 * c - 0.2 * s, 0.05 * s + 0.2 * c, 0.05 * c + 0.2 * s, 0.05 * s - 0.2 * c);
    text += line;
  }
  try {
    simulate(text, 0.1);
    FAIL() << "ran through";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("ring 'r'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("thread.t"), std::string::npos) << error.what();
  }
}

TEST(AutomaticStep, IsSmallForThreadsWithoutDamping) {
  const auto share = [](const std::string& damping) {
    const Preparation p =
        prepare(read_case(std::string(CINCH_SOURCE_DIR "/cases/ring_pull.toml"),
                          {{"time.step_s", "auto"}, {"material.thread.damping_ratio", damping}}));
    return p.timeline.after() / p.stable_step;
  };
  EXPECT_GT(share("0.106"), 0.35);
  EXPECT_LE(share("0"), 0.1);
}

// The runtime may give fewer threads than asked for; no share of the work may be lost then.
TEST(Threads, FewerThanAskedForGiveTheSameBits) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("cinch-threads-" + std::to_string(getpid()));
  const auto hash = [&](const std::string& environment, const std::string& name) {
    const std::string command = environment +
                                " '" CINCH_PROGRAM "' run '" CINCH_SOURCE_DIR
                                "/cases/ring_pull.toml' --quiet --set time.end_s=0.002 --threads 3 --out '" +
                                (folder / name).string() + "' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream file(folder / name / "summary.json");
    return nlohmann::json::parse(file).at("state_hash").get<std::string>();
  };
  EXPECT_EQ(hash("OMP_THREAD_LIMIT=1", "one"), hash("OMP_THREAD_LIMIT=8", "three"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace cinch
