// Threads and nets against textbook mechanics. Each tolerance is followed by the reason for its size.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>
#include <regex>
#include <string>

#include "base/error.hpp"
#include "plan/stable_step.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

using namespace test;
using std::numbers::pi;

// ---- stable step

/// Straight chain between two fixed ends, stretched by `strain`; zeta = xi / 2 gives the wanted xi.
Scene chain(int elements, double xi, double strain) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 1000
[thread.main]
material = "m"
diameter_m = 0.002
elements = 10
points_m = [[0, 0, 0], [1, 0, 0]]
start = { support = "fixed" }
end = { support = "fixed" }
)");
  scene.materials["m"].damping_ratio = xi / 2;
  scene.threads[0].elements = elements;
  scene.threads[0].length = 1 / (1 + strain);
  return scene;
}

/// (2 / omega) (sqrt(1 + xi^2) - xi) with omega = 2 sqrt(k / m), m one element's mass (model.md, section 3).
double closed_form_step(const Scene& scene, double xi) {
  const Thread& thread = scene.threads[0];
  const Material& material = scene.materials.at("m");
  const double l0 = thread.length / thread.elements;
  const double omega = 2 * std::sqrt(material.youngs_modulus / material.density) / l0;
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

constexpr double xis[] = {0, 0.05, 0.212, 1};

TEST(StableStep, LongUniformChain) {
  for (const double xi : xis) {
    const Scene scene = chain(50, xi, 0.01);
    // the same number by another formula: rounding only
    EXPECT_NEAR(prepare(scene).stable_step / closed_form_step(scene, xi), 1, 1e-12) << "xi = " << xi;
  }
}

TEST(StableStep, EndMassesAndFreeEndsDoNotRaiseOrLowerIt) {
  for (const double xi : xis) {
    Scene scene = chain(50, xi, 0.01);
    const double expected = closed_form_step(scene, xi);
    scene.threads[0].start = {};
    EXPECT_NEAR(prepare(scene).stable_step / expected, 1, 1e-12) << "free end, xi = " << xi;
    scene.threads[0].start.mass = 0.5;
    EXPECT_NEAR(prepare(scene).stable_step / expected, 1, 1e-12) << "end mass, xi = " << xi;
  }
}

/// Highest mode of the chain: speeds (-1)^j sin(j pi / n), from rest at the straight shape.
void shake(Simulation& sim, double speed) {
  const Index n = sim.model().elements;
  for (Index j = 1; j < n; ++j) sim.state().vx[at(j)] = (j % 2 ? -speed : speed) * std::sin(j * pi / n);
}

/// Greatest deviation from the straight shape over `steps` steps.
double swing(Simulation& sim, const std::vector<Vec3>& rest, int steps) {
  double greatest = 0;
  for (int s = 0; s < steps; ++s) {
    sim.advance_to(sim.step() + 1);
    for (Index i = 0; i < sim.model().nodes; ++i)
      greatest = std::max(greatest, (place(sim, i) - rest[at(i)]).norm());
  }
  return greatest;
}

/// Largest |lambda| of x(n+1) = (2 - W^2 - 2 xi W) x(n) - (1 - 2 xi W) x(n-1), W = omega dt of the chain's
/// highest mode.
double growth_factor(double xi_uniform, double step_over_bound, int elements) {
  const double share = std::cos(pi / (2 * elements));  // its omega over 2 sqrt(k/m)
  const double w = 2 * (std::sqrt(1 + xi_uniform * xi_uniform) - xi_uniform) * step_over_bound * share;
  const double p = 2 - w * w - 2 * xi_uniform * share * w, q = 1 - 2 * xi_uniform * share * w;
  const double root = p * p / 4 - q;
  return root > 0 ? std::abs(p) / 2 + std::sqrt(root) : std::sqrt(q);
}

Scene stepped_chain(double xi, double step_over_bound) {
  Scene scene = chain(40, xi, 0.01);
  scene.time.step = step_over_bound * closed_form_step(scene, xi);
  scene.time.allow_unstable = step_over_bound > 1;
  return scene;
}

TEST(StableStep, JustBelowItAChainStaysBounded) {
  for (const double xi : xis) {
    Simulation sim(stepped_chain(xi, 0.99), 1);
    const auto rest = places(sim);
    shake(sim, 1e-4);
    const double first = swing(sim, rest, 500);
    sim.advance_to(100000);
    const double last = swing(sim, rest, 500);
    // undamped: the mode keeps its amplitude; its weak coupling to others through tension (strain 1 %) is all
    // that moves
    EXPECT_LT(last, 1.05 * first) << "xi = " << xi;
    if (xi == 0) {
      EXPECT_GT(last, 0.9 * first);
    }
  }
}

TEST(StableStep, JustAboveItAChainGrowsAsTheRecurrenceTells) {
  for (const double xi : xis) {
    Simulation sim(stepped_chain(xi, 1.01), 1);
    const auto rest = places(sim);
    shake(sim, 1e-6);
    const auto amplitude = [&] { return std::abs((place(sim, 20) - rest[20]).x()); };
    sim.advance_to(20);
    const double before = amplitude();
    sim.advance_to(30);
    // linear recurrence of one mode: what is left of the other root after 20 steps, and the neighbouring
    // modes
    EXPECT_NEAR(std::pow(amplitude() / before, 0.1) / growth_factor(xi, 1.01, 40), 1, 1e-4) << "xi = " << xi;
    EXPECT_GT(growth_factor(xi, 1.01, 40), 1.005);
    // and it goes on until the elements go slack (strain 1 %, elements of 25 mm) or the speed limit stops it
    try {
      sim.advance_to(5000);
      EXPECT_GT(swing(sim, rest, 100), 2e-5) << "xi = " << xi;
    } catch (const NumericalError&) {
    }
  }
}

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Index index(Index count) { return std::uniform_int_distribution<Index>(0, count - 1)(engine_); }
  Vec3 direction() { return Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized(); }

 private:
  std::mt19937 engine_;
};

void join(Model& model, Index a, Index b, double k, double c) {
  model.end_a.push_back(a);
  model.end_b.push_back(b);
  model.stiffness.push_back(k);
  model.damping.push_back(c);
  model.elements += 1;
}

/// Connected graph with masses, stiffnesses and dampers over three decades, some nodes fixed.
Model random_graph(Dice& dice, bool damped) {
  Model model;
  model.nodes = 2 + dice.index(10);
  for (Index i = 0; i < model.nodes; ++i) {
    model.mass.push_back(dice.log_uniform(1e-3, 1));
    if (i > 0 && dice.uniform(0, 1) < 0.15) model.constraints.push_back({i, 0, 0, 0, model.mass.back()});
  }
  const auto k = [&] { return dice.log_uniform(1, 1e3); };
  const auto c = [&] { return damped ? dice.log_uniform(1e-3, 3) : 0.0; };
  for (Index i = 1; i < model.nodes; ++i) join(model, dice.index(i), i, k(), c());
  for (Index extra = dice.index(2 * model.nodes); extra > 0; --extra) {
    const Index a = dice.index(model.nodes), b = dice.index(model.nodes);
    if (a != b) join(model, a, b, k(), c());
  }
  return model;
}

/// Largest eigenvalue of M^-1 (dt^2/4 K + dt/2 C), elements as they lie along `along` (all taut), fixed nodes
/// left out.
double largest_usage(const Model& model, double dt, const std::vector<Vec3>& along) {
  const Index size = 3 * model.nodes;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (Index e = 0; e < model.elements; ++e) {
    const double kappa = dt * dt / 4 * model.stiffness[at(e)] + dt / 2 * model.damping[at(e)];
    const Eigen::Matrix3d block = kappa * along[at(e)] * along[at(e)].transpose();
    const Index a = 3 * model.end_a[at(e)], b = 3 * model.end_b[at(e)];
    matrix.block<3, 3>(a, a) += block;
    matrix.block<3, 3>(b, b) += block;
    matrix.block<3, 3>(a, b) -= block;
    matrix.block<3, 3>(b, a) -= block;
  }
  Eigen::VectorXd scale(size);
  for (Index i = 0; i < model.nodes; ++i)
    scale.segment<3>(3 * i).setConstant(1 / std::sqrt(model.mass[at(i)]));
  for (const auto& fixed : model.constraints) scale.segment<3>(3 * fixed.node).setZero();
  matrix = scale.asDiagonal() * matrix * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

TEST(StableStep, NeverOptimisticOnRandomGraphs) {
  Dice dice(7);
  double sharpest = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Model model = random_graph(dice, trial % 2 == 1);
    const double dt = stable_step(model).step;
    std::vector<Vec3> along(at(model.elements), Vec3::UnitX());
    const double straight = largest_usage(model, dt, along);
    for (Vec3& direction : along) direction = dice.direction();
    const double bent = largest_usage(model, dt, along);
    // a theorem, so rounding of the eigenvalues only
    EXPECT_LE(straight, 1 + 1e-12) << "trial " << trial;
    EXPECT_LE(bent, straight * (1 + 1e-12)) << "trial " << trial;
    // and with all elements in line no worse than twice: an eigenvalue is at least the largest diagonal entry
    EXPECT_GE(straight, 0.5 - 1e-12) << "trial " << trial;
    sharpest = std::max(sharpest, straight);
  }
  EXPECT_GT(sharpest, 0.999);  // two nodes and one element: exact
}

TEST(StableStep, NeverOptimisticOnANetWithRingsAndMasses) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.6, 0.4]
mesh_m = 0.1
node.top_left = { support = "fixed" }
node.bottom_left = { mass_kg = 0.3 }
[thread.tether]
material = "m"
diameter_m = 0.003
elements = 4
points_m = [[0, 0, 0.2], [0, 0, 0]]
end = { on = "net.main.knot.3.2" }
[rings.r]
net = "main"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.001
youngs_modulus_Pa = 7e10
)");
  const Preparation p = prepare(scene);
  const Model& model = p.phases[0].model;
  std::vector<Vec3> along;
  for (Index e = 0; e < model.elements; ++e)
    along.push_back((p.assembly.nodes[at(model.end_b[at(e)])].position -
                     p.assembly.nodes[at(model.end_a[at(e)])].position)
                        .normalized());
  const double usage = largest_usage(model, p.stable_step, along);
  EXPECT_LE(usage, 1 + 1e-12);
  EXPECT_GE(usage, 0.4);  // where four threads cross, only two pull along one line
}

TEST(StableStep, LittleDampingKeepsTheAutomaticStepFarFromIt) {
  for (const auto& [damping, most] : {std::pair{0.0, 0.1}, {0.007, 0.2}, {0.02, 0.3}, {0.106, 0.8}}) {
    Scene scene = chain(20, 0, 0.01);
    for (auto& [name, material] : scene.materials) material.damping_ratio = damping;
    scene.time.step = 0, scene.time.safety = 0.8, scene.output.frame_interval = 1;
    const Preparation p = prepare(scene);
    EXPECT_LE(p.timeline.after(), most * p.stable_step);
    EXPECT_GT(p.timeline.after(), 0.99 * most * p.stable_step);
  }
}

// A thread of ten elements springs back from twice its length, for a second.
TEST(StableStep, TheAutomaticOneKeepsEnergyOfAThreadWithLittleDamping) {
  for (const double damping : {0.005, 0.01, 0.02, 0.05, 0.106}) {
    Scene scene = thread_scene(1e9, damping, R"(
elements = 10
length_m = 1
points_m = [[0, 0, 0], [0, 2, 0]]
start = { mass_kg = 0.1 }
end = { support = "fixed" }
)");
    Simulation sim(scene, 1);
    run_until(sim, 1);
    EXPECT_LT(sim.summary().relative_residual, 0.015) << "damping ratio " << damping;
  }
}

TEST(StableStep, AGivenStepAboveItIsRefusedWithOneThatWorks) {
  const std::string text = R"(schema = 1
[time]
end_s = 0.01
step_s = 1e-4
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.slow]
material = "m"
diameter_m = 0.002
elements = 3
points_m = [[0, 1, 0], [1, 1, 0]]
[thread.main]
material = "m"
diameter_m = 0.002
elements = 3
points_m = [[0, 0, 0], [0.1, 0, 0]]
length_m = 0.099
start = { support = "fixed" }
end = { support = "fixed" }
)";
  std::string message;
  try {
    Simulation sim(scene_of(text), 1);
  } catch (const CaseError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("test.toml:4"), std::string::npos) << message;
  EXPECT_NE(message.find("element 1 of thread.main"), std::string::npos) << message;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(message, found, std::regex("largest step that works is ([0-9.e+-]+) s")))
      << message;
  const double step = std::stod(found[1]);
  Scene scene = scene_of(text);
  scene.time.step = step;
  Simulation sim(scene, 1);
  sim.advance_to(1000);
  EXPECT_GT(step, 0.999 * sim.preparation().stable_step);  // four digits, rounded down
  scene.time.step = 1.002 * step;
  EXPECT_THROW(Simulation(scene, 1), CaseError);
  scene.time.allow_unstable = true;
  EXPECT_NO_THROW(Simulation(scene, 1));
}

// ---- waves

TEST(Waves, BarWaveFrontMovesAtTheSpeedOfSound) {
  // A mass too heavy to be held back pulls the far end away at 0.1 m/s. On a lattice the front's foot is an
  // Airy function: node j reaches a third of the speed when the front of the continuum passes it.
  Scene scene = chain(400, 0, 0.01);
  scene.threads[0].end = {};
  scene.threads[0].end.mass = 1e4;
  scene.threads[0].end.velocity = Vec3(0.1, 0, 0);
  Simulation sim(scene, 1);
  const auto arrival = [&](Index node) {
    double before = 0;
    for (;;) {
      sim.advance_to(sim.step() + 1);
      const double v = sim.state().vx[at(node)];
      if (v >= 0.1 / 3) return sim.time() - step_of(sim) * (0.5 + (v - 0.1 / 3) / (v - before));
      before = v;
    }
  };
  const double first = arrival(350), second = arrival(50);
  const double distance =
      300 * scene.threads[0].length / 400;  // unstretched: waves are carried by the material
  // next term of the lattice's front: a shift of a small part of an element's length, in 300
  EXPECT_NEAR(distance / (second - first) / std::sqrt(1e8 / 1000), 1, 1e-3);
}

TEST(Waves, TransverseWaveMovesAtTheSquareRootOfTensionOverMass) {
  const double strain = 0.02;
  Scene scene = chain(400, 0, strain);
  scene.threads[0].points = {{0, 0, 0}, {0.45, 0, 0}, {0.5, 1e-4, 0}, {0.55, 0, 0}, {1, 0, 0}};
  Simulation sim(scene, 1);
  const auto center = [&] {  // of the half that runs to the right
    double sum = 0, moment = 0;
    for (const Vec3& p : places(sim))
      if (p.x() > 0.5) {
        sum += p.y();
        moment += p.y() * p.x();
      }
    return moment / sum;
  };
  const double speed = std::sqrt(1e8 * strain * (1 + strain) / 1000);  // T / mu, mu of the stretched thread
  run_until(sim, 0.1 / speed);
  const double t1 = sim.time(), x1 = center();
  run_until(sim, 0.3 / speed);
  // the lattice delays the pulse by (wave number x element length)^2 / 24; 0.1 m pulse, 2.5 mm elements: 1e-3
  EXPECT_NEAR((center() - x1) / (sim.time() - t1) / speed, 1, 1e-3);
}

// ---- one mass

/// A mass on one element: E A = 1e6 N, l0 = 1 m, 1 kg at the end, the thread's own 1e-6 kg.
Scene one_element(const Vec3& end, double damping_ratio) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 100
[material.m]
youngs_modulus_Pa = 1e12
density_kg_m3 = 1
[thread.main]
material = "m"
diameter_m = 0.0011283791670955126
elements = 1
points_m = [[0, 0, 0], [1, 0, 0]]
length_m = 1
start = { support = "fixed" }
end = { mass_kg = 1 }
)");
  scene.threads[0].points[1] = end;
  scene.materials["m"].damping_ratio = damping_ratio;
  return scene;
}

/// Period of the pendulum from its zero crossings.
double pendulum_period(double degrees, int swings) {
  const double angle = degrees * pi / 180, stretched = 1 + g0 * std::cos(angle) / 1e6;
  Scene scene = one_element(stretched * Vec3(std::sin(angle), 0, -std::cos(angle)), 0);
  scene.gravity = Vec3(0, 0, -g0);
  Simulation sim(scene, 1);
  std::vector<double> crossings;
  double before = place(sim, 1).x();
  while (crossings.size() < at(swings) + 1) {
    sim.advance_to(sim.step() + 1);
    const double x = place(sim, 1).x();
    if (before < 0 && x >= 0) crossings.push_back(sim.time() - step_of(sim) * x / (x - before));
    before = x;
  }
  return (crossings.back() - crossings.front()) / swings;
}

TEST(OneMass, PendulumPeriod) {
  // the thread gives by at most (3 - 2 cos angle) m g / E A, 2e-5 of its length at 60 degrees; the period by
  // half of that; 1 degree of amplitude lengthens it by angle^2 / 16 = 2e-5
  EXPECT_NEAR(pendulum_period(1, 5) / (2 * pi * std::sqrt(1 / g0)), 1, 3e-5);
  EXPECT_NEAR(pendulum_period(60, 5) / (4 * std::sqrt(1 / g0) * std::comp_ellint_1(0.5)), 1, 1.5e-5);
  EXPECT_NEAR(std::comp_ellint_1(0.5), 1.685750, 1e-6);
}

TEST(OneMass, FreeFallIsExact) {
  Scene scene = one_element({0.3, 0, 0}, 0.1);  // slack
  scene.materials["m"].youngs_modulus = 1e9;
  scene.materials["m"].density = 1e4;
  scene.gravity = Vec3(0.5, -1, -g0);
  scene.threads[0].start = {};
  scene.threads[0].velocity = Vec3(1, 2, 3);
  scene.time.step = 1e-4;
  Simulation sim(scene, 1);
  const double t = 3;
  run_until(sim, t);
  const Vec3 fallen = t * Vec3(1, 2, 3) + t * t / 2 * *scene.gravity;
  // central differences are exact for constant acceleration; 3e4 sums of numbers below 50
  EXPECT_LT((place(sim, 0) - fallen).norm(), 1e-10);
  EXPECT_LT((place(sim, 1) - fallen - Vec3(0.3, 0, 0)).norm(), 1e-10);
}

/// Mass between two fixed ends on two stretched elements of k = 2000 N/m and l0 = 0.5 m, pushed along the
/// line.
Scene between_two(double damping_ratio, double speed) {
  Scene scene = one_element({1.1, 0, 0}, damping_ratio);
  scene.materials["m"].youngs_modulus = 1e9;
  scene.materials["m"].density = 1e6;  // 0.5 kg an element, so that the dampers matter
  scene.threads[0].elements = 2;
  scene.threads[0].end = {};
  scene.threads[0].end.support = Support::fixed;
  scene.threads[0].nodes[1].mass = 0.5;
  scene.threads[0].nodes[1].velocity = Vec3(speed, 0, 0);
  return scene;
}

/// Error of the middle mass' place at 1 s, against v/w exp(-d t) sin(w t), with `steps` steps.
double oscillator_error(double damping_ratio, int steps) {
  const double k = 2 * 2000, c = 2 * 2 * damping_ratio * std::sqrt(2000 * 0.5), m = 0.5 + 0.5, v = 0.5;
  Scene scene = between_two(damping_ratio, v);
  scene.time.step = 1.0 / steps;
  Simulation sim(scene, 1);
  sim.advance_to(steps);
  const double decay = c / (2 * m), omega = std::sqrt(k / m - decay * decay);
  return place(sim, 1).x() - 0.55 - v / omega * std::exp(-decay) * std::sin(omega);
}

TEST(OneMass, SecondOrderWithoutDamping) {
  const double coarse = oscillator_error(0, 1000), middle = oscillator_error(0, 2000),
               fine = oscillator_error(0, 4000);
  EXPECT_NEAR(coarse / middle, 4, 0.03);  // next term of the error: (omega dt)^2 = 4e-3 of it
  EXPECT_NEAR(middle / fine, 4, 0.01);
  // phase error omega t (omega dt)^2 / 24 of amplitude v / omega, at cos(omega t)
  const double omega = std::sqrt(4000.0), dt = 1.0 / 4000;
  EXPECT_NEAR(fine / (0.5 / omega * omega * std::pow(omega * dt, 2) / 24 * std::cos(omega)), 1, 0.05);
}

TEST(OneMass, FirstOrderWithDamping) {
  const double coarse = oscillator_error(0.02, 4000), middle = oscillator_error(0.02, 8000),
               fine = oscillator_error(0.02, 16000);
  EXPECT_NEAR(coarse / middle, 2, 0.1);  // second-order part of the error: omega dt / zeta of it
  EXPECT_NEAR(middle / fine, 2, 0.05);
}

TEST(OneMass, DecayRateOfADampedThread) {
  // Hanging mass of M kg on one element: decay c / (2 m) with c = 2 zeta sqrt(k m_e).
  for (const double zeta : {0.02, 0.106, 0.4}) {
    Scene scene = one_element({0, 0, -1}, zeta);
    scene.materials["m"].youngs_modulus = 1e9;  // k = 1000 N/m
    scene.materials["m"].density = 1e5;         // m_e = 0.1 kg
    scene.threads[0].end.mass = 0.95;           // 1 kg with half of the element
    scene.gravity = Vec3(0, 0, -g0);
    const double k = 1000, rest = 1 + g0 / k, c = 2 * zeta * std::sqrt(k * 0.1);
    scene.threads[0].points[1].z() = -(rest + 0.005);  // half the static stretch further: stays taut
    scene.time.step = 1e-5;
    Simulation sim(scene, 1);
    const double decay = c / 2, omega = std::sqrt(k - decay * decay);
    double worst = 0;
    while (sim.time() < 1) {
      sim.advance_to(sim.step() + 1000);
      const double t = sim.time();
      const double expected =
          0.005 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
      worst = std::max(worst, std::abs(-place(sim, 1).z() - rest - expected));
    }
    // lagging the damper by dt/2 changes the decay by a part omega dt = 3e-4 at most
    EXPECT_LT(worst, 3e-4 * 0.005) << "zeta = " << zeta;
  }
}

// ---- two masses

/// Two masses joined by one element, k = 1000 N/m, l0 = 1 m, 1 and 2 kg, laid along x with `length`.
Scene two_masses(double length) {
  Scene scene = one_element({length, 0, 0}, 0);
  scene.materials["m"].youngs_modulus = 1e9;
  scene.materials["m"].density = 1e-6;
  scene.threads[0].start = {};
  scene.threads[0].start.mass = 2;
  return scene;
}

TEST(TwoMasses, StretchedElementGoesSlackAfterAQuarterPeriod) {
  Scene scene = two_masses(1.1);
  scene.time.step = 1e-6;
  Simulation sim(scene, 1);
  const double omega = std::sqrt(1000 * (1 + 0.5));
  const double quarter = pi / 2 / omega;
  const auto length = [&] { return (place(sim, 1) - place(sim, 0)).x(); };
  for (const double part : {0.25, 0.5, 0.75}) {
    run_until(sim, part * quarter);
    EXPECT_NEAR(length(), 1 + 0.1 * std::cos(omega * sim.time()), 1e-9);  // phase error (omega dt)^2 / 24
  }
  run_until(sim, 2 * quarter);  // from the quarter on they fly freely with omega x stretch
  EXPECT_NEAR(length(), 1 - 0.1 * omega * (sim.time() - quarter),
              1e-7);  // one step's worth of force at the switch
  EXPECT_NEAR(sim.frame().energy.kinetic, 0.5 * 1000 * 0.01, 1e-6);
}

TEST(TwoMasses, SpringPeriodWhileTaut) {
  // A mass between two stretched elements: 20 periods of 2 pi sqrt(m / 2k).
  Scene scene = between_two(0, 0.5);
  scene.time.step = 1e-5;
  Simulation sim(scene, 1);
  std::vector<double> crossings;
  double before = 0;
  while (crossings.size() < 21) {
    sim.advance_to(sim.step() + 1);
    const double x = place(sim, 1).x() - 0.55;
    if (before < 0 && x >= 0) crossings.push_back(sim.time() - step_of(sim) * x / (x - before));
    before = x;
  }
  // (omega dt)^2 / 24 = 2e-8, interpolation of the crossing less
  EXPECT_NEAR((crossings[20] - crossings[0]) / 20 / (2 * pi / std::sqrt(4000.0)), 1, 1e-7);
}

/// Masses that whirl about each other on a stretched, swinging element: place of one at 0.5 s.
Vec3 whirl(int steps, double damping_ratio) {
  Scene scene = two_masses(1.2);
  scene.materials["m"].density = damping_ratio > 0 ? 1e5 : 1e-6;
  scene.materials["m"].damping_ratio = damping_ratio;
  scene.threads[0].start.velocity = Vec3(0, -4, 1);
  scene.threads[0].end.velocity = Vec3(0, 8, 0);
  scene.time.step = 0.5 / steps;
  Simulation sim(scene, 1);
  sim.advance_to(steps);
  return place(sim, 1);
}

double observed_order(double damping_ratio, int steps) {
  const Vec3 a = whirl(steps, damping_ratio), b = whirl(2 * steps, damping_ratio),
             c = whirl(4 * steps, damping_ratio);
  return std::log2((a - b).norm() / (b - c).norm());
}

TEST(TwoMasses, OrderOfTheSchemeInThreeDimensions) {
  EXPECT_NEAR(observed_order(0, 2000), 2, 0.02);    // Richardson; the next term is dt^2 smaller
  EXPECT_NEAR(observed_order(0.1, 2000), 1, 0.03);  // ... dt smaller
}

// ---- hanging things

TEST(Hanging, ElongationOfAChainThatCameToRest) {
  // Lumping keeps rho g L^2 / 2E + M g L / EA exactly: elements carry (i - 1/2) element weights each.
  Scene scene = chain(10, 1, 0);
  Thread& thread = scene.threads[0];
  scene.materials["m"].youngs_modulus = 1e6;
  thread.points[1] = Vec3(0, 0, -1);
  thread.end = {};
  thread.end.mass = 0.002;
  scene.gravity = Vec3(0, 0, -g0);
  Simulation sim(scene, 1);
  run_until(sim, 30);  // the slowest mode is damped by 1e-11 then
  const double elongation = 1000 * g0 / (2 * 1e6) + 0.002 * g0 / (1e6 * circle(0.002));
  EXPECT_NEAR(-place(sim, 10).z() - 1, elongation, 1e-9);
  EXPECT_NEAR(sim.frame().tension[0], (0.002 + 0.95 * 1000 * circle(0.002)) * g0, 1e-9);
}

Scene hanging_rope(int elements) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[start]
equilibrium = true
[material.m]
youngs_modulus_Pa = 1e11
density_kg_m3 = 1000
[thread.rope]
material = "m"
diameter_m = 0.002
elements = 100
points_m = [[0, 0, 0], [0.5, 0, -0.5], [1, 0, 0]]
start = { support = "fixed" }
end = { support = "fixed" }
)");
  scene.threads[0].elements = elements;
  scene.threads[0].length = 2 * 0.4 * std::sinh(1 / (2 * 0.4));
  return scene;
}

/// Largest distance in height from the catenary 0.4 (cosh((x - 1/2) / 0.4) - cosh(1 / 0.8)).
double catenary_error(int elements) {
  Simulation sim(hanging_rope(elements), 1);
  double error = 0;
  for (const Vec3& p : places(sim))
    error = std::max(error, std::abs(p.z() - 0.4 * (std::cosh((p.x() - 0.5) / 0.4) - std::cosh(1.25))));
  return error;
}

TEST(Hanging, CatenaryFromTheStart) {
  const double coarse = catenary_error(40), fine = catenary_error(80);
  EXPECT_NEAR(coarse / fine, 4, 0.1);  // a polygon of equal links: second order
  EXPECT_LT(fine, 5e-5);
}

TEST(Hanging, CatenarySupportsCarryTheWeight) {
  const Scene scene = hanging_rope(100);
  Simulation sim(scene, 1);
  sim.advance_to(1000);
  const double weight = 1000 * circle(0.002) * scene.threads[0].length * g0;
  const auto& reactions = sim.state().reactions;
  ASSERT_EQ(reactions.size(), 2u);
  const double up = (reactions[0].impulse[2] + reactions[1].impulse[2]) / sim.time();
  const double side = std::abs(reactions[0].impulse[0]) / sim.time();
  EXPECT_NEAR(up / weight, 1, 1e-9);  // balance to the static solver's residual
  EXPECT_NEAR(side / (weight / scene.threads[0].length * 0.4), 1, 1e-3);  // H = w a, polygon of 100 links
}

Scene hanging_net() {
  return scene_of(R"(
schema = 1
[time]
end_s = 100
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[start]
equilibrium = true
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.6, 0.4]
mesh_m = 0.1
elements_per_side = 2
x_axis = [1, 0, 0]
y_axis = [0, 0, 1]
node.top_left = { support = "fixed" }
node.top_right = { support = "fixed" }
node.bottom_left = { mass_kg = 0.05 }
)");
}

TEST(Hanging, NetAtRestStaysAtRest) {
  Simulation sim(hanging_net(), 1);
  const auto start = places(sim);
  double moved = 0, lowest = 0;
  for (int part = 1; part <= 10; ++part) {
    sim.advance_to(10000 * part);
    for (Index i = 0; i < sim.model().nodes; ++i) {
      moved = std::max(moved, (place(sim, i) - start[at(i)]).norm());
      lowest = std::min(lowest, place(sim, i).z());
    }
  }
  EXPECT_LT(moved, 1e-9);
  EXPECT_LT(lowest, -0.22);  // and it does hang: the plane net ends at -0.2
}

TEST(Hanging, WithoutEquilibriumTheSameNetFalls) {
  Scene scene = hanging_net();
  scene.equilibrium = false;
  Simulation sim(scene, 1);
  const auto start = places(sim);
  run_until(sim, 0.05);
  double moved = 0;
  for (Index i = 0; i < sim.model().nodes; ++i)
    moved = std::max(moved, (place(sim, i) - start[at(i)]).norm());
  EXPECT_GT(moved, 1e-3);
}

// ---- momentum

/// A free net: stretched by 4 %, thrown, spun and shaken.
Scene flying_net(bool gravity) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.5, 0.5]
mesh_m = 0.1
elements_per_side = 2
center_m = [0.3, -0.2, 0.1]
stowed_factor = 1.04
velocity_m_s = [3, -2, 5]
)");
  Net& net = scene.nets[0];
  Dice dice(3);
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j) {
      NodeSpec& knot = net.nodes["knot." + std::to_string(i) + "." + std::to_string(j)];
      const Vec3 arm(0.1 * i - 0.25, 0.1 * j - 0.25, 0);
      knot.velocity = net.velocity + Vec3(1, -2, 6).cross(arm) + 0.5 * dice.direction();
      knot.mass = dice.uniform(0, 0.01);
    }
  if (gravity) scene.gravity = Vec3(1, 2, -9);
  return scene;
}

struct Motion {
  double mass = 0;
  Vec3 center = Vec3::Zero(), linear = Vec3::Zero(), angular = Vec3::Zero();
};

/// Sums over the nodes, by the test's own loop. x(n) with v(n-1/2): what central differences conserve.
Motion motion_of(const Simulation& sim) {
  Motion sum;
  for (Index i = 0; i < sim.model().nodes; ++i) {
    const double m = sim.model().mass[at(i)];
    const Vec3 v(sim.state().vx[at(i)], sim.state().vy[at(i)], sim.state().vz[at(i)]);
    sum.mass += m;
    sum.center += m * place(sim, i);
    sum.linear += m * v;
    sum.angular += m * place(sim, i).cross(v);
  }
  sum.center /= sum.mass;
  return sum;
}

TEST(Momentum, FreeNetKeepsLinearAndAngularMomentum) {
  Simulation sim(flying_net(false), 1);
  const Motion start = motion_of(sim);
  const double elastic = sim.frame().energy.elastic;
  sim.advance_to(20000);
  const Motion end = motion_of(sim);
  // rounding: 2e4 steps of sums over 96 nodes, at worst 2e4 eps if all errors had one sign
  EXPECT_LT((end.linear - start.linear).norm(), 4e-12 * start.linear.norm());
  EXPECT_LT((end.angular - start.angular).norm(), 4e-12 * start.angular.norm());
  EXPECT_LT(sim.frame().energy.elastic, 0.9 * elastic);  // it did vibrate
  EXPECT_LT(sim.summary().linear_momentum_drift, 4e-12 * start.linear.norm());
  EXPECT_LT(*sim.summary().angular_momentum_drift, 4e-12 * start.angular.norm());
}

TEST(Momentum, ThrownNetsCentreFliesAParabola) {
  Scene scene = flying_net(true);
  Simulation sim(scene, 1);
  const Motion start = motion_of(sim);
  const double half = step_of(sim) / 2;
  const Vec3 velocity =
      start.linear / start.mass + half * *scene.gravity;  // at t = 0, not half a step before
  sim.advance_to(20000);
  const double t = sim.time();
  const Motion end = motion_of(sim);
  // rounding as above, of metres and metres per second
  EXPECT_LT((end.center - start.center - t * velocity - t * t / 2 * *scene.gravity).norm(), 1e-11);
  EXPECT_LT((end.linear / end.mass - velocity - (t - half) * *scene.gravity).norm(), 1e-11);
  EXPECT_LT(sim.summary().linear_momentum_drift, 1e-11);
}

}  // namespace
}  // namespace cinch
