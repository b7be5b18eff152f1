// Threads that slide over rings, against the massless thread on a point: limits that are approached as
// elements get short, threads light and forces on rings small.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "support/scenes.hpp"

namespace cinch {
namespace {

using namespace test;
using std::numbers::pi;

// ---- Atwood's machine: a thread over the wire of a fixed ring

constexpr double wire_radius = 0.02, thread_radius = 0.001, heavy = 0.3, light = 0.2, drop = 0.45;

/// Two masses on a thread of 2 x 0.45 m and half a turn round the wire at (0, 0, 0), stretched to its tension
/// already.
Scene atwood(int elements, double density) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 1000
[thread.main]
material = "m"
diameter_m = 0.002
elements = 100
points_m = [[0, 0, 0], [1, 0, 0]]
start = { mass_kg = 0.2 }
end = { mass_kg = 0.3 }
[ring.pulley]
joint = "contact"
diameter_m = 0.3
wire_diameter_m = 0.04
mass_kg = 1
youngs_modulus_Pa = 1e9
center_m = [0, 0, 0.15]
normal = [0, 1, 0]
support = "fixed"
)");
  scene.materials["m"].density = density;
  Thread& thread = scene.threads[0];
  thread.elements = elements;
  // elements are chords: nodes lie so far outside that the chords just touch the wire
  const double contact = wire_radius + thread_radius, element = (2 * drop + pi * contact) / elements;
  const double radius = std::hypot(contact, element / 2);
  thread.points = {Vec3(0, -radius, -drop)};
  for (int i = 0; i <= 200; ++i) {
    const double angle = pi * (1 - i / 200.0);
    thread.points.emplace_back(0, radius * std::cos(angle), radius * std::sin(angle));
  }
  thread.points.emplace_back(0, radius, -drop);
  const double tension = 2 * heavy * light / (heavy + light) * g0;
  thread.length = (2 * drop + pi * radius) / (1 + tension / (1e8 * circle(0.002)));
  return scene;
}

/// How far the masses have moved in 0.3 s over a constant g (M - m) / (M + m), less one.
double atwood_error(int elements, double density) {
  Simulation sim(atwood(elements, density), 1);
  const double t = 0.3;
  run_until(sim, t);
  const double moved = (place(sim, 0).z() - place(sim, sim.model().elements).z()) / 2;
  return 2 * moved / (t * t) / (g0 * (heavy - light) / (heavy + light)) - 1;
}

/// The same for a perfectly flexible thread of weight: (M + m + mu L) x'' = (M - m) g + 2 mu g x.
double weighty_thread_error(double density) {
  const double mu = density * circle(2 * thread_radius),
               length = 2 * drop + pi * (wire_radius + thread_radius), t = 0.3;
  const double moving = heavy + light + mu * length, rate = std::sqrt(2 * mu * g0 / moving);
  const double moved = (heavy - light) * g0 / moving * (std::cosh(rate * t) - 1) / (rate * rate);
  return 2 * moved / (t * t) / (g0 * (heavy - light) / (heavy + light)) - 1;
}

TEST(Atwood, ErrorFallsWithTheElementsLength) {
  // 0.93, 0.46, 0.23 of r_A + r_B; each node that passes the wire is a bump
  const double coarse = std::abs(atwood_error(50, 100)), middle = std::abs(atwood_error(100, 100)),
               fine = std::abs(atwood_error(200, 100));
  EXPECT_LT(coarse, 0.08);
  EXPECT_LT(middle, 0.3 * coarse);
  EXPECT_LT(fine, 0.6 * middle);
  EXPECT_LT(fine, 0.002);  // 0.6e-3 of it is the thread's mass
}

TEST(Atwood, ErrorFallsWithTheThreadsMassAsItsOwnWeightTells) {
  for (const double density : {10000.0, 1000.0}) {
    const double error = atwood_error(200, density), expected = weighty_thread_error(density);
    // the bumps seen above, 0.7e-3
    EXPECT_NEAR(error, expected, 2e-3) << "density " << density;
    EXPECT_LT(expected, -5e-7 * density) << "and it is no small thing";
  }
}

// ---- a ring slides down a taut thread

Scene slope(double degrees, double tension, int elements) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 100
[thread.main]
material = "m"
diameter_m = 0.002
elements = 100
points_m = [[0, 0, 0], [1, 0, 0]]
start = { support = "fixed" }
end = { support = "fixed" }
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.001
youngs_modulus_Pa = 1e9
center_m = [0, 0, 0]
normal = [0, 1, 0]
)");
  const double angle = degrees * pi / 180;
  const Vec3 down(std::cos(angle), 0, -std::sin(angle)), up(std::sin(angle), 0, std::cos(angle));
  Thread& thread = scene.threads[0];
  thread.elements = elements;
  thread.points = {Vec3::Zero(), down};
  thread.length = 1 / (1 + tension / (1e9 * circle(0.002)));
  Ring& ring = scene.rings[0];
  ring.normal = down;
  const double k = hertz_stiffness(0.001, 0.002, compliance(1e9, 0.3), compliance(1e9, 0.33));
  const double pressed = std::pow(0.001 * g0 * std::cos(angle) / k, 2.0 / 3);
  ring.center = 0.105 * down - (0.007 + pressed) * up;  // hangs by the inside of its wire
  return scene;
}

constexpr double ring_weight = 0.001 * g0, thread_weight = 100 * pi * 1e-6 * g0;  // N

/// How far the ring has slid in 0.3 s over a constant g sin(theta), less one.
double slope_error(double degrees, double tension, int elements) {
  const Scene scene = slope(degrees, tension, elements);
  Simulation sim(scene, 1);
  const double t = 0.3;
  run_until(sim, t);
  const double moved = (place(sim, elements + 1) - scene.rings[0].center).dot(scene.rings[0].normal);
  return 2 * moved / (t * t) / (g0 * std::sin(degrees * pi / 180)) - 1;
}

TEST(Slope, RingSlidesWithGSinTheta) {
  // The ring's weight bends the thread. At the part s of its length this adds g W cos^2(theta) (1 - 2 s) /
  // 2T: at most cot(theta) cos(theta) W / 2T of g sin(theta). The thread's own sag has the same form.
  for (const double degrees : {15.0, 30.0, 45.0}) {
    const double angle = degrees * pi / 180, bend = std::cos(angle) / std::tan(angle) / 2;
    for (const double tension : {1.0, 10.0})
      EXPECT_LT(std::abs(slope_error(degrees, tension, 50)),
                1.2 * bend * (ring_weight + thread_weight) / tension)
          << degrees << " degrees, " << tension << " N";
  }
}

TEST(Slope, ErrorGoesToZeroWithWeightOverTension) {
  const double slack = slope_error(30, 1, 50), middle = slope_error(30, 10, 50),
               taut = slope_error(30, 100, 50);
  EXPECT_NEAR(slack / middle, 10,
              5);  // first order in W / T, higher ones and the thread's nodes make the rest
  EXPECT_NEAR(middle / taut, 10, 5);
  EXPECT_LT(std::abs(taut), 2e-4);
  EXPECT_LT(std::abs(slope_error(30, 100, 100)), 2e-4);  // not an accident of the elements
}

// ---- the thread that pulls a ring (Sec. 5.1)

/// A massless inextensible thread of 1 m through a point ring that slides along Y, from its anchor at Y = 0.8
/// m to the ball; q: the ring's place, phi: the angle of the free part from the Y axis. The free part has the
/// length l = 0.2 + q, the ball is at (q - l cos phi, -l sin phi), and Lagrange's equations of
///   2 T = A q'^2 + 2 B q' phi' + C phi'^2,  A = M + 2 m (1 - cos phi),  B = m l sin phi,  C = m l^2
/// are  A q'' + B phi'' = m l (1 - cos phi) phi'^2 - 2 m sin phi q' phi',  B q'' + C phi'' = -2 m l q' phi'.
struct PointRing {
  using State = std::array<double, 4>;             // q, phi, q', phi'
  static constexpr double ball = 0.1, ring = 0.1;  // kg

  static State rate(const State& s) {
    const auto [q, phi, u, w] = s;
    const double l = 0.2 + q, sine = std::sin(phi), versine = 1 - std::cos(phi);
    const double a = ring + 2 * ball * versine, b = ball * l * sine, c = ball * l * l;
    const double f = ball * l * versine * w * w - 2 * ball * sine * u * w, h = -2 * ball * l * u * w;
    const double det = a * c - b * b;
    return {u, w, (f * c - h * b) / det, (h * a - f * b) / det};
  }
  /// Classical Runge-Kutta from the start of the case: the ball 0.2 m behind the ring, 1 m/s across.
  static State at_time(double time, int steps) {
    State s{0, 0, 0, 1 / 0.2};
    const double h = time / steps;
    const auto moved = [](const State& x, const State& v, double dt) {
      return State{x[0] + dt * v[0], x[1] + dt * v[1], x[2] + dt * v[2], x[3] + dt * v[3]};
    };
    for (int i = 0; i < steps; ++i) {
      const State k1 = rate(s), k2 = rate(moved(s, k1, h / 2)), k3 = rate(moved(s, k2, h / 2)),
                  k4 = rate(moved(s, k3, h));
      for (std::size_t d = 0; d < 4; ++d) s[d] += h / 6 * (k1[d] + 2 * k2[d] + 2 * k3[d] + k4[d]);
    }
    return s;
  }
  static Vec3 ball_place(const State& s) {
    return {0, s[0] - (0.2 + s[0]) * std::cos(s[1]), -(0.2 + s[0]) * std::sin(s[1])};
  }
  static double energy(const State& s) {
    const Vec3 step = (ball_place({s[0] + 1e-6 * s[2], s[1] + 1e-6 * s[3], 0, 0}) -
                       ball_place({s[0] - 1e-6 * s[2], s[1] - 1e-6 * s[3], 0, 0})) /
                      2e-6;
    return 0.5 * ring * s[2] * s[2] + 0.5 * ball * step.squaredNorm();
  }
};

TEST(RingPull, ReferenceIsConverged) {
  const auto coarse = PointRing::at_time(1, 1000), fine = PointRing::at_time(1, 2000);
  for (std::size_t d = 0; d < 4; ++d) EXPECT_NEAR(coarse[d], fine[d], 1e-10);
  for (int i = 1; i <= 10; ++i) EXPECT_NEAR(PointRing::energy(PointRing::at_time(0.1 * i, 1000)), 0.05, 1e-9);
}

struct PullError {
  double curve = 0;  ///< greatest difference of the ring's place, m
  double end = 0;    ///< at 1 s
  double ball = 0;   ///< the ball's distance at 1 s
};

PullError pull(int elements) {
  Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "ring_pull.toml");
  scene.threads[0].elements = elements;
  scene.time.step = 0;  // automatic
  Simulation sim(scene, 1);
  PullError error;
  for (int i = 1; i <= 50; ++i) {
    run_until(sim, 0.02 * i);
    const auto reference = PointRing::at_time(sim.time(), 40 * i);
    error.end = std::abs(place(sim, elements + 1).y() - reference[0]);
    error.curve = std::max(error.curve, error.end);
    error.ball = (place(sim, 0) - PointRing::ball_place(reference)).norm();
  }
  return error;
}

TEST(RingPull, ApproachesTheMasslessThreadThroughAPointRing) {
  // What the limit does not have: bumps of the thread's nodes on the wire (they fall with the elements'
  // length), a clearance of 7 mm in the ring, 3 g of thread.
  const PullError coarse = pull(100), middle = pull(200), fine = pull(400);
  EXPECT_LT(coarse.curve, 0.015);
  EXPECT_LT(middle.curve, 0.006);
  EXPECT_LT(fine.curve, 0.002);
  EXPECT_LT(middle.curve, 0.6 * coarse.curve);
  EXPECT_LT(fine.curve, 0.6 * middle.curve);
  EXPECT_LT(middle.end, 0.002);
  EXPECT_LT(coarse.ball, 0.15);  // the ball feels every bump
  EXPECT_LT(middle.ball, 0.05);
  EXPECT_LT(fine.ball, 0.012);
}

}  // namespace
}  // namespace cinch
