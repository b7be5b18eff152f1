// The oracle is what the solver is checked with; here it is checked itself, on assemblies small enough to
// build by hand, against closed forms, finite differences of its potentials and conservation laws.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "oracle/closest.hpp"
#include "oracle/oracle.hpp"

namespace {

using cinch::Assembly;
using cinch::Index;
using cinch::RingCouple;
using cinch::Scene;
using cinch::SharedNode;
using cinch::Support;
using cinch::Vec3;
using oracle::Evaluation;
using oracle::Oracle;
using oracle::Result;
using Field = std::vector<Vec3>;

constexpr double pi = std::numbers::pi;

template <class List>
auto& at(List& list, Index i) {
  return list[static_cast<std::size_t>(i)];
}

// ----------------------------------------------------------------------------------------------------
// Building

struct Tiny {
  Scene scene;
  Assembly assembly;

  explicit Tiny(double dt = 1e-6) { scene.time.step = dt; }

  Index node(const Vec3& x, const Vec3& v = Vec3::Zero(), double mass = 0.01,
             Support support = Support::free) {
    assembly.nodes.push_back({x, v, mass, mass, support, Vec3::UnitX()});
    return as_all_from_the_start();
  }

  /// Rest length as a fraction of the length it is laid with.
  Index element(Index a, Index b, Index part = 0, double rest = 1, double stiffness = 1000,
                double damping = 0) {
    const double length = (at(assembly.nodes, a).position - at(assembly.nodes, b).position).norm();
    assembly.elements.push_back({a, b, rest * length, stiffness, damping, 0.001, 1e-8, part});
    as_all_from_the_start();
    return static_cast<Index>(assembly.elements.size()) - 1;
  }

  void ring_on_node(Index node, const Vec3& normal, const std::vector<Index>& parts = {0}) {
    assembly.rings.push_back({"r", -1, node, normal, 0.01, 0.002, 1e-8, parts});
  }

  void ring_on_element(Index element, const std::vector<Index>& parts = {0}) {
    assembly.rings.push_back({"r", element, -1, Vec3::UnitX(), 0.01, 0.002, 1e-8, parts});
  }

  Index as_all_from_the_start() {
    assembly.nodes_before = static_cast<Index>(assembly.nodes.size());
    assembly.elements_before = static_cast<Index>(assembly.elements.size());
    return assembly.nodes_before - 1;
  }

  Field positions() const {
    Field x;
    for (const auto& node : assembly.nodes) x.push_back(node.position);
    return x;
  }

  Field velocities() const {
    Field v;
    for (const auto& node : assembly.nodes) v.push_back(node.velocity);
    return v;
  }

  Oracle started() const {
    Oracle oracle(scene, assembly);
    oracle.start();
    return oracle;
  }

  Evaluation evaluated() const { return started().evaluate(positions(), velocities()); }
};

/// Ring at the origin about Y with a node of its own; a thread of part 0 through `points`, 20 mm of wire and
/// thread.
Tiny ring_and_thread(const std::vector<Vec3>& points, const Vec3& velocity = Vec3::Zero()) {
  Tiny tiny;
  tiny.ring_on_node(tiny.node(Vec3::Zero()), Vec3::UnitY());
  for (const Vec3& point : points) {
    const Index now = tiny.node(point, velocity);
    if (now > 1) tiny.element(now - 1, now);
  }
  return tiny;
}

class Random {
 public:
  double operator()(double scale) {
    return scale * std::uniform_real_distribution<double>(-1, 1)(generator_);
  }
  Vec3 vector(double scale) { return {(*this)(scale), (*this)(scale), (*this)(scale)}; }

 private:
  std::mt19937 generator_{20210901};
};

/// Host element along Y (nodes 0, 1; ring node 2 when it stands alone), and a forked taut thread that lies on
/// the ring: contact inside elements, at a node shared by three, and none at all.
Tiny forked_thread_on_ring(bool on_element, Random& random) {
  Tiny tiny;
  const auto near = [&](double x, double y, double z) {
    return tiny.node(Vec3(x, y, z) + random.vector(3e-4), random.vector(2));
  };
  const Index a = near(0.001, -0.05, 0.002), b = near(-0.001, 0.04, -0.001), own = near(0, -0.005, 0.0005);
  const Index host = tiny.element(a, b, 1, 0.9);
  const Index p = near(0.008, -0.015, 0.001), q = near(0.0083, -0.0048, -0.001),
              r = near(0.0075, 0.007, 0.002);
  const Index s = near(0.009, -0.004, 0.012);
  for (const auto& [from, to] : {std::pair{p, q}, {q, r}, {q, s}}) tiny.element(from, to, 0, 0.95, 1000, 0.2);
  if (on_element) tiny.ring_on_element(host);
  if (!on_element) tiny.ring_on_node(own, Vec3(0.05, 1, -0.04).normalized());
  return tiny;
}

/// Nodes 1 mm apart, askew on the ring, with a branch at the middle one: most elements touch with both ends.
Tiny fine_thread_on_ring(Random& random) {
  Tiny tiny;
  const auto near = [&](double x, double y, double z) {
    return tiny.node(Vec3(x, y, z) + random.vector(2e-4), random.vector(2));
  };
  const Index own = near(0, 0, 0);
  Index last = near(0.0083, -0.004, 0), middle = last;
  for (int i = 1; i <= 8; ++i) {
    const Index next = near(0.0083, 0.001 * (i - 4), 0.0002 * i);
    tiny.element(last, next, 0, 0.95, 1000, 0.2);
    if (i == 4) middle = next;
    last = next;
  }
  tiny.element(middle, near(0.0088, 0, 0.003), 0, 0.95, 1000, 0.2);
  tiny.ring_on_node(own, Vec3(0.05, 1, -0.04).normalized());
  return tiny;
}

/// The same on a ball.
Tiny fine_thread_on_ball(Random& random) {
  Tiny tiny = fine_thread_on_ring(random);
  tiny.assembly.rings.clear();
  tiny.assembly.balls.push_back({"ball", Vec3(0.0583, 0, 0), 0.05, 1e-8, {0}, {}});
  return tiny;
}

double potential(const Oracle& oracle, const Field& x) {
  const Evaluation e = oracle.evaluate(x, Field(x.size(), Vec3::Zero()));
  return e.elastic + e.contact + e.gravitational;
}

/// Greatest difference of force and negative gradient of the potential over all nodes, at rest.
double gradient_error(const Tiny& tiny, double h = 1e-7) {
  const Oracle oracle = tiny.started();
  Field x = tiny.positions();
  const Field force = oracle.evaluate(x, Field(x.size(), Vec3::Zero())).force;
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = x[i][axis];
      x[i][axis] = middle + h;
      const double up = potential(oracle, x);
      x[i][axis] = middle - h;
      const double down = potential(oracle, x);
      x[i][axis] = middle;
      worst = std::max(worst, std::abs(force[i][axis] + (up - down) / (2 * h)));
    }
  }
  return worst;
}

/// Power of all forces + rate of the potentials + losses: zero when penetration rates and forces agree.
double power_error(const Tiny& tiny, double h = 1e-8) {
  const Oracle oracle = tiny.started();
  const Field x = tiny.positions(), v = tiny.velocities();
  const Evaluation e = oracle.evaluate(x, v);
  Field before = x, after = x;
  double power = e.damper_power() + e.contact_power;
  for (std::size_t i = 0; i < x.size(); ++i) {
    power += e.force[i].dot(v[i]);
    before[i] -= h * v[i];
    after[i] += h * v[i];
  }
  return power + (potential(oracle, after) - potential(oracle, before)) / (2 * h);
}

// ----------------------------------------------------------------------------------------------------
// Closest points

double circle_distance(const Vec3& p, const Vec3& normal, double radius) {
  const double z = p.dot(normal);
  return std::hypot(z, (p - z * normal).norm() - radius);
}

struct Sampled {
  double t = 0, distance = 1e9;
};

Sampled sampled(const Vec3& a, const Vec3& b, const Vec3& center, const Vec3& normal, double radius) {
  Sampled best;
  const int n = 20000;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    const double distance = circle_distance(a + t * (b - a) - center, normal, radius);
    if (distance < best.distance) best = {t, distance};
  }
  return best;
}

TEST(Oracle, ClosestPointBeatsDenseSamplingOnShortAndLongSegments) {
  Random random;
  for (int trial = 0; trial < 600; ++trial) {
    const double size = trial % 3 == 0 ? 0.005 : trial % 3 == 1 ? 0.02 : 0.2;
    const Vec3 center = random.vector(0.3), normal = random.vector(1).normalized();
    const Vec3 a = center + random.vector(size), b = center + random.vector(size);
    const auto found = oracle::closest_to_circle(a, b, center, normal, 0.01);
    const auto dense = sampled(a, b, center, normal, 0.01);
    const double spacing = (b - a).norm() / 20000;
    EXPECT_LE(found.distance, dense.distance + 1e-15) << trial;
    EXPECT_NEAR(found.distance, dense.distance, spacing) << trial;
    EXPECT_NEAR(found.distance, circle_distance(a + found.t * (b - a) - center, normal, 0.01), 1e-15)
        << trial;
  }
}

TEST(Oracle, ClosestPointTakesTheBetterOfTwoMinima) {
  // A straight line through a circle's plane, close to both sides of it; the right side is nearer.
  const Vec3 a(-0.05, 0.001, 0), b(0.07, -0.0005, 0);
  const auto found = oracle::closest_to_circle(a, b, Vec3::Zero(), Vec3::UnitY(), 0.01);
  EXPECT_NEAR(found.t, 0.5, 0.01);
  EXPECT_LT(found.distance, 0.00026);
  const auto turned = oracle::closest_to_circle(-a, -b, Vec3::Zero(), Vec3::UnitY(), 0.01);
  EXPECT_NEAR(turned.t, found.t, 1e-14);
  EXPECT_NEAR(turned.distance, found.distance, 1e-16);
}

TEST(Oracle, ClosestPointParallelToTheAxisIsExact) {
  const auto found =
      oracle::closest_to_circle({0.0085, -0.005, 0}, {0.0085, 0.015, 0}, Vec3::Zero(), Vec3::UnitY(), 0.01);
  EXPECT_NEAR(found.t, 0.25, 1e-15);
  EXPECT_NEAR(found.distance, 0.0015, 1e-17);
  const auto on_axis = oracle::closest_to_circle({0, -1, 0}, {0, 3, 0}, Vec3::Zero(), Vec3::UnitY(), 0.01);
  EXPECT_NEAR(on_axis.t, 0.25, 1e-15);
  EXPECT_NEAR(on_axis.distance, 0.01, 1e-17);
}

TEST(Oracle, ClosestPointHoldsToTheEnds) {
  const Vec3 a(0.02, 0.001, 0), b(0.05, 0.003, 0);
  EXPECT_EQ(oracle::closest_to_circle(a, b, Vec3::Zero(), Vec3::UnitY(), 0.01).t, 0);
  EXPECT_EQ(oracle::closest_to_circle(b, a, Vec3::Zero(), Vec3::UnitY(), 0.01).t, 1);
  EXPECT_EQ(oracle::closest_to_point(a, b, Vec3::Zero()).t, 0);
  EXPECT_EQ(oracle::closest_to_point(b, a, Vec3::Zero()).t, 1);
  EXPECT_NEAR(oracle::closest_to_point({-1, 2, 0}, {3, 2, 0}, Vec3::Zero()).t, 0.25, 1e-16);
}

TEST(Oracle, ClosestPointIsStationaryTo1e12) {
  // Root of the derivative of the squared distance, by its own formula in long double.
  Random random;
  int inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 a = Vec3(0.009, -0.003, 0) + random.vector(0.002),
               b = Vec3(0.009, 0.003, 0) + random.vector(0.002);
    const double t = oracle::closest_to_circle(a, b, Vec3::Zero(), Vec3::UnitY(), 0.01).t;
    if (t == 0 || t == 1) continue;
    ++inside;
    const auto slope = [&](long double s) {
      const long double x = a.x() + s * (b.x() - a.x()), y = a.y() + s * (b.y() - a.y()),
                        z = a.z() + s * (b.z() - a.z());
      const long double rho = std::sqrt(x * x + z * z);
      const long double rho_rate = (x * (b.x() - a.x()) + z * (b.z() - a.z())) / rho;
      return y * (b.y() - a.y()) + (rho - 0.01L) * rho_rate;
    };
    EXPECT_LT(slope(t - 1e-12L), 0) << trial;
    EXPECT_GT(slope(t + 1e-12L), 0) << trial;
  }
  EXPECT_GT(inside, 100);
}

// ----------------------------------------------------------------------------------------------------
// Scheme, gravity, elements, supports

TEST(Oracle, NeedsATimeStep) {
  Tiny tiny(0);
  EXPECT_THROW(Oracle(tiny.scene, tiny.assembly), std::invalid_argument);
}

TEST(Oracle, FreeFallIsExact) {
  Tiny tiny(0.01);
  const Vec3 x(1, 2, 3), v(0.5, 0, 1), g(0, 0, -9.81);
  tiny.scene.gravity = g;
  tiny.node(x, v);
  Oracle oracle = tiny.started();
  oracle.step(100);
  const Result r = oracle.result();
  EXPECT_NEAR(r.time, 1, 1e-14);
  EXPECT_NEAR((r.position[0] - (x + v + 0.5 * g)).norm(), 0, 1e-12);
  EXPECT_NEAR((r.velocity_half[0] - (v + 0.995 * g)).norm(), 0, 1e-12);
  EXPECT_NEAR(r.gravitational, 0.01 * 9.81 * r.position[0].z(), 1e-12);
}

/// A mass on a spring under gravity, stretched by 2 m g / k at rest length 1 m + m g / k: it swings and stays
/// taut.
Tiny hanging_mass(double dt, double damping) {
  Tiny tiny(dt);
  const double mass = 0.1, stiffness = 40, static_stretch = mass * 10 / stiffness;
  tiny.scene.gravity = Vec3(0, 0, -10);
  tiny.node(Vec3::Zero(), Vec3::Zero(), 1, Support::fixed);
  tiny.node({0, 0, -1 - 1.5 * static_stretch}, Vec3::Zero(), mass);
  tiny.element(0, 1, 0, 1, stiffness, damping);
  tiny.assembly.elements[0].rest_length = 1;
  return tiny;
}

TEST(Oracle, SpringSwingsWithItsPeriod) {
  const double dt = 1e-4, omega = 20, omega_of_scheme = 2 / dt * std::asin(omega * dt / 2);
  Oracle oracle = hanging_mass(dt, 0).started();
  double worst = 0;
  for (int n = 1; n <= 10000; ++n) {
    oracle.step();
    const double expected = -1.025 - 0.0125 * std::cos(omega_of_scheme * n * dt);
    worst = std::max(worst, std::abs(oracle.result().position[1].z() - expected));
  }
  EXPECT_LT(worst, 1e-11);
  EXPECT_EQ(oracle.result().position[0], Vec3(Vec3::Zero()));
}

TEST(Oracle, DampedSpringDecaysAndBooksTheLoss) {
  const double zeta = 0.05, c = 2 * zeta * std::sqrt(40 * 0.1);
  Oracle oracle = hanging_mass(1e-5, c).started();
  const double damped = 20 * std::sqrt(1 - zeta * zeta);
  oracle.step(static_cast<int>(std::lround(4 * pi / damped / 1e-5)));  // two periods
  const Result r = oracle.result();
  const double amplitude = 0.0125 * std::exp(-zeta * 20 * 4 * pi / damped);
  EXPECT_NEAR(r.position[1].z(), -1.025 - amplitude, 1e-5 * amplitude + 1e-6);
  const double lost = 0.5 * 40 * (0.0125 * 0.0125 - amplitude * amplitude);
  EXPECT_NEAR(r.dissipated_damper, lost, 2e-3 * lost);
}

TEST(Oracle, SlackElementsAndClosingDampersPullNothing) {
  Tiny tiny;
  tiny.node(Vec3::Zero(), Vec3::Zero());
  tiny.node({1, 0, 0}, {-3, 0, 0});
  tiny.element(0, 1, 0, 1.001, 1000, 5);
  const Evaluation slack = tiny.evaluated();
  EXPECT_EQ(slack.force[1].norm(), 0);
  EXPECT_EQ(slack.elastic + slack.damper_power(), 0);

  tiny.assembly.elements[0].rest_length = 0.999;  // spring 1 N, damper -15 N: clamped
  const Evaluation clamped = tiny.evaluated();
  EXPECT_EQ(clamped.force[1].norm(), 0);
  EXPECT_NEAR(clamped.damper_power(), 3, 1e-9);  // the spring's power is lost

  tiny.assembly.elements[0].damping = 0.2;  // damper -0.6 N
  const Evaluation taut = tiny.evaluated();
  EXPECT_NEAR(taut.force[0].x(), 0.4, 1e-9);
  EXPECT_NEAR(taut.force[1].x(), -0.4, 1e-9);
  EXPECT_NEAR(taut.damper_power(), 1.8, 1e-9);
  EXPECT_NEAR(taut.elastic, 0.5e-3, 1e-12);
}

TEST(Oracle, SupportsHold) {
  Tiny tiny(1e-3);
  tiny.scene.gravity = Vec3(1, -2, 3);
  tiny.node({1, 1, 1}, {5, 5, 5}, 0.1, Support::fixed);
  tiny.node({2, 2, 2}, Vec3::Zero(), 0.1, Support::guided);
  tiny.assembly.nodes[1].axis = Vec3(0.6, 0, 0.8);
  Oracle oracle = tiny.started();
  oracle.step(1000);
  const Result r = oracle.result();
  EXPECT_EQ(r.position[0], Vec3(1, 1, 1));
  EXPECT_NEAR((r.position[1] - Vec3(2 + 0.9, 2, 2 + 1.2)).norm(), 0, 1e-10);  // 3 m/s^2 along the axis
}

// ----------------------------------------------------------------------------------------------------
// Contact law

/// Thread parallel to the ring's axis, 1.5 mm inside the contact distance, a quarter of its length from a to
/// P. h = 1e-8 on both sides gives k_c delta^1.5 = 100/pi N.
std::vector<Vec3> leaning_thread() { return {{0.0085, -0.005, 0}, {0.0085, 0.015, 0}}; }

TEST(Oracle, RingContactByHand) {
  const Evaluation e = ring_and_thread(leaning_thread(), {0.4, 0, 0.3}).evaluated();
  const double elastic = 100 / pi, total = elastic * (1 + 1.5 * 0.05 * 0.4);
  EXPECT_EQ(e.contacts, 1);
  EXPECT_NEAR((e.force[1] - Vec3(-0.75 * total, 0, 0)).norm(), 0, 1e-10);
  EXPECT_NEAR((e.force[2] - Vec3(-0.25 * total, 0, 0)).norm(), 0, 1e-10);
  EXPECT_NEAR((e.force[0] - Vec3(total, 0, 0)).norm(), 0, 1e-10);
  EXPECT_NEAR((e.ring_force[0] - Vec3(total, 0, 0)).norm(), 0, 1e-10);
  EXPECT_NEAR(e.contact, 0.4 * elastic * 0.0015, 1e-13);
  EXPECT_NEAR(e.contact_power, (total - elastic) * 0.4, 1e-10);
}

TEST(Oracle, RingContactNeverPulls) {
  const Evaluation e = ring_and_thread(leaning_thread(), {-20, 0, 0}).evaluated();
  EXPECT_EQ(e.contacts, 1);
  EXPECT_EQ(e.force[1].norm() + e.ring_force[0].norm(), 0);
  EXPECT_NEAR(e.contact_power, 100 / pi * 20, 1e-8);
}

TEST(Oracle, RingIgnoresPartsItIsNotMadeFor) {
  Tiny tiny = ring_and_thread(leaning_thread());
  tiny.assembly.rings[0].parts = {7};
  EXPECT_EQ(tiny.evaluated().contacts, 0);
}

TEST(Oracle, RingNeverTouchesItsOwnElement) {
  Tiny tiny;
  tiny.node({0, -0.05, 0});
  tiny.node({0, 0.05, 0});
  tiny.ring_on_element(tiny.element(0, 1));
  tiny.assembly.rings[0].radius = 0.002;  // less than the wire's and the thread's radius together
  EXPECT_EQ(tiny.evaluated().contacts, 0);
  tiny.element(0, 1);  // a second element in the same place is touched
  EXPECT_EQ(tiny.evaluated().contacts, 1);
}

TEST(Oracle, NodeSharedByElementsCountsOnce) {
  const Vec3 below(0.0085, -0.02, 0), middle(0.0085, 0, 0), above(0.0085, 0.015, 0);
  Tiny tiny = ring_and_thread({below, middle, above});
  const auto pull = [&] { return tiny.evaluated().ring_force[0].x(); };
  EXPECT_NEAR(pull(), 100 / pi, 1e-10);
  EXPECT_NEAR(tiny.evaluated().contact, 0.06 / pi, 1e-13);
  tiny.element(2, tiny.node({0.0085, 0.02, 0.0}));  // a third element in the node
  EXPECT_NEAR(pull(), 100 / pi, 1e-10);
  tiny.assembly.elements[2].part = 9;  // not allowed: it neither touches nor counts
  EXPECT_NEAR(pull(), 100 / pi, 1e-10);
  tiny.assembly.elements[0].part = 9;
  EXPECT_NEAR(pull(), 100 / pi, 1e-10);
  tiny.assembly.elements[0].part = tiny.assembly.elements[2].part = 0;
  tiny.scene.contact.shared_node = SharedNode::paper;
  EXPECT_NEAR(pull(), 300 / pi, 1e-10);
}

TEST(Oracle, ContactInsideOneElementHidesItsNeighboursEnd) {
  // The second element bends away: its nearest point is the shared node, which the first one passes already.
  const std::vector<Vec3> bent{{0.0085, -0.005, 0}, {0.0085, 0.0005, 0}, {0.0, 0.015, 0}};
  const Evaluation one = ring_and_thread({bent[0], bent[1]}).evaluated();
  const Evaluation two = ring_and_thread(bent).evaluated();
  ASSERT_EQ(two.contacts, 2);
  EXPECT_NEAR((one.ring_force[0] - two.ring_force[0]).norm(), 0, 1e-10);
  EXPECT_NEAR(one.contact, two.contact, 1e-13);
}

TEST(Oracle, NodesSideBySideCountOnceEach) {
  // on the plane x = 0.0085, three nodes at the same depth; nothing between them is deeper
  Tiny tiny;
  tiny.assembly.balls.push_back({"ball", Vec3(-1000, 0, 0), 1000, 1e-8, {0}, {}});
  for (int i = -1; i <= 1; ++i) tiny.node({0.0005, 0.001 * i, 0});
  const double node = [&] {
    Tiny one = tiny;
    one.element(0, one.node({0.1, 0, 0}));
    return one.evaluated().contact;
  }();
  tiny.element(0, 1), tiny.element(1, 2);
  EXPECT_GT(node, 0);
  EXPECT_NEAR(tiny.evaluated().contact / node, 3, 2e-5);  // the ball's curvature
}

TEST(Oracle, ContactEnergyHasNoJumpWhereTheDeeperEndChanges) {
  Tiny tiny =
      ring_and_thread({{0.0083, -0.006, 0}, {0.0083, -0.0005, 0}, {0.0083, 0.0005, 0}, {0.0083, 0.006, 0}});
  const auto energy = [&](double tilt) {
    tiny.assembly.nodes[2].position.x() = 0.0083 + tilt;
    tiny.assembly.nodes[3].position.x() = 0.0083 - tilt;
    return tiny.evaluated().contact;
  };
  const double level = energy(0);
  for (const double tilt : {1e-9, 1e-12}) {
    EXPECT_NEAR(energy(tilt) / level, 1, 1e4 * tilt) << tilt;
    EXPECT_NEAR(energy(-tilt) / level, 1, 1e4 * tilt) << tilt;
  }
}

// ----------------------------------------------------------------------------------------------------
// Forces are gradients, powers balance, momentum stays

TEST(Oracle, ForcesOfManyNodesInContactAreGradientsAndTheirDampersTake) {
  Random random;
  for (int trial = 0; trial < 40; ++trial) {
    const Tiny tiny = trial % 2 == 0 ? fine_thread_on_ring(random) : fine_thread_on_ball(random);
    const Evaluation now = tiny.evaluated();
    ASSERT_GE(now.contacts, 4) << trial;
    EXPECT_LT(gradient_error(tiny, 1e-9), 1e-3) << trial;  // where a closest point leaves an end, slopes turn
    EXPECT_GT(now.contact_power, 0) << trial;
    EXPECT_NEAR(power_error(tiny, 1e-10), 0, 1e-3) << trial;
  }
}

TEST(Oracle, ForcesAreTheGradientOfThePotentials) {
  Random random;
  for (int trial = 0; trial < 40; ++trial) {
    Tiny tiny = forked_thread_on_ring(trial % 2 == 0, random);
    tiny.scene.contact.shared_node = trial % 4 < 2 ? SharedNode::once : SharedNode::paper;
    ASSERT_GE(tiny.evaluated().contacts, 2) << trial;
    EXPECT_LT(gradient_error(tiny), 1e-6) << trial;
  }
}

TEST(Oracle, PaperCoupleIsNoGradient) {
  Random random;
  Tiny tiny = forked_thread_on_ring(true, random);
  tiny.scene.contact.couple = RingCouple::paper;
  EXPECT_GT(gradient_error(tiny), 0.01);
}

TEST(Oracle, BallForcesAreTheGradientOfThePotentials) {
  Random random;
  for (int trial = 0; trial < 20; ++trial) {
    Tiny tiny = forked_thread_on_ring(true, random);
    tiny.assembly.rings.clear();
    tiny.assembly.balls.push_back({"ball", Vec3(0.0583, -0.004, 0), 0.05, 1e-8, {0}, {}});
    tiny.scene.contact.shared_node = trial % 2 == 0 ? SharedNode::once : SharedNode::paper;
    ASSERT_GE(tiny.evaluated().contacts, 2) << trial;
    EXPECT_LT(gradient_error(tiny), 1e-6) << trial;
    EXPECT_NEAR(power_error(tiny), 0, 1e-6) << trial;
  }
}

TEST(Oracle, PowersBalance) {
  Random random;
  for (int trial = 0; trial < 40; ++trial) {
    Tiny tiny = forked_thread_on_ring(trial % 2 == 0, random);
    tiny.scene.contact.shared_node = trial % 4 < 2 ? SharedNode::once : SharedNode::paper;
    ASSERT_GT(std::abs(tiny.evaluated().contact_power), 0.01) << trial;
    EXPECT_NEAR(power_error(tiny), 0, 1e-6) << trial;
  }
}

/// Runs a thread through a ring that an element carries; nothing holds them.
struct Drift {
  double linear = 0, angular = 0;
  long contacts = 0;
};

Drift drift_of_momentum(RingCouple couple) {
  Random random;
  Tiny tiny = forked_thread_on_ring(true, random);
  tiny.scene.contact.couple = couple;
  Oracle oracle = tiny.started();
  const Vec3 linear = oracle.momentum(), angular = oracle.angular_momentum();
  oracle.step(3000);
  return {(oracle.momentum() - linear).norm(), (oracle.angular_momentum() - angular).norm(),
          oracle.result().contacts_seen};
}

TEST(Oracle, MomentumStays) {
  const Drift conserving = drift_of_momentum(RingCouple::conserving),
              paper = drift_of_momentum(RingCouple::paper);
  EXPECT_GT(conserving.contacts, 500);
  EXPECT_LT(conserving.linear, 1e-14);
  EXPECT_LT(paper.linear, 1e-14);
  EXPECT_LT(conserving.angular, 1e-15);
  EXPECT_GT(paper.angular, 1e-6);
}

/// Energy and losses at the whole step before the one it makes, with the velocity between its two half steps.
double energy_with_losses(Oracle& oracle) {
  const Result before = oracle.result();
  oracle.step();
  const Result after = oracle.result();
  double kinetic = 0;
  for (std::size_t i = 0; i < before.position.size(); ++i) {
    const Vec3 v = (before.velocity_half[i] + after.velocity_half[i]) / 2;
    kinetic += 0.5 * oracle.mass(static_cast<Index>(i)) * v.squaredNorm();
  }
  const double lost_in_contact = (before.dissipated_contact + after.dissipated_contact) / 2;
  return kinetic + before.elastic + before.contact + after.dissipated_damper + lost_in_contact;
}

double energy_drift(double dt, int steps) {
  Random random;
  Tiny tiny = forked_thread_on_ring(true, random);
  tiny.scene.time.step = dt;
  for (auto& node : tiny.assembly.nodes) node.velocity *= 0.2;  // too slow to push through the wire
  Oracle oracle = tiny.started();
  const double first = energy_with_losses(oracle);
  double worst = 0;
  for (int n = 1; n < steps; ++n) worst = std::max(worst, std::abs(energy_with_losses(oracle) / first - 1));
  EXPECT_GT(oracle.result().contacts_seen, 100);
  EXPECT_GT(oracle.result().dissipated_contact, 0);
  EXPECT_GT(oracle.result().dissipated_damper, 0);
  return worst;
}

TEST(Oracle, EnergyBalanceClosesWithTheStep) {
  const double coarse = energy_drift(2e-6, 1000), fine = energy_drift(1e-6, 2000),
               finer = energy_drift(5e-7, 4000);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, 0.55 * coarse);
  EXPECT_LT(finer, 0.55 * fine);
}

// ----------------------------------------------------------------------------------------------------
// Ball: impact

/// An element of 10 g meets a ball head-on at 1 m/s; its ends pass by.
Tiny impact(double alpha) {
  Tiny tiny(2e-6);
  const double far = 0.15 + 0.001 + 1e-5;
  tiny.node({-far, -0.05, 0}, {1, 0, 0}, 0.005);
  tiny.node({-far, 0.05, 0}, {1, 0, 0}, 0.005);
  tiny.element(0, 1, 0, 1.5);
  tiny.assembly.elements[0].compliance = 1e-6;
  tiny.assembly.balls.push_back({"ball", Vec3::Zero(), 0.15, 1e-6, {0}, {}});
  tiny.scene.contact.alpha_target = alpha;
  return tiny;
}

TEST(Oracle, HertzImpactReachesItsDepth) {
  Oracle oracle = impact(0).started();
  const double r = 0.001 * 0.15 / 0.151, stiffness = 4 / (3 * pi) * std::sqrt(r) / 2e-6;
  const double expected = std::pow(5 * 0.01 / (4 * stiffness), 0.4);
  double deepest = 0;
  for (int n = 0; n < 10000; ++n) {
    oracle.step();
    deepest = std::max(deepest, 0.151 + oracle.result().position[0].x());
  }
  EXPECT_NEAR(deepest, expected, 1e-5 * expected);
  EXPECT_NEAR(oracle.result().velocity_half[0].x(), -1, 1e-5);
  EXPECT_NEAR(static_cast<double>(oracle.result().contacts_seen) * 2e-6, 2.943 * expected, 2e-3 * expected);
}

TEST(Oracle, HuntCrossleyImpactRestitution) {
  for (const auto& [alpha, e] : {std::pair{0.05, 0.9524}, {0.1, 0.9090}, {0.25, 0.7992}, {0.5, 0.6630}}) {
    Oracle oracle = impact(alpha).started();
    oracle.step(12000);
    const Result r = oracle.result();
    EXPECT_NEAR(-r.velocity_half[0].x(), e, 1e-4);
    const double lost = 0.5 * 0.01 * (1 - e * e);
    EXPECT_NEAR(r.dissipated_contact, lost, 2e-3 * lost);
  }
}

// ----------------------------------------------------------------------------------------------------
// Closing

/// Carrier 0-1 with a ring, a thread 2-3 that leans on the ring from the start; from the closing time on a
/// closing thread 4-5-6 along the carrier, with masses at its ends that part with 2 m/s. A ball sits on the
/// closing thread.
Tiny closing_scene(double closing_time) {
  Tiny tiny(1e-3);
  const Vec3 v(0.1, 0.2, -0.3);
  tiny.node({0, -0.05, 0}, v, 0.5);
  tiny.node({0, 0.05, 0}, v + Vec3(0.01, 0, 0.02), 0.5);
  tiny.node({0.0078, -0.02, 0}, v, 0.01);
  tiny.node({0.0078, 0.02, 0}, v, 0.01);
  const Index host = tiny.element(0, 1, 0, 2);
  tiny.element(2, 3, 1, 2);
  tiny.ring_on_element(host, {1, 2});
  const Assembly before = tiny.assembly;
  for (const double mass : {0.1, 0.02, 0.1}) tiny.node(Vec3::Constant(7), Vec3::Constant(7), mass);
  tiny.element(4, 5, 2);
  tiny.element(5, 6, 2);
  for (auto& element : tiny.assembly.elements) element.rest_length = 1;
  tiny.assembly.nodes_before = before.nodes_before;
  tiny.assembly.elements_before = before.elements_before;
  tiny.assembly.lays = {{4, 0, 1, -0.1, Vec3(0, 0, 0.001), Vec3(2, 0, 0)},
                        {5, 0, 1, 0.5, Vec3::Zero(), Vec3::Zero()},
                        {6, 0, 1, 1, Vec3::Zero(), Vec3(-2, 0, 0)}};
  tiny.assembly.nodes[0].mass_before = 0.5 + 1.1 * 0.1 + 0.01;
  tiny.assembly.nodes[1].mass_before = 0.5 - 0.1 * 0.1 + 0.01 + 0.1;
  tiny.scene.closing.time = closing_time;
  return tiny;
}

TEST(Oracle, ClosingThreadsComeInAtTheirStep) {
  Oracle oracle = closing_scene(0.0094).started();
  EXPECT_EQ(oracle.result().position.size(), 4u);
  oracle.step(9);
  EXPECT_FALSE(oracle.rings_active());
  EXPECT_EQ(oracle.result().contacts_seen, 0);
  EXPECT_EQ(oracle.result().position.size(), 4u);
  EXPECT_NEAR(oracle.mass(0), 0.62, 1e-15);
  const Result r = oracle.result();
  const Vec3 linear = oracle.momentum();

  oracle.step();
  EXPECT_TRUE(oracle.rings_active());
  EXPECT_EQ(oracle.result().contacts_seen, 1);
  EXPECT_EQ(oracle.mass(0), 0.5);
  EXPECT_NEAR((oracle.momentum() - linear).norm(), 0, 1e-15);
  const Field x = oracle.result().position, v = oracle.result().velocity_half;
  ASSERT_EQ(x.size(), 7u);
  const Vec3 speed = 1.1 * r.velocity_half[0] - 0.1 * r.velocity_half[1] + Vec3(2, 0, 0);
  const Vec3 place = 1.1 * r.position[0] - 0.1 * r.position[1] + Vec3(0, 0, 0.001);
  EXPECT_NEAR((v[4] - speed).norm(), 0, 1e-15);
  EXPECT_NEAR((x[4] - (place + 1e-3 * speed)).norm(), 0, 1e-15);
  oracle.step(5);
  EXPECT_NEAR((oracle.momentum() - linear).norm(), 0, 1e-14);
}

TEST(Oracle, ClosingAtTheStartLaysFirst) {
  Oracle oracle = closing_scene(0).started();
  EXPECT_TRUE(oracle.rings_active());
  const Result r = oracle.result();
  ASSERT_EQ(r.position.size(), 7u);
  EXPECT_NEAR((r.position[5] - Vec3::Zero()).norm(), 0, 1e-15);
  EXPECT_NEAR((r.velocity_half[6] - Vec3(-1.89, 0.2, -0.28)).norm(), 0, 1e-15);
  EXPECT_GT(r.ring_force[0].norm(), 1);  // the start-up evaluation sees the ring
  EXPECT_GT((r.velocity_half[2] - Vec3(0.1, 0.2, -0.3)).norm(), 1e-3);
}

TEST(Oracle, WithoutAClosingTimeAllExistsFromTheStart) {
  Tiny tiny = closing_scene(0);
  tiny.scene.closing.time.reset();
  Oracle oracle = tiny.started();
  EXPECT_TRUE(oracle.rings_active());
  EXPECT_EQ(oracle.result().position[4], Vec3(Vec3::Constant(7)));  // as the assembly has it
}

TEST(Oracle, BallTouchesWhatExists) {
  Tiny tiny = closing_scene(0.0094);
  tiny.assembly.rings.clear();
  tiny.assembly.balls.push_back({"ball", Vec3(0.008, 0.0, 0), 0.0082, 1e-8, {1, 2}, {}});
  Oracle oracle = tiny.started();
  oracle.step();
  EXPECT_EQ(oracle.result().contacts_seen, 1);  // the leaning thread, before the closing time
  Tiny at_once = tiny;
  at_once.scene.closing.time = 0;
  Oracle closed = at_once.started();
  closed.step();
  EXPECT_EQ(closed.result().contacts_seen, 3);  // both elements of the closing thread too
}

// A closing element between two nodes that are there already lies across the ball, and yet not before its
// time.
TEST(Oracle, ElementsOfTheClosingTouchNothingBeforeIt) {
  Tiny tiny;
  tiny.node({0, -0.05, 0});
  tiny.node({0, 0, 0});
  tiny.node({0.02, 0, 0});
  tiny.element(0, 1);
  tiny.assembly.balls.push_back({"ball", Vec3(0.01, 0, 0), 0.0095, 1e-8, {0}, {}});
  const Evaluation alone = tiny.evaluated();
  ASSERT_EQ(alone.contacts, 1);
  const Assembly before = tiny.assembly;
  tiny.element(1, 2);
  tiny.node(Vec3::Constant(7));
  tiny.element(2, 3);
  tiny.assembly.nodes_before = before.nodes_before;
  tiny.assembly.elements_before = before.elements_before;
  tiny.assembly.lays = {{3, 0, 1, 0.5, Vec3::Zero(), Vec3::Zero()}};
  tiny.scene.closing.time = 1;
  Field x = tiny.positions(), v = tiny.velocities();
  x.resize(3), v.resize(3);
  const Evaluation waiting = tiny.started().evaluate(x, v);
  EXPECT_EQ(waiting.contacts, 1);
  EXPECT_NEAR((waiting.force[1] - alone.force[1]).norm(), 0, 1e-12);
  tiny.scene.closing.time = 0;
  Oracle closed = tiny.started();
  closed.step();
  EXPECT_EQ(closed.result().contacts_seen, 3);  // and the closing thread's own element, laid across it
}

}  // namespace
