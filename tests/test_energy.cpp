// The ledger: its residual falls with the step at the scheme's order, every booked term has its value, and
// keeping the books changes no motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "input/case_reader.hpp"
#include "plan/simulation.hpp"
#include "store/fields.hpp"

namespace {

using namespace cinch;
using Sets = std::vector<Override>;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Scene read(const std::string& name, const Sets& sets = {}) {
  return read_case(std::string(CINCH_SOURCE_DIR) + "/cases/" + name + ".toml", sets);
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Relative residual over a run, root mean square of `looks` looks.
double residual(Scene scene, double step, double end, int looks = 10) {
  scene.time.step = step;
  scene.time.end = end;
  Simulation simulation(scene, 1);
  double sum = 0;
  for (int k = 1; k <= looks; ++k) {
    simulation.advance_to(std::llround(end / looks * k / step));
    const double relative = simulation.summary().relative_residual;
    sum += relative * relative;
  }
  return std::sqrt(sum / looks);
}

// log2 of the ratios of residuals as the step is halved, from `step` on.
std::vector<double> orders(const Scene& scene, double step, double end, int halvings) {
  std::vector<double> list;
  double last = residual(scene, step, end);
  for (int k = 0; k < halvings; ++k) {
    step /= 2;
    const double next = residual(scene, step, end);
    list.push_back(std::log2(last / next));
    last = next;
  }
  return list;
}

// ----------------------------------------------------------------------------------------------------
// The first look

// The kinetic energy of central differences, v(-1/2).v(1/2), is negative in a scene that is let go from rest:
// the books must open with the same.
TEST(Ledger, OpensBalancedInASceneAtRest) {
  const Scene scene = parse_case(R"(
schema = 1
[time]
end_s = 0.1
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.cord]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.rope]
material = "cord"
diameter_m = 0.002
points_m = [[0, 0, 0], [1, 0, 0]]
start = { support = "fixed" }
end = { mass_kg = 0.2 }
)",
                                 "pendulum.toml");
  Simulation simulation(scene, 1);
  for (int step = 0; step < 20; ++step) {
    simulation.advance_to(step);
    EXPECT_NO_THROW(simulation.check_energy(simulation.look()));
    EXPECT_LT(std::abs(simulation.summary().energy.residual), 1e-18) << step;
  }
}

// ----------------------------------------------------------------------------------------------------
// Order of the residual

// A net stretched by 2 % and held along its edges, its middle struck: no element ever goes slack.
Scene plucked_net(double damping_ratio) {
  std::string text = R"(
schema = 1
[time]
end_s = 0.01
step_s = 2e-6
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
damping_ratio = )" + number(damping_ratio) +
                     R"(
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.4, 0.4]
mesh_m = 0.1
stowed_factor = 1.02
[net.main.node."knot.2.2"]
velocity_m_s = [5, 3, 2]
)";
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      if (i % 4 == 0 || j % 4 == 0)
        text += "[net.main.node.\"knot." + std::to_string(i) + "." + std::to_string(j) +
                "\"]\nsupport = \"fixed\"\n";
  return parse_case(text, "plucked.toml");
}

// The thread of the first case, 0.1 mm from the wire at the start.
Scene pulled_ring(const Sets& more = {}) {
  Sets sets{{"thread.main.velocity_m_s", "[0, 0, -1]"}, {"ring.r1.center_m", "[0, 0, 0.0069]"}};
  sets.insert(sets.end(), more.begin(), more.end());
  return read("ring_pull", sets);
}

TEST(EnergyOrder, SecondWithDamping) {
  for (const double order : orders(plucked_net(0.106), 8e-6, 0.008, 3)) EXPECT_NEAR(order, 2, 0.3);
}

TEST(EnergyOrder, SecondWithoutDamping) {
  for (const double order : orders(plucked_net(0), 8e-6, 0.008, 3)) EXPECT_NEAR(order, 2, 0.2);
}

// A slack element strikes the ball with its middle and flies off again.
Scene struck_ball(double alpha) {
  Scene scene = parse_case(R"(schema = 1
[time]
end_s = 0.1
[contact]
alpha_target_s_m = 0
[material.m]
youngs_modulus_Pa = 1e6
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.002
elements = 1
points_m = [[-0.152, -0.05, 0], [-0.152, 0.05, 0]]
length_m = 0.15
velocity_m_s = [1, 0, 0]
start = { mass_kg = 0.005 }
end = { mass_kg = 0.005 }
[target.ball]
center_m = [0, 0, 0]
radius_m = 0.15
youngs_modulus_Pa = 1e6
)",
                           "struck.toml");
  scene.contact.alpha_target = alpha;
  return scene;
}

// Velocities are those of half a step before; what that comes to is known once the contact is over.
TEST(EnergyOrder, SecondThroughAWholeContactWithDamping) {
  for (const double alpha : {0.05, 0.25}) {
    const double coarse = residual(struck_ball(alpha), 4e-4, 0.08, 1);
    const double fine = residual(struck_ball(alpha), 5e-6, 0.08, 1);
    EXPECT_GT(coarse, 1e-6) << alpha;
    EXPECT_GT(std::log(coarse / fine) / std::log(80), 1.7) << alpha;
  }
}

TEST(EnergyOrder, SecondInContactWithoutDamping) {
  const Scene scene = pulled_ring({{"material.thread.damping_ratio", "0"}, {"contact.alpha_ring_s_m", "0"}});
  for (const double order : orders(scene, 1e-6, 0.0006, 3)) EXPECT_NEAR(order, 2, 0.4);
}

// ----------------------------------------------------------------------------------------------------
// Closing

// A slack net of one mesh, the ends of its upper side at different velocities; a slack closing thread is laid
// along it.
Scene carrier(int elements) {
  return parse_case(R"(
schema = 1
[time]
end_s = 2e-4
step_s = 1e-6
[closing]
time_s = 1e-4
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.1, 0.1]
mesh_m = 0.1
stowed_factor = 0.6
[net.main.node.top_left]
velocity_m_s = [1, 2, 3]
mass_kg = 0.001
[net.main.node.top_right]
velocity_m_s = [-1, 0.5, 2]
mass_kg = 0.002
[thread.laid]
material = "m"
diameter_m = 0.002
along = ["net.main.top"]
length_m = 0.3
elements = )" + std::to_string(elements),
                    "carrier.toml");
}

// Nodes i = 1 .. n-1 of mass M/n lie at s = i/n. Superposed, each has the energy m/2 ((1-s) v_a^2 + s v_b^2),
// laid m/2 |(1-s) v_a + s v_b|^2: it loses m/2 s (1-s) |v_b - v_a|^2, together M dv^2/12 (1 - 1/n^2).
TEST(Closing, LayingCostsATwelfthOfTheThreadsMass) {
  const double dv2 = Vec3(2, 1.5, 1).squaredNorm();
  for (const int n : {1, 2, 7, 50}) {
    SCOPED_TRACE(n);
    Simulation simulation(carrier(n), 1);
    simulation.advance_to(200);
    double mass = 0;  // of the laid thread
    const Assembly& assembly = simulation.preparation().assembly;
    for (Index i = assembly.nodes_before; i < assembly.node_count(); ++i)
      mass += simulation.model().mass[at(i)];
    const Summary summary = simulation.summary();
    const double expected = mass * dv2 / 12 * (1 - 1.0 / (n * n));
    EXPECT_NEAR(summary.energy.booked_activation, expected, 1e-12 * summary.energy_initial);
    EXPECT_NEAR(summary.energy.kinetic, summary.energy_initial - expected, 1e-12 * summary.energy_initial);
    EXPECT_LE(summary.relative_residual, 1e-12);
    EXPECT_EQ(summary.energy.work_separation, 0);
  }
}

TEST(Closing, KeepsLinearMomentumToRounding) {
  Scene uneven = read("capture", {{"closing.time_s", "0.0005"}}), two_steps = uneven;
  for (Thread& thread : uneven.threads) thread.elements = 31;  // their masses move when they are laid
  two_steps.closing.step = 0.6e-6;
  Scene both = uneven;
  both.closing.step = 1.7e-6;
  for (const Scene& scene : {carrier(50), read("capture", {{"closing.time_s", "0.0005"}}),
                             read("capture", {{"closing.time_s", "0.0005"}, {"net.main.stowed_factor", "1"}}),
                             uneven, two_steps, both}) {
    SCOPED_TRACE(scene.name);
    Simulation simulation(scene, 1);
    const std::int64_t closing = simulation.preparation().closing_step;
    simulation.advance_to(closing - 1);
    ASSERT_FALSE(simulation.closed_phase());
    const Vec3 before = half_step_momentum(simulation.model(), simulation.state()).linear;
    simulation.advance_to(closing);
    ASSERT_TRUE(simulation.closed_phase());
    const double scale = before.norm();
    EXPECT_LE((half_step_momentum(simulation.model(), simulation.state()).linear - before).norm(),
              1e-13 * scale);
    simulation.advance_to(closing + 20);
    EXPECT_LE((half_step_momentum(simulation.model(), simulation.state()).linear - before).norm(),
              1e-13 * scale);
    EXPECT_LE(simulation.summary().linear_momentum_drift, 1e-13 * scale);
    EXPECT_LE(simulation.summary().angular_momentum_drift.value(), 1e-13 * scale);
  }
}

// One mechanism pushes its masses unequally: its launcher recoils. All threads are slack.
TEST(Closing, SeparationPutsInTheKineticEnergyOfTheJumps) {
  for (const char* time : {"0", "0.0005"}) {
    SCOPED_TRACE(time);
    Simulation simulation(
        read("capture", {{"closing.time_s", time}, {"mechanism.m2.separation_a_m_s", "[-3, 2, 0.5]"}}), 1);
    const Assembly& a = simulation.preparation().assembly;
    const auto& all = simulation.preparation().whole().mass;
    double expected = 0;
    const auto add = [&](const std::string& node, const Vec3& v, const Vec3& jump) {
      const double mass = all[at(a.node_of(node))];
      expected += mass / 2 * ((v + jump).squaredNorm() - v.squaredNorm());
    };
    // launched at 1 m/s, 35 degrees to Z along the diagonals; the towing threads are slack yet
    const double out = std::sin(35 * std::acos(-1.0) / 180) / std::sqrt(2),
                 ahead = std::cos(35 * std::acos(-1.0) / 180);
    const Vec3 jump_a[4] = {{-2, -2, 0}, {-3, 2, 0.5}, {2, 2, 0}, {2, -2, 0}};
    const Vec3 jump_b[4] = {{2, 2, 0}, {2, -2, 0}, {-2, -2, 0}, {-2, 2, 0}};
    const Vec3 launch[4] = {{-out, out, ahead}, {out, out, ahead}, {out, -out, ahead}, {-out, -out, ahead}};
    for (std::size_t m = 0; m < 4; ++m) {
      const std::string mechanism = "mechanism.m" + std::to_string(m + 1);
      add(mechanism + ".a", launch[m], jump_a[m]);
      add(mechanism + ".b", launch[m], jump_b[m]);
    }
    const double split = all[at(a.node_of("mechanism.m2.a"))];
    const double launcher = all[at(a.node_of("mechanism.m2.launcher"))];
    add("mechanism.m2.launcher", launch[1], -split / launcher * (jump_a[1] + jump_b[1]));

    simulation.advance_to(simulation.preparation().closing_step);
    const Summary summary = simulation.summary();
    EXPECT_NEAR(summary.energy.work_separation, expected, 1e-10 * expected);
    EXPECT_LE(summary.relative_residual, 1e-12);
    EXPECT_LE(summary.linear_momentum_drift, 1e-13);
  }
}

// ----------------------------------------------------------------------------------------------------
// The couple that eq. (12) drops

// A ring on a bar that turns at 20 rad/s about Y; a stiff thread off the ring's centre stands in its way.
Scene turning_host(const std::string& couple) {
  return parse_case(R"(
schema = 1
[time]
end_s = 0.02
step_s = 5e-7
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.bar]
material = "m"
diameter_m = 0.002
elements = 1
points_m = [[-0.02, 0, 0], [0.02, 0, 0]]
start = { velocity_m_s = [0, 0, 0.4], mass_kg = 0.001 }
end = { velocity_m_s = [0, 0, -0.4], mass_kg = 0.001 }
[thread.across]
material = "m"
diameter_m = 0.002
elements = 20
points_m = [[-0.05, 0, 0.0068], [0.05, 0, 0.0068]]
start = { support = "fixed" }
end = { support = "fixed" }
[ring.r]
joint = "contact"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.001
youngs_modulus_Pa = 70e9
on = "thread.bar"
element = 0
threads = ["across"]
[contact]
couple = ")" + couple + "\"\n",
                    "turning.toml");
}

TEST(DroppedCouple, IsBookedWithThePapersRule) {
  Simulation simulation(turning_host("paper"), 1);
  simulation.advance_to(40000);
  const Summary summary = simulation.summary();
  ASSERT_GT(summary.ring_records.front().peak_force, 0) << "the ring must be touched";
  const double scale = std::abs(summary.energy_initial);
  const double without = std::abs(summary.energy.residual + summary.energy.booked_couple) / scale;
  EXPECT_LE(summary.relative_residual, 1e-4);
  EXPECT_GT(without, 0.005) << "the term must matter in this scene";
  EXPECT_GT(without, 50 * summary.relative_residual);
  EXPECT_LE(summary.angular_momentum_drift.value(), 1e-15) << "the dropped torque impulse is booked as well";
}

TEST(DroppedCouple, IsNothingWithTheConservingRule) {
  Simulation simulation(turning_host("conserving"), 1);
  simulation.advance_to(40000);
  const Summary summary = simulation.summary();
  ASSERT_GT(summary.ring_records.front().peak_force, 0);
  EXPECT_EQ(summary.energy.booked_couple, 0);
  EXPECT_LE(summary.relative_residual, 1e-4);
  EXPECT_LE(summary.angular_momentum_drift.value(), 1e-15);
}

// ----------------------------------------------------------------------------------------------------
// Without books

TEST(LedgerOff, MovesTheSameAndBooksNoDamper) {
  for (const char* name : {"ring_pull", "capture"}) {
    SCOPED_TRACE(name);
    Sets sets{{"closing.time_s", "0.0005"},
              {"net.main.stowed_factor", "1"},
              {"target.ball.center_m", "[0.05, 0, 0.1505]"}};
    if (name == std::string("ring_pull"))
      sets = {{"thread.main.velocity_m_s", "[0, 0, -1]"}, {"ring.r1.center_m", "[0, 0, 0.0069]"}};
    Simulation with(read(name, sets), 1);
    sets.push_back({"output.ledger", "false"});
    Simulation without(read(name, sets), 1);
    with.advance_to(5000);
    without.advance_to(5000);
    const Frame kept = with.frame(), left = without.frame();
    EXPECT_EQ(state_hash(with.state()), state_hash(without.state()));
    EXPECT_GT(kept.energy.dissipated_damper, 0);
    EXPECT_EQ(left.energy.dissipated_damper, 0);
    EXPECT_EQ(kept.energy.kinetic, left.energy.kinetic);
    EXPECT_EQ(kept.energy.elastic, left.energy.elastic);
    EXPECT_TRUE(std::isfinite(with.summary().relative_residual));
    EXPECT_TRUE(std::isnan(without.summary().relative_residual));  // no residual without books
  }
}

}  // namespace
