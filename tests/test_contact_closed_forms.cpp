// Contact of threads with rings and balls against closed forms: Hertz, Hunt and Crossley, momentum, one
// contact counted once. Each tolerance is followed by the reason for its size.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <string>

#include "kernels/contact_item.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

using namespace test;
using std::numbers::pi;

// ---- impacts of a heavy end node; the thread behind it is slack and weighs 1 %

constexpr double thread_radius = 0.002, ball_radius = 0.15, ring_radius = 0.1, wire_radius = 0.003;

/// The node flies towards -x, through the contact surface at 1e-5 m behind its start.
Scene impact(double from_x, double speed) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
step_s = 1e-6
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 1000
[thread.main]
material = "m"
diameter_m = 0.004
elements = 1
points_m = [[0, 0, 0], [1, 0, 0]]
length_m = 0.4
start = { mass_kg = 0.5 }
)");
  Thread& thread = scene.threads[0];
  thread.points = {Vec3(from_x + 1e-5, 0, 0), Vec3(from_x + 0.1, 0, 0)};
  thread.velocity = Vec3(-speed, 0, 0);
  return scene;
}

constexpr double striker =
    0.5 + 0.5 * 1000 * pi * thread_radius * thread_radius * 0.4;  // kg, with half of the thread

Scene ball_impact(double speed, double alpha) {
  Scene scene = impact(ball_radius + thread_radius, speed);
  scene.contact.alpha_target = alpha;
  scene.targets.push_back({"ball", Vec3::Zero(), ball_radius, 2e9, 0.39, {}, {}});
  return scene;
}

/// From outside, in the plane of a ring that is held or free (then of 0.3 kg).
Scene ring_impact(double speed, double alpha, Support support) {
  Scene scene = impact(ring_radius + wire_radius + thread_radius, speed);
  scene.contact.alpha_ring = alpha;
  Ring ring;
  ring.name = "r";
  ring.diameter = 2 * ring_radius;
  ring.wire_diameter = 2 * wire_radius;
  ring.mass = 0.3;
  ring.youngs_modulus = 2e9;
  ring.poissons_ratio = 0.39;
  ring.normal = Vec3::UnitZ();
  ring.support = support;
  scene.rings.push_back(ring);
  return scene;
}

double ball_stiffness() {
  return hertz_stiffness(thread_radius, ball_radius, compliance(1e9, 0.3), compliance(2e9, 0.39));
}

double ring_stiffness() {
  return hertz_stiffness(thread_radius, wire_radius, compliance(1e9, 0.3), compliance(2e9, 0.39));
}

struct Impact {
  double deepest = 0;   ///< m
  double duration = 0;  ///< s
  double rebound = 0;   ///< speed of separation, m/s
  Summary summary;
};

/// Follows the striker (node 0) from before the contact to after it; the other side is the ring's node, if it
/// has one.
Impact follow(const Scene& scene, double contact_distance) {
  Simulation sim(scene, 1);
  const Index other = scene.rings.empty() ? -1 : 2;
  const auto gap = [&] {
    return place(sim, 0).x() - (other < 0 ? 0 : place(sim, other).x()) - contact_distance;
  };
  Impact out;
  double before = gap(), entered = -1;
  for (;;) {
    sim.advance_to(sim.step() + 1);
    const double now = gap(), crossing = sim.time() - step_of(sim) * now / (now - before);
    if (before >= 0 && now < 0) entered = crossing;
    out.deepest = std::max(out.deepest, -now);
    if (before < 0 && now >= 0) {
      out.duration = crossing - entered;
      out.rebound = sim.state().vx[0] - (other < 0 ? 0 : sim.state().vx[at(other)]);
      out.summary = sim.summary();
      return out;
    }
    before = now;
    if (sim.time() > 0.5) throw std::runtime_error("no rebound");
  }
}

void expect_hertz(const Impact& impact, double mass, double speed, double stiffness) {
  const double deepest = std::pow(5 * mass * speed * speed / (4 * stiffness), 0.4);
  // duration over deepest / speed: 2 int_0^1 dx / sqrt(1 - x^2.5) = 2.9432
  const double factor = 0.8 * std::sqrt(pi) * std::tgamma(0.4) / std::tgamma(0.9);
  EXPECT_NEAR(factor, 2.94, 0.005);
  // second order in dt = 1e-6 s over a contact of 1e-3 to 1e-2 s
  EXPECT_NEAR(impact.deepest / deepest, 1, 1e-5);
  EXPECT_NEAR(impact.summary.max_penetration / deepest, 1, 1e-5);
  EXPECT_NEAR(impact.duration / (factor * deepest / speed), 1, 1e-5);
  EXPECT_NEAR(impact.rebound / speed, 1, 1e-5);
}

TEST(Impact, HertzOnABall) {
  for (const double speed : {0.1, 1.0, 3.0})
    expect_hertz(follow(ball_impact(speed, 0), ball_radius + thread_radius), striker, speed,
                 ball_stiffness());
}

/// The striker's mass as a sphere of 0.02 m: it touches long before the thread behind it does.
Scene sphere_impact(double speed, double alpha, const Sphere& sphere) {
  Scene scene = impact(ball_radius + sphere.radius, speed);
  scene.contact.alpha_target = alpha;
  scene.threads[0].start.sphere = sphere;
  scene.targets.push_back({"ball", Vec3::Zero(), ball_radius, 2e9, 0.39, {}, {}});
  return scene;
}

TEST(Impact, HertzOfAMassAsASphere) {
  const double own = hertz_stiffness(0.02, ball_radius, compliance(5e8, 0.25), compliance(2e9, 0.39));
  expect_hertz(follow(sphere_impact(1, 0, {0.02, 5e8, 0.25}), ball_radius + 0.02), striker, 1, own);
  const double as_target = hertz_stiffness(0.02, ball_radius, compliance(2e9, 0.39), compliance(2e9, 0.39));
  expect_hertz(follow(sphere_impact(1, 0, {0.02, 0, 0.3}), ball_radius + 0.02), striker, 1, as_target);
  const Impact damped = follow(sphere_impact(1, 0.25, {0.02, 0, 0.3}), ball_radius + 0.02);
  EXPECT_NEAR(damped.rebound, 0.7992, 1e-3);
  EXPECT_LT(damped.summary.relative_residual, 2e-3);
}

TEST(Impact, MassTouchesOnlyWhereItsThreadDoes) {
  Scene scene = sphere_impact(1, 0, {0.02, 0, 0.3});
  scene.targets[0].touches = {"thread.other"};
  Thread other = scene.threads[0];
  other.name = "other";
  other.points = {Vec3(9, 0, 0), Vec3(9, 1, 0)};
  other.start = {};
  scene.threads.push_back(other);
  Simulation sim(scene, 1);
  run_until(sim, 0.02);
  EXPECT_NEAR(sim.state().vx[0], -1, 1e-12);
  EXPECT_LT(place(sim, 0).x(), ball_radius + 0.02 - 0.019);
}

TEST(Impact, HertzOnAHeldRing) {
  for (const double speed : {0.1, 1.0})
    expect_hertz(follow(ring_impact(speed, 0, Support::fixed), ring_radius + wire_radius + thread_radius),
                 striker, speed, ring_stiffness());
}

TEST(Impact, HertzOnAFreeRingHasTheReducedMass) {
  const double reduced = 1 / (1 / striker + 1 / 0.3);
  expect_hertz(follow(ring_impact(1, 0, Support::free), ring_radius + wire_radius + thread_radius), reduced,
               1, ring_stiffness());
}

struct Restitution {
  double alpha_v, e;
};

constexpr Restitution restitutions[] = {{0.05, 0.9524}, {0.10, 0.9090}, {0.25, 0.7992}, {0.50, 0.6630}};

/// Root e of a v - ln(1 + a v) = -a e v - ln(1 - a e v), a = 1.5 alpha.
double restitution(double alpha_v) {
  const double in = 1.5 * alpha_v;
  double low = 0, high = 1;
  while (high - low > 1e-14) {
    const double e = (low + high) / 2, out = in * e;
    (-out - std::log1p(-out) < in - std::log1p(in) ? low : high) = e;
  }
  return low;
}

TEST(Impact, HuntCrossleyRestitutionOnABall) {
  for (const auto& [alpha_v, e] : restitutions) {
    EXPECT_NEAR(restitution(alpha_v), e, 5e-5);
    const Impact impact = follow(ball_impact(1, alpha_v), ball_radius + thread_radius);
    // the damper's speed lags by dt/2: a part dt / duration = 4e-4 at most
    EXPECT_NEAR(impact.rebound / restitution(alpha_v), 1, 1e-4) << "alpha v = " << alpha_v;
    // what the ledger books as dissipated, first order in dt
    EXPECT_NEAR(impact.summary.energy.dissipated_contact / (0.5 * striker * (1 - e * e)), 1, 3e-3);
    EXPECT_LT(impact.summary.relative_residual, 1e-3);
  }
}

TEST(Impact, HuntCrossleyRestitutionOnARing) {
  for (const auto& [alpha_v, e] : restitutions)
    for (const Support support : {Support::fixed, Support::free}) {
      const Impact impact =
          follow(ring_impact(1, alpha_v, support), ring_radius + wire_radius + thread_radius);
      EXPECT_NEAR(impact.rebound / e, 1, 3e-3) << "alpha v = " << alpha_v;
      EXPECT_LT(impact.summary.linear_momentum_drift, 1e-13);
      EXPECT_LT(*impact.summary.angular_momentum_drift, 1e-13);
    }
}

// ---- one contact is counted once

constexpr double element = 0.02, pressed = 5e-5;  // m: neighbours half an element away do not touch

/// Straight thread of ten elements along z at distance `x` from the axis; node 5 at height `shift`.
Scene straight_thread(double x, double shift) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 1000
[thread.a]
material = "m"
diameter_m = 0.004
elements = 10
points_m = [[0, 0, 0], [1, 0, 0]]
)");
  scene.threads[0].points = {Vec3(x, 0, shift - 5 * element), Vec3(x, 0, shift + 5 * element)};
  scene.contact.alpha_ring = scene.contact.alpha_target = 0;  // a state holds speeds of half a step before
  return scene;
}

Scene thread_on_ball(double shift) {
  Scene scene = straight_thread(ball_radius + thread_radius - pressed, shift);
  scene.targets.push_back({"ball", Vec3::Zero(), ball_radius, 2e9, 0.39, {}, {}});
  return scene;
}

/// Through the ring, pressed against its wire from inside.
Scene thread_in_ring(double shift) {
  Scene scene = straight_thread(ring_radius - wire_radius - thread_radius + pressed, shift);
  scene.rings = ring_impact(1, 0, Support::fixed).rings;
  return scene;
}

/// Sum of the contact forces on all nodes at t = 0, less those on rings (thread nodes come first).
Vec3 thread_force(const Scene& scene, Index thread_nodes = 11) {
  Simulation sim(scene, 1);
  const Frame frame = sim.frame();
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < thread_nodes; ++i) sum += frame.contact_force[at(i)];
  return sum;
}

TEST(SharedNode, StraightThreadFeelsOneForceWhereverItIsPressed) {
  const double on_ball = ball_stiffness() * std::pow(pressed, 1.5);
  const double in_ring = ring_stiffness() * std::pow(pressed, 1.5);
  for (int i = -10; i <= 10; ++i) {
    const double shift = i * 0.05 * element;
    // inclusion and exclusion cancel to rounding; the penetration itself is known to 1e-17 / 5e-5 m
    EXPECT_LT((thread_force(thread_on_ball(shift)) / on_ball - Vec3::UnitX()).norm(), 1e-10)
        << "shift " << shift;
    EXPECT_LT((thread_force(thread_in_ring(shift)) / in_ring + Vec3::UnitX()).norm(), 1e-10)
        << "shift " << shift;
  }
}

TEST(SharedNode, ThePapersRuleDoublesItAtNodes) {
  for (const double shift : {0.0, 0.5 * element}) {
    const double times = shift == 0 ? 2 : 1;
    Scene ball = thread_on_ball(shift), ring = thread_in_ring(shift);
    ball.contact.shared_node = ring.contact.shared_node = SharedNode::paper;
    EXPECT_NEAR(thread_force(ball).x() / (ball_stiffness() * std::pow(pressed, 1.5)), times, 1e-10);
    EXPECT_NEAR(thread_force(ring).x() / (ring_stiffness() * std::pow(pressed, 1.5)), -times, 1e-10);
  }
}

TEST(SharedNode, KnotOfFourThreadsIsOneContact) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 1000
[net.main]
material = "m"
diameter_m = 0.004
size_m = [0.4, 0.4]
mesh_m = 0.1
[contact]
alpha_target_s_m = 0
[target.ball]
center_m = [0, 0, -0.15195]
radius_m = 0.15
youngs_modulus_Pa = 2e9
poissons_ratio = 0.39
)");
  const double one = ball_stiffness() * std::pow(pressed, 1.5);
  EXPECT_NEAR(thread_force(scene, 25).z() / one, 1, 1e-10);
  scene.contact.shared_node = SharedNode::paper;
  EXPECT_NEAR(thread_force(scene, 25).z() / one, 4, 1e-10);
}

// From deep inside the wire on one side over to a lighter touch of the other, where golden section ends up.
TEST(SharedNode, GoldenSectionDoesNotMissAnEndInContact) {
  Scene scene = thread_in_ring(0);
  const double touch = wire_radius + thread_radius;
  scene.threads[0].elements = 1;
  scene.threads[0].points = {Vec3(-ring_radius + 0.1 * touch, 0, 0),
                             Vec3(ring_radius + touch, 0, 0.62 * touch)};
  const auto energy = [&](DistanceMethod method) {
    scene.contact.distance = method;
    return Simulation(scene, 1).look().energy().contact;
  };
  const double deep = 0.4 * ring_stiffness() * std::pow(0.9 * touch, 2.5);
  EXPECT_NEAR(energy(DistanceMethod::exact) / deep, 1, 1e-9);
  EXPECT_NEAR(energy(DistanceMethod::golden) / deep, 1, 1e-9);
}

// An element with both ends in contact has, of the mass 1 / share of a node, the node's fraction; its use of
// the step is the greatest eigenvalue of its stiffness against that. The deeper end b is its closest point or
// nearly so.
TEST(SharedNode, BothEndsInContactUseWhatTheirStiffnessNeeds) {
  for (const double t : {0.5, 0.7, 1.0})
    for (const double lighter : {0.2, 1.0})
      for (const double shallow : {0.1, 0.6, 1.0})
        for (const double fraction : {0.25, 0.5, 1.0}) {
          kernel::Pair pair{};
          pair.fraction_a = fraction, pair.fraction_b = 0.5;
          const double share_a = 1 / lighter, share_b = 1, kappa = 3;
          const Eigen::Vector2d p(1 - t, t), e(0, 1), own(fraction * std::sqrt(shallow), 0.5);
          const Eigen::Vector2d mass(fraction / share_a, 0.5 / share_b);
          const Eigen::Matrix2d own_stiffness = own.asDiagonal();
          const Eigen::Matrix2d stiffness = kappa * (p * p.transpose() - e * e.transpose() + own_stiffness);
          const Eigen::Vector2d root = mass.cwiseSqrt().cwiseInverse();
          const double needed = (root.asDiagonal() * stiffness * root.asDiagonal())
                                    .eval()
                                    .selfadjointView<Eigen::Lower>()
                                    .eigenvalues()
                                    .maxCoeff();
          const double used = plain::thread_share_of_both(pair, kappa, t, 1, shallow, 1, share_a, share_b);
          EXPECT_GE(used, needed * (1 - 1e-12)) << t << " " << lighter << " " << shallow << " " << fraction;
          EXPECT_LT(used, 3 * needed) << t << " " << lighter << " " << shallow << " " << fraction;
        }
}

TEST(SharedNode, ForceOnTheRingIsMinusTheThreads) {
  Scene scene = thread_in_ring(0.3 * element);
  scene.threads[0].points[1] += Vec3(0, 0.03, 0);  // askew
  Simulation sim(scene, 1);
  const Frame frame = sim.frame();
  EXPECT_GT(frame.ring_force[0].norm(), 0.1);
  EXPECT_LT((frame.ring_force[0] + thread_force(scene)).norm(), 1e-13 * frame.ring_force[0].norm());
}

// ---- two threads through one ring

TEST(TwoThreads, EachPressesTheRingByItsOwnPenetration) {
  Scene scene = thread_in_ring(0);
  scene.threads.push_back(scene.threads[0]);
  scene.threads[1].name = "b";
  for (Vec3& p : scene.threads[1].points) p.x() = -p.x() - pressed;  // twice as deep, opposite
  const double one = ring_stiffness() * std::pow(pressed, 1.5), two = std::pow(2, 1.5) * one;
  const auto ring_force = [](const Scene& s) {
    Simulation sim(s, 1);
    return sim.frame().ring_force[0].x();
  };
  EXPECT_NEAR(ring_force(scene) / (one - two), 1, 1e-10);  // k_c delta^1.5, to rounding
  scene.rings[0].threads = {"a"};
  EXPECT_NEAR(ring_force(scene) / one, 1, 1e-10);
  scene.rings[0].threads = {"b"};
  EXPECT_NEAR(ring_force(scene) / -two, 1, 1e-10);
}

// ---- momentum of threads and rings that nothing holds

/// Net with a ring on its top edge, a thread with end masses through it, all flying, spinning and pulling.
Scene flying_thread_and_ring(RingCouple couple) {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.3, 0.3]
mesh_m = 0.1
stowed_factor = 1.02
velocity_m_s = [1, 2, 3]
node."knot.1.3" = { velocity_m_s = [1, 2, 4] }
node."knot.2.3" = { velocity_m_s = [1, 2.5, 2.5] }
[thread.a]
material = "m"
diameter_m = 0.002
elements = 30
points_m = [[-0.2, 0.153, 0.0065], [0.2, 0.153, 0.0065]]
length_m = 0.396
velocity_m_s = [2, 2, 3]
start = { mass_kg = 0.02, velocity_m_s = [1, 2, 7] }
end = { mass_kg = 0.03, velocity_m_s = [2, 0, 6] }
[ring.r]
joint = "contact"
on = "net.main.top"
element = 1
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.002
youngs_modulus_Pa = 7e10
)");
  scene.contact.couple = couple;
  return scene;
}

struct Spin {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

/// By the test's own loop: x(n) with v(n-1/2), what central differences keep.
Spin spin_of(const Simulation& sim) {
  Spin sum;
  for (Index i = 0; i < sim.model().nodes; ++i) {
    const Vec3 p =
        sim.model().mass[at(i)] * Vec3(sim.state().vx[at(i)], sim.state().vy[at(i)], sim.state().vz[at(i)]);
    sum.linear += p;
    sum.angular += place(sim, i).cross(p);
  }
  return sum;
}

struct Flight {
  double linear, angular;  ///< change over the flight, relative
  Summary summary;
};

Flight fly(RingCouple couple, double safety) {
  Scene scene = flying_thread_and_ring(couple);
  scene.time.safety = safety;
  Simulation sim(scene, 1);
  const Spin start = spin_of(sim);
  run_until(sim, 0.04);
  const Spin end = spin_of(sim);
  return {(end.linear - start.linear).norm() / start.linear.norm(),
          (end.angular - start.angular).norm() / start.angular.norm(), sim.summary()};
}

constexpr double rounding = 1e-11;  // some 1e4 steps of eps each, were all of one sign

TEST(RingMomentum, ConservingCoupleKeepsBoth) {
  const Flight flight = fly(RingCouple::conserving, 0.4);
  EXPECT_GT(flight.summary.ring_records[0].peak_force, 1);
  EXPECT_LT(flight.linear, rounding);
  EXPECT_LT(flight.angular, rounding);
  EXPECT_LT(flight.summary.linear_momentum_drift, rounding);
  EXPECT_LT(*flight.summary.angular_momentum_drift, rounding);
  EXPECT_EQ(flight.summary.energy.booked_couple, 0);
}

TEST(RingMomentum, PapersCoupleLosesAngularMomentumAndBooksIt) {
  const Flight flight = fly(RingCouple::paper, 0.4);
  EXPECT_GT(flight.summary.ring_records[0].peak_force, 1);
  EXPECT_LT(flight.linear, rounding);
  EXPECT_GT(flight.angular, 1e-4);  // it really is lost ...
  EXPECT_LT(flight.summary.linear_momentum_drift, rounding);
  EXPECT_LT(*flight.summary.angular_momentum_drift, rounding);  // ... and the books know where it went
  EXPECT_NE(flight.summary.energy.booked_couple, 0);
}

TEST(RingMomentum, EnergyResidualFallsWithTheStep) {
  for (const RingCouple couple : {RingCouple::conserving, RingCouple::paper}) {
    const double coarse = fly(couple, 0.4).summary.relative_residual,
                 fine = fly(couple, 0.1).summary.relative_residual;
    EXPECT_LT(fine, 0.35 * coarse);  // first order: dampers act
    EXPECT_LT(fine, 1e-3);
  }
}

TEST(RingMomentum, FreeRingAndTwoThreads) {
  // Nothing is held but the ring's direction: its support takes the couple, which the books count.
  Scene scene = thread_in_ring(0);
  scene.rings[0].support = Support::free;
  scene.rings[0].velocity = Vec3(1, 0, 0);
  scene.threads.push_back(scene.threads[0]);
  scene.threads[1].name = "b";
  scene.threads[1].velocity = Vec3(3, 1, 0);
  scene.threads[1].points[0].x() -=
      0.02;  // aslant, so that the contact's normal leans out of the ring's plane
  scene.threads[1].points[1].x() -= 0.01;
  Simulation sim(scene, 1);
  const Spin start = spin_of(sim);
  run_until(sim, 0.02);
  const Spin end = spin_of(sim);
  EXPECT_GT(sim.summary().ring_records[0].peak_force, 1);
  EXPECT_LT((end.linear - start.linear).norm(), rounding);
  EXPECT_GT((end.angular - start.angular).norm(), 1e-6);
  EXPECT_LT(*sim.summary().angular_momentum_drift, rounding);
}

}  // namespace
}  // namespace cinch
