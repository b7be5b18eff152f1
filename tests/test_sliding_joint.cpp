// Rings that slide on threads: the way through openings against a convex minimiser, forces against
// differences of the energy, whole motions against closed forms, and what must not change: energy, momentum,
// the order of the rings.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/error.hpp"
#include "kernels/axial_law.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/shortest_path.hpp"
#include "oracle/shortest_path.hpp"
#include "store/fields.hpp"
#include "support/dice.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

using namespace test;

// ---- the way through one opening

Vec3 vec(plain::V3 v) { return {v.x, v.y, v.z}; }
plain::V3 plain_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

double way(const Vec3& a, const Vec3& p, const Vec3& b) { return (p - a).norm() + (b - p).norm(); }

TEST(ShortestPassage, IsThatOfTheConvexProblem) {
  Dice dice(1);
  int straight = 0, rim = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = dice.in_box(0.1), b = dice.in_box(0.1), normal = dice.direction();
    const Vec3 center = i % 2 == 0 ? dice.in_box(0.05) : Vec3(0.5 * (a + b) + dice.in_box(0.005));
    const double radius = std::pow(10, dice.between(-5, -1.5));
    const plain::Opening opening{plain_of(center), plain_of(normal), radius};
    // any guess must do
    const plain::Passage passage = plain::shortest_passage(opening, {plain_of(a), 0}, {plain_of(b), 0},
                                                           plain_of(dice.in_box(2 * radius)));
    const Vec3 offset = vec(passage.offset);
    ASSERT_LE(offset.norm(), radius * (1 + 1e-12)) << i;
    ASSERT_NEAR(normal.dot(offset), 0, 1e-15 + 1e-12 * radius) << i;
    const double length = way(a, center + offset, b);
    EXPECT_NEAR(length, oracle::shortest_path(a, {{center, normal, radius}}, b).length, 2e-9) << i;
    if (passage.straight) {
      EXPECT_NEAR(length, (b - a).norm(), 1e-14) << i;
    }
    straight += passage.straight;
    rim += offset.norm() > 0.999 * radius;
  }
  EXPECT_GT(straight, 50);
  EXPECT_GT(rim, 1000);
}

// As when a node passes over the wire: one neighbour nearly on the rim, so that the way has a kink beside it.
TEST(ShortestPassage, IsFoundWhereANodeLiesOnTheRim) {
  Dice dice(8);
  int rim = 0;
  for (int i = 0; i < 2000; ++i) {
    const double radius = 0.007;
    const Vec3 normal = dice.direction(), side = normal.cross(dice.direction()).normalized();
    const Vec3 b = radius * (side + std::pow(10, dice.between(-9, -1)) * dice.direction());
    const Vec3 a = dice.in_box(0.03) - (i % 2 == 0 ? 2 * radius : 0) * side;
    const plain::Opening opening{{0, 0, 0}, plain_of(normal), radius};
    const plain::Passage passage =
        plain::shortest_passage(opening, {plain_of(a), 0}, {plain_of(b), 0}, plain_of(dice.in_box(radius)));
    EXPECT_NEAR(way(a, vec(passage.offset), b),
                oracle::shortest_path(a, {{Vec3::Zero(), normal, radius}}, b).length, 2e-9)
        << i;
    rim += vec(passage.offset).norm() > 0.999 * radius;
  }
  EXPECT_GT(rim, 500);
}

TEST(ShortestPassage, TouchesTheRimAtRightAnglesToItsSlope) {
  Dice dice(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = dice.in_box(0.1), b = dice.in_box(0.1), normal = dice.direction();
    const plain::Opening opening{{0, 0, 0}, plain_of(normal), 0.007};
    const Vec3 p =
        vec(plain::shortest_passage(opening, {plain_of(a), 0}, {plain_of(b), 0}, {0, 0, 0}).offset);
    if (p.norm() < 0.00699) continue;
    const Vec3 along = normal.cross(p).normalized();
    EXPECT_NEAR(along.dot((p - a).normalized() + (p - b).normalized()), 0, 1e-6) << i;
  }
}

TEST(ShortestPassage, ChangesWithoutAJumpWhereAnEndGoesThroughTheOpening) {
  const plain::Opening opening{{0, 0, 0}, {1, 0, 0}, 0.01};
  const Vec3 a(-0.1, 0.002, 0);
  double before = 0;
  for (const double x : {1e-9, -1e-9}) {
    const Vec3 b(x, 0.004, 0.003);
    const plain::Passage passage =
        plain::shortest_passage(opening, {plain_of(a), 0}, {plain_of(b), 0}, {0, 0, 0});
    EXPECT_EQ(passage.straight, x > 0);
    const double length = way(a, vec(passage.offset), b);
    if (x < 0) {
      EXPECT_NEAR(length, before, 1e-8);
    }
    before = length;
  }
}

TEST(ShortestPassage, EndsInThePlaneOrOnTheRimAreNoException) {
  const plain::Opening opening{{0, 0, 0}, {0, 0, 1}, 0.01};
  const std::array<std::array<Vec3, 2>, 4> ends{{{Vec3(-0.05, 0.001, 0), Vec3(0.05, 0.001, 0)},
                                                 {Vec3(-0.05, 0.02, 0), Vec3(0.05, 0.02, 0)},
                                                 {Vec3(0.01, 0, 0), Vec3(0.05, 0, 0.02)},
                                                 {Vec3(0.003, 0, 0), Vec3(0.003, 0, 0)}}};
  for (const auto& [a, b] : ends) {
    const Vec3 p =
        vec(plain::shortest_passage(opening, {plain_of(a), 0}, {plain_of(b), 0}, {0, 0, 0}).offset);
    ASSERT_TRUE(p.allFinite());
    EXPECT_NEAR(way(a, p, b), oracle::shortest_path(a, {{Vec3::Zero(), Vec3::UnitZ(), 0.01}}, b).length,
                2e-9);
  }
}

// A ring whose host is folded to a point: the search once went round for ever.
TEST(ShortestPassage, EndsWhereTheRingHasNoNormal) {
  const plain::Opening opening{{0, 0, 0}, {0, 0, 0}, 0.0097};
  const plain::Seen q{{-0.0444, 0.0459, 0.235}, 0, 0}, r{{-0.1882, 0.1779, -0.2876}, 0.00032, 0};
  const plain::V3 x{-1.43e-5, 1.48e-5, 7.55e-5};
  EXPECT_TRUE(vec(plain::search_rim(opening, q, r, x, 0.04)).allFinite());
}

// ---- forces of the kernel on a thread of its own

struct Bench {  // a thread with rings, in arrays of its own
  std::array<std::vector<double>, 3> x, v;
  std::vector<Index> nodes;
  std::vector<kernel::Joint> joints;
  std::vector<kernel::JointState> states;
  std::vector<kernel::RingTally> tallies;
  kernel::SlidingThread thread{0, 0, 0, 0, 1000, 0, 0.05, true};
  std::vector<kernel::Load> on_threads, on_hosts;
  double dt = 0;  // of a step; 0: a look, which tells what dampers would take in a second
  double ahead = 0;
  double host_least = 0;       // of hosts of two nodes, m
  double node_mobility = 100;  // 1/kg

  Index add(const Vec3& place, const Vec3& velocity) {
    for (int d = 0; d < 3; ++d) x[at(d)].push_back(place[d]), v[at(d)].push_back(velocity[d]);
    return static_cast<Index>(x[0].size()) - 1;
  }
  void add_ring(Index host_a, Index host_b, Index element, const Vec3& normal = Vec3::UnitX()) {
    joints.push_back({static_cast<Index>(joints.size()),
                      host_a,
                      host_b,
                      {normal.x(), normal.y(), normal.z()},
                      0.004,
                      host_a == host_b ? 0 : host_least,
                      300});
    kernel::JointState state{};
    state.element = element;
    states.push_back(state);
  }
  void evaluate() {
    thread.joint_end = static_cast<Index>(joints.size());
    thread.elements = static_cast<Index>(nodes.size()) - 1;
    tallies.resize(joints.size());
    std::vector<kernel::RingTally*> books;
    for (auto& tally : tallies) books.push_back(&tally);
    AlignedVector<double> scratch(kernel::sliding_scratch + joints.size() * kernel::joint_scratch);
    on_threads.resize(4 * joints.size());
    on_hosts.resize(4 * joints.size());
    const std::vector<double> mobility(nodes.size(), node_mobility);
    const kernel::ContactArguments contact{x[0].data(), x[1].data(), x[2].data(), v[0].data(),
                                           v[1].data(), v[2].data(), nullptr,     0,
                                           0,           dt,          1e-6};
    kernel::SlidingLoads counts{};
    const kernel::SlidingArguments all{
        contact, ahead,         dt > 0 ? dt : 1, nodes.data(), mobility.data(), &thread,
        1,       joints.data(), states.data(),   books.data(), &counts,         scratch.data()};
    kernels().sliding_joints(all, on_threads.data(), on_hosts.data());
    on_threads.resize(at(counts.threads));
    on_hosts.resize(at(counts.hosts) + 2 * joints.size());
    double spare = 0;
    on_hosts.resize(at(counts.hosts + kernels().push_hosts(all, on_hosts.data() + counts.hosts, spare)));
  }
  Vec3 place(Index i) const { return {x[0][at(i)], x[1][at(i)], x[2][at(i)]}; }
  Vec3 velocity(Index i) const { return {v[0][at(i)], v[1][at(i)], v[2][at(i)]}; }
  plain::Axial straight(Index e) const {
    const Vec3 r = place(nodes[at(e) + 1]) - place(nodes[at(e)]),
               w = velocity(nodes[at(e) + 1]) - velocity(nodes[at(e)]);
    return plain::axial_law(r.squaredNorm(), r.dot(w), thread.stiffness, thread.damping, thread.rest_length,
                            1e-6, 1e-12 * 200);
  }
  double energy() {
    evaluate();
    double sum = 0;
    for (Index e = 0; e < thread.elements; ++e) sum += straight(e).energy;
    for (const auto& state : states) sum += state.energy;
    return sum;
  }
  std::vector<Vec3> forces() {
    evaluate();
    std::vector<Vec3> sum(x[0].size(), Vec3::Zero());
    for (Index e = 0; e < thread.elements; ++e) {
      const Index a = nodes[at(e)], b = nodes[at(e) + 1];
      const Vec3 pull = straight(e).per_length * (place(b) - place(a));
      sum[at(a)] += pull, sum[at(b)] -= pull;
    }
    for (const auto* loads : {&on_threads, &on_hosts})
      for (const kernel::Load& load : *loads) sum[at(load.node)] += Vec3(load.x, load.y, load.z);
    return sum;
  }
};

// A bent thread of three elements; `rings` hosts beside its middle one, each of two nodes or of one.
Bench bent_thread(Dice& dice, int rings, bool own_node, double host_least = 0) {
  Bench bench;
  bench.host_least = host_least;
  for (int k = 0; k < 4; ++k)
    bench.nodes.push_back(bench.add(Vec3(0.06 * k, 0, 0) + dice.in_box(0.01), dice.in_box(1)));
  for (int r = 0; r < rings; ++r) {
    const Vec3 center = Vec3(0.06 + 0.06 * (r + 1) / (rings + 1), 0.012, 0) + dice.in_box(0.01);
    const Vec3 normal = (Vec3::UnitX() + dice.in_box(0.5)).normalized();
    if (own_node) {
      const Index node = bench.add(center, dice.in_box(1));
      bench.add_ring(node, node, 1, normal);
    } else {
      const Index a = bench.add(center - 0.02 * normal, dice.in_box(1));
      bench.add_ring(a, bench.add(center + 0.02 * normal, dice.in_box(1)), 1);
    }
  }
  return bench;
}

// It turns taut by the law of all elements then, and a look must not tell of more.
TEST(SlidingJoint, AThreadStraightThroughARingPullsAsWithout) {
  for (const double rate : {-20.0, 20.0, 200.0}) {
    Bench bench;
    bench.node_mobility = 1e9;
    bench.thread.damping = 0.001;
    for (const double x : {0.0, 0.05 + 1e-5})
      bench.nodes.push_back(bench.add({x, 0, 0}, {x > 0 ? rate : 0, 0, 0}));
    const Index a = bench.add({0.02, -0.01, 0}, Vec3::Zero()), b = bench.add({0.02, 0.01, 0}, Vec3::Zero());
    bench.add_ring(a, a, 0);
    bench.joints[0].host_b = b;
    bench.joints[0].opening = 0.02;
    bench.evaluate();
    for (const auto* loads : {&bench.on_threads, &bench.on_hosts})
      for (const kernel::Load& load : *loads) EXPECT_EQ(Vec3(load.x, load.y, load.z).norm(), 0) << rate;
  }
}

// Over a ring's rim, in the step in which the way has become longer than its element.
TEST(SlidingJoint, AWayThatTurnsTautPullsByTheLawOfElements) {
  for (const double share : {0.3, 0.7, 3.0}) {  // of a step since then
    Bench bench;
    bench.thread.damping = 0.01;
    const double leg = 0.5 * bench.thread.rest_length + 5e-6, half = 0.8 * leg, below = 0.004 + 0.6 * leg;
    const double rate = 1e-5 / share / 1e-6;  // m/s
    for (const double side : {-1.0, 1.0})
      bench.nodes.push_back(bench.add({side * half, -below, 0}, {side * 0.5 * rate * leg / half, 0, 0}));
    const Index ring = bench.add(Vec3::Zero(), Vec3::Zero());
    bench.add_ring(ring, ring, 0);
    bench.evaluate();
    const double length = bench.states[0].length, give = 1e-12 * 2 * bench.node_mobility;
    EXPECT_NEAR(length, 2 * leg, 1e-9);
    const plain::Axial item = plain::axial_law(length * length, length * rate, bench.thread.stiffness,
                                               bench.thread.damping, bench.thread.rest_length, 1e-6, give);
    EXPECT_EQ(item.spare < 0, share < 1);
    EXPECT_NEAR(bench.states[0].tension, item.tension, 1e-6 * item.tension) << share;
  }
}

TEST(SlidingJoint, ForcesAreTheSlopeOfTheEnergy) {
  Dice dice(3);
  double greatest = 0;
  for (const auto& [own_node, host_least] : {std::pair{false, 0.0}, {false, 0.06}, {true, 0.0}})
    for (const int rings : {1, 2, 3})
      for (int i = 0; i < 20; ++i) {
        Bench bench = bent_thread(dice, rings, own_node, host_least);
        for (int round = 0; round < 30; ++round) bench.evaluate();  // several waypoints settle
        const std::vector<Vec3> force = bench.forces();
        double size = 0;
        for (const Vec3& f : force) size = std::max(size, f.norm());
        greatest = std::max(greatest, size);
        for (std::size_t n = 0; n < force.size(); ++n)
          for (int d = 0; d < 3; ++d) {
            const double h = 1e-6, start = bench.x[at(d)][n];
            bench.x[at(d)][n] = start + h;
            const double above = bench.energy();
            bench.x[at(d)][n] = start - h;
            const double below = bench.energy();
            bench.x[at(d)][n] = start;
            EXPECT_NEAR(force[n][d], -(above - below) / (2 * h), (rings == 1 ? 1e-6 : 1e-3) * size)
                << rings << " rings, node " << n << ", axis " << d;
          }
      }
  EXPECT_GT(greatest, 10) << "the threads must pull";
}

TEST(SlidingJoint, IsEvaluatedWhereNodesWillBe) {
  Dice dice(12);
  for (const bool own_node : {false, true}) {
    Bench now = bent_thread(dice, 2, own_node);
    now.thread.damping = 0.2;
    now.ahead = 2e-3;
    Bench later = now;
    later.ahead = 0;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t n = 0; n < now.x[d].size(); ++n) later.x[d][n] += now.ahead * now.v[d][n];
    now.dt = later.dt = 1e-9;
    now.evaluate(), later.evaluate();
    ASSERT_EQ(now.on_hosts.size(), later.on_hosts.size());
    ASSERT_FALSE(now.on_hosts.empty());
    for (std::size_t i = 0; i < now.on_hosts.size(); ++i)
      EXPECT_NEAR(now.on_hosts[i].y, later.on_hosts[i].y, 1e-9) << i;
  }
}

TEST(SlidingJoint, WayOfSeveralRingsIsThatOfTheConvexProblem) {
  Dice dice(4);
  for (int i = 0; i < 200; ++i) {
    Bench bench = bent_thread(dice, 3, false);
    for (int round = 0; round < 30; ++round) bench.evaluate();
    std::vector<oracle::Disc> discs;
    for (const kernel::Joint& joint : bench.joints) {
      const Vec3 a = bench.place(joint.host_a), b = bench.place(joint.host_b);
      discs.push_back({0.5 * (a + b), (b - a).normalized(), joint.opening});
    }
    const double exact = oracle::shortest_path(bench.place(1), discs, bench.place(2)).length;
    // between rings the way counts as if it led over a step of a sixteenth of the opening
    EXPECT_GE(bench.states[0].length, exact - 1e-9);
    EXPECT_LE(bench.states[0].length, exact + 2 * 0.004 / 16);
    Vec3 last = bench.place(1);
    double sum = 0;
    for (std::size_t j = 0; j < discs.size(); ++j) {  // thread is stretched evenly along the way
      const kernel::JointState& state = bench.states[j];
      const Vec3 waypoint = discs[j].center + Vec3(state.offset[0], state.offset[1], state.offset[2]);
      sum += (waypoint - last).norm();
      EXPECT_NEAR(state.along, bench.thread.rest_length * (1 + sum / exact), 0.01 * bench.thread.rest_length);
      last = waypoint;
    }
  }
}

// Waypoint after waypoint comes slowly to the way of rings that lie at one place; the ledger begins with it.
TEST(SlidingJoint, TheFirstLookFindsTheWayOfRingsAtOnePlace) {
  Bench bench;
  for (const double y : {0.0, 0.06}) bench.nodes.push_back(bench.add(Vec3(0, y, 0), Vec3::Zero()));
  for (const Vec3& normal : {Vec3(0.2, 1, 0.1), Vec3(0, 1, 0.2), Vec3(0.2, 1, 0.3), Vec3(0, 1, 0.4)}) {
    const Index node = bench.add(Vec3(0, 0.03, 0), Vec3::Zero());
    bench.add_ring(node, node, 0, normal.normalized());
  }
  bench.evaluate();
  const double first = bench.states[0].length;
  for (int round = 0; round < 30; ++round) bench.evaluate();
  EXPECT_NEAR(first, bench.states[0].length, 1e-7);
}

TEST(SlidingJoint, TheForceOfARingIsThatOfAllItsThreads) {
  Dice dice(9);
  for (int i = 0; i < 20; ++i) {
    Bench bench = bent_thread(dice, 2, true);
    for (kernel::Joint& joint : bench.joints) joint.ring = 0;
    bench.evaluate();
    Vec3 sum = Vec3::Zero();
    for (const kernel::Load& load : bench.on_hosts) sum += Vec3(load.x, load.y, load.z);
    const double(&force)[3] = bench.tallies[0].force;
    EXPECT_NEAR((Vec3(force[0], force[1], force[2]) - sum).norm(), 0, 1e-12 * sum.norm());
    EXPECT_GT(sum.norm(), 0);
  }
}

TEST(SlidingJoint, DamperPowerIsWhatTheForcesTake) {
  Dice dice(5);
  for (const int rings : {1, 3}) {
    Bench bench = bent_thread(dice, rings, false);
    bench.thread.damping = 0.2;
    for (int round = 0; round < 30; ++round) bench.evaluate();
    const auto power = [&] {
      double sum = 0;
      const std::vector<Vec3> force = bench.forces();
      for (std::size_t n = 0; n < force.size(); ++n)
        sum += force[n].dot(bench.velocity(static_cast<Index>(n)));
      return sum;
    };
    const double damped = power(), due = bench.states[0].due;
    double straight = 0;
    for (Index e = 0; e < 3; ++e) straight += bench.straight(e).damper * bench.straight(e).rate;
    const double before = bench.states[0].dissipated;
    for (auto& state : bench.states) state.passes = 0;
    bench.dt = 1e-9;
    bench.evaluate();
    const double lost = straight + (bench.states[0].dissipated - before) / 1e-9;
    ASSERT_EQ(bench.states[0].passes, 0);
    bench.dt = 0;
    bench.thread.damping = 0;
    EXPECT_NEAR(power() - damped, lost, (rings == 1 ? 1e-6 : 1e-4) * std::abs(lost)) << rings;
    EXPECT_NEAR(due, lost - straight, 1e-4 * std::abs(lost))
        << "before the first step, as by this force alone";
    EXPECT_GT(std::abs(lost), 1e-3);
  }
}

// Between a step in which an element is taut and the next, in which it is slack, half of its damper's force
// still takes energy.
TEST(SlidingJoint, ADamperIsBookedUntilItsElementIsSlack) {
  Bench bench;
  bench.thread.damping = 0.2;
  for (const double x : {0.0, 0.05}) bench.nodes.push_back(bench.add(Vec3(x, 0, 0), Vec3(-200 * x, 0, 0)));
  const Index ring = bench.add(Vec3(0.025, 0.009, 0), Vec3(0, -1, 0));
  bench.add_ring(ring, ring, 0);
  bench.dt = 1e-3;
  bench.evaluate();
  const kernel::JointState taut = bench.states[0];
  EXPECT_LT(taut.damper, 0);
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t n = 0; n < bench.x[d].size(); ++n) bench.x[d][n] += bench.dt * bench.v[d][n];
  bench.evaluate();
  EXPECT_EQ(bench.on_hosts.size(), 0u) << "slack";
  EXPECT_EQ(taut.straight_damper, 0);
  const Vec3 then(0.025, 0.009 - 0.004, 0), rim(0.025, 0.008 - 0.004, 0);
  const double shorter =
      then.norm() + (Vec3(0.05, 0, 0) - then).norm() - rim.norm() - (bench.place(1) - rim).norm();
  EXPECT_NEAR(bench.states[0].dissipated - taut.dissipated, -0.5 * taut.damper * shorter, 1e-12);
  const double booked = bench.states[0].dissipated;
  bench.evaluate();
  EXPECT_EQ(bench.states[0].dissipated, booked);
}

TEST(SlidingJoint, NothingPullsAtARingOnAStraightThread) {
  Bench bench;
  for (int k = 0; k < 3; ++k) bench.nodes.push_back(bench.add(Vec3(0.06 * k, 0, 0), Vec3::Zero()));
  const Index a = bench.add(Vec3(0.02, 0.001, 0), Vec3::Zero());
  bench.add_ring(a, bench.add(Vec3(0.04, 0.001, 0.002), Vec3::Zero()), 0);
  bench.evaluate();
  for (const kernel::Load& load : bench.on_hosts) EXPECT_EQ(Vec3(load.x, load.y, load.z), Vec3::Zero());
  EXPECT_NEAR(bench.states[0].tension, 1000 * 0.01, 1e-9);
  EXPECT_NEAR(bench.states[0].along, 0.05 * 0.0301 / 0.06, 1e-12);  // where the thread meets the ring's plane
}

// A thread of four elements with as many rings, some taut and some slack, over rims and through openings.
Bench any_thread(Dice& dice, int rings) {
  Bench bench;
  const double length = dice.between(0.85, 1.1) * bench.thread.rest_length;
  for (int k = 0; k < 5; ++k)
    bench.nodes.push_back(bench.add(Vec3(length * k, 0, 0) + dice.in_box(0.004), dice.in_box(1)));
  std::vector<double> along;
  for (int r = 0; r < rings; ++r) along.push_back(dice.between(0, 4));
  std::sort(along.begin(), along.end());
  for (const double s : along) {
    const Vec3 center = Vec3(length * s, 0, 0) + dice.in_box(0.005);
    const Vec3 normal = (Vec3::UnitX() + dice.in_box(0.3)).normalized();
    const Index a = bench.add(center - 0.02 * normal, dice.in_box(1));
    bench.add_ring(a, bench.add(center + 0.02 * normal, dice.in_box(1)), static_cast<Index>(s));
  }
  return bench;
}

std::vector<double> components(const std::vector<Vec3>& vectors) {
  std::vector<double> all;
  for (const Vec3& v : vectors) all.insert(all.end(), v.data(), v.data() + 3);
  return all;
}

// A step leaves out the ways of elements that are straight or slack; a look computes all.
TEST(SlidingJoint, AStepFeelsWhatALookSees) {
  Dice dice(6);
  int pulling = 0, idle = 0;
  for (int i = 0; i < 300; ++i) {
    Bench bench = any_thread(dice, 1 + i % 3);
    for (int round = 0; round < 30; ++round) bench.evaluate();
    const Bench before = bench;
    bench.dt = 1e-9;
    const std::vector<double> step = components(bench.forces());
    bool passed = false;
    for (const auto& state : bench.states) passed = passed || state.passes > 0;
    if (passed) continue;  // whose forces are mixed
    Bench looked_at = before;
    const std::vector<double> look = components(looked_at.forces());
    double size = 0;
    for (const double f : look) size = std::max(size, std::abs(f));
    for (std::size_t k = 0; k < look.size(); ++k) ASSERT_NEAR(step[k], look[k], 1e-3 * size) << i;
    (bench.on_hosts.empty() ? idle : pulling) += 1;
  }
  EXPECT_GT(pulling, 50);
  EXPECT_GT(idle, 50);
}

// Passings are sorted out by bounds; brute force: no ring has a neighbouring element that takes less energy.
TEST(SlidingJoint, AfterAStepNoNeighbouringThreadingIsLower) {
  Dice dice(7);
  int passes = 0;
  for (int i = 0; i < 300; ++i) {
    Bench bench = any_thread(dice, 1 + i % 3);
    for (auto& state : bench.states)  // some a node astray, in their order
      if (dice.between(0, 1) < 0.3) state.element = std::min(3, state.element + 1);
    for (std::size_t j = 1; j < bench.states.size(); ++j)
      bench.states[j].element = std::max(bench.states[j].element, bench.states[j - 1].element);
    bench.dt = 1e-9;
    for (int round = 0; round < 10; ++round) bench.evaluate();
    for (const auto& state : bench.states) passes += state.passes;
    bench.dt = 0;
    const auto settled = [](Bench one) {
      for (int round = 0; round < 30; ++round) one.evaluate();
      return one.energy();
    };
    const double energy = settled(bench);
    for (std::size_t j = 0; j < bench.states.size(); ++j)
      for (const int way : {-1, 1}) {
        Bench other = bench;
        Index& element = other.states[j].element;
        element += way;
        const Index low = j > 0 ? other.states[j - 1].element : 0;
        const Index high = j + 1 < other.states.size() ? other.states[j + 1].element : 3;
        if (element >= low && element <= high) {
          EXPECT_GE(settled(other), energy * (1 - 1e-3) - 1e-9) << i;
        }
      }
  }
  EXPECT_GT(passes, 50);
}

// ---- whole motions

/// Two masses on next to no thread over a point pulley: elements of half a metre are as good as many.
Scene light_atwood(int elements, const std::string& more = "") {
  Scene scene = scene_of(R"(
schema = 1
[time]
end_s = 1
step_s = 1e-5
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 10
[thread.main]
material = "m"
diameter_m = 0.002
elements = 4
points_m = [[0, -1e-6, -1], [0, 0, 0], [0, 1e-6, -1]]
start = { mass_kg = 0.2 }
end = { mass_kg = 0.3 }
[ring.pulley]
diameter_m = 0.007
wire_diameter_m = 0.0045
mass_kg = 1
youngs_modulus_Pa = 1e9
center_m = [0, 0, -0.0001]
normal = [0, 1, 0]
support = "fixed"
joint = "sliding"
)" + more);
  scene.threads[0].elements = elements;
  const double tension = 2 * 0.3 * 0.2 / 0.5 * g0;
  scene.threads[0].length = 2 / (1 + tension / (1e8 * circle(0.002)));
  return scene;
}

TEST(SlidingJoint, AtwoodsMachine) {
  for (const int elements : {4, 20}) {
    Simulation sim(light_atwood(elements), 1);
    const double t = 0.5, start = place(sim, 0).z();
    run_until(sim, t);
    const double acceleration = 2 * (place(sim, 0).z() - start) / (t * t), exact = g0 * 0.1 / 0.5;
    EXPECT_NEAR(acceleration / exact, 1, 0.005) << elements << " elements";
    EXPECT_GT(sim.state().joints[0].passes, elements == 4 ? -1 : 1);
  }
}

TEST(SlidingJoint, ProbesTellTensionAndThreadDrawnThrough) {
  const Scene scene = light_atwood(20, R"([probe.tension]
quantity = "tension"
of = "ring.pulley"
[probe.drawn]
quantity = "material_coordinate"
of = "ring.pulley"
)");
  Simulation sim(scene, 1);
  const double exact = g0 * 0.1 / 0.5, pull = 2 * 0.3 * 0.2 / 0.5 * g0;
  const double half = scene.threads[0].length / 2;  // its last end is the heavy one, which goes down
  double mean = 0;
  for (int i = 0; i < 100; ++i) {
    run_until(sim, 0.005 * i);
    const std::vector<double> row = sim.probe_row(sim.look());
    EXPECT_NEAR(half - row[1], exact * sim.time() * sim.time() / 2, 2e-3) << sim.time();
    mean += row[0] / 100;
  }
  EXPECT_NEAR(mean / pull, 1, 0.02);
}

std::vector<Event> ends_of(const Summary& summary) {
  std::vector<Event> ends;
  for (const Event& event : summary.events)
    if (event.kind == "thread_end") ends.push_back(event);
  return ends;
}

// The joint keeps an end that falls to its ring: that is told, once, and not before it is there.
TEST(SlidingJoint, AThreadDrawnToItsEndIsTold) {
  for (const double side : {1.0, -1.0}) {
    Scene scene = light_atwood(12);
    scene.threads[0].points = {Vec3(0, 0, 0.1), Vec3(0, 0, -0.9)};
    scene.threads[0].length = 0;
    scene.rings[0].center = Vec3::Zero();
    scene.rings[0].normal = Vec3(0, 0, side);
    Simulation sim(scene, 1);
    const double meets = std::sqrt(2 * 0.1 / g0);  // 0.143 s
    for (int i = 1; i <= 16; ++i) {                // as often as frames are written
      run_until(sim, 0.01 * i);
      sim.note_events(sim.look());
      EXPECT_EQ(ends_of(sim.summary()).empty(), sim.time() < meets) << sim.time();
    }
    const Summary summary = sim.summary();
    const std::vector<Event> ends = ends_of(summary);
    ASSERT_EQ(ends.size(), 1u);
    EXPECT_EQ(ends[0].name, "pulley: node 0 of thread.main");
    EXPECT_NEAR(ends[0].time, 0.15, 1e-4);
    const auto tells = [](const std::string& words) {
      return words.find("ring pulley: node 0 of thread.main") != std::string::npos;
    };
    EXPECT_EQ(std::count_if(summary.warnings.begin(), summary.warnings.end(), tells), 1);
  }
}

// ---- the thread that pulls a ring (Sec. 5.1)

Scene ring_pull(int elements, double damping_ratio = 0.106) {
  Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "ring_pull.toml");
  scene.threads[0].elements = elements;
  scene.rings[0].joint = RingJoint::sliding;
  scene.materials["thread"].damping_ratio = damping_ratio;
  return scene;
}

// With contact, 1600 elements put the ball to (0.579, -0.410) m and the ring to 0.301 m, 200 elements the
// ball 4 cm away from there.
TEST(SlidingJoint, FewElementsPullTheRingWhereManyDo) {
  for (const int elements : {6, 13, 26, 50}) {
    Scene scene = ring_pull(elements);
    scene.time.step = 6e-4 / elements;
    Simulation sim(scene, 1);
    run_until(sim, 1);
    const Vec3 ball = place(sim, 0), ring = place(sim, elements + 1);
    EXPECT_LT((ball - Vec3(0, 0.579, -0.410)).norm(), elements == 6 ? 0.006 : 0.004) << elements;
    EXPECT_NEAR(ring.y(), 0.301, 0.004) << elements;
    EXPECT_GE(sim.state().joints[0].passes, elements == 6 ? 1 : 3) << elements;
  }
}

// Every passing is a kink of the potential; its force jumps in the midst of a step.
TEST(SlidingJoint, NodesThatPassCreateNoEnergy) {
  for (const int elements : {13, 26}) {
    Scene scene = ring_pull(elements, 0);
    scene.time.step = 2e-6;
    Simulation sim(scene, 1);
    run_until(sim, 1);
    EXPECT_GE(sim.state().joints[0].passes, 4);
    EXPECT_LT(sim.summary().relative_residual, 1e-5) << elements;
  }
}

// A taut thread with a ring on it, from fixed end to fixed end; nothing moves if the ring does not feel the
// thread.
Scene ring_on_a_taut_thread(int elements, const std::string& thread, const std::string& ring) {
  return parse_case(R"(schema = 1
[time]
end_s = 1
[material.cord]
youngs_modulus_Pa = 10e9
density_kg_m3 = 970
[thread.rope]
material = "cord"
diameter_m = 0.002
start = { support = "fixed" }
end = { support = "fixed" }
elements = )" + std::to_string(elements) +
                        thread + R"(
[ring.a]
joint = "sliding"
diameter_m = 0.02
wire_diameter_m = 0.004
youngs_modulus_Pa = 70e9
)" + ring,
                    "taut.toml");
}

// Even numbers of elements have a node in the plane of the opening, and rounding decides on which side of it.
TEST(SlidingJoint, ARingAtRestOnATautThreadStaysSo) {
  for (const int elements : {11, 12, 20, 100}) {
    Simulation sim(ring_on_a_taut_thread(elements, R"(
points_m = [[-0.5, 0, 0], [0.5, 0, 0]]
length_m = 0.995)",
                                         R"(mass_kg = 0.01
center_m = [0, 0, 0]
normal = [1, 0, 0]
)"),
                   1);
    run_until(sim, 0.05);
    const Summary summary = sim.summary();
    EXPECT_LT(summary.energy.kinetic, 1e-20) << elements;
    EXPECT_LT(summary.ring_records[0].peak_force, 1e-6) << elements;
  }
}

// Each node that passes comes through the waypoint itself, with 160 N on both of its sides.
TEST(SlidingJoint, ARingThatSlidesDownATautThreadWinsNoEnergy) {
  for (const int elements : {12, 24}) {
    Simulation sim(ring_on_a_taut_thread(elements, R"(
points_m = [[0, 0, 0], [3, 0, -3]]
length_m = 4.22
[gravity]
acceleration_m_s2 = [0, 0, -9.81])",
                                         R"(mass_kg = 0.1
center_m = [0.3, 0, -0.3]
normal = [1, 0, -1]
)"),
                   1);
    run_until(sim, 0.6);
    EXPECT_GT(sim.state().joints[0].passes, 2) << elements;
    EXPECT_LT(sim.summary().relative_residual, 1e-4) << elements;
  }
}

TEST(SlidingJoint, NoEquilibriumIsSoughtOfAThreadInARing) {
  Scene scene = ring_on_a_taut_thread(12, R"(
points_m = [[-0.5, 0, 0], [0.5, 0, 0]]
length_m = 1.2
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[start]
equilibrium = true)",
                                      R"(mass_kg = 0.1
center_m = [0, 0, 0]
normal = [1, 0, 0]
support = "fixed"
)");
  std::string error;
  try {
    Simulation(scene, 1);
  } catch (const CaseError& found) {
    error = found.what();
  }
  EXPECT_NE(error.find("taut.toml:"), std::string::npos) << error;
  EXPECT_NE(error.find("start.equilibrium: found true, but thread.rope slides through ring 'a'"),
            std::string::npos)
      << error;
}

// At every look, with a thread that slackens and dampers that take as much as they can.
TEST(SlidingJoint, TheLedgerClosesForTautAndSlackElements) {
  Scene scene = ring_pull(9);
  scene.time.step = 0, scene.time.safety = 0.4;
  Simulation sim(scene, 1);
  double worst = 0;
  for (double time = 0.002; time < 1.001; time += 0.002) {
    run_until(sim, time);
    sim.look();
    worst = std::max(worst, sim.summary().relative_residual);
  }
  EXPECT_LT(worst, 4e-5);
}

// The look at step n takes the dampers up to n, which the step from there books. Where nodes pass, that step
// knows no last dampers.
TEST(SlidingJoint, ALookBooksWhatTheNextStepWill) {
  Scene scene = ring_pull(9);
  scene.time.step = 0, scene.time.safety = 0.4;
  Simulation sim(scene, 1);
  double greatest = 0;
  while (sim.time() < 1) {
    sim.advance_to(sim.step() + 20);
    const double booked = sim.look().energy().dissipated_damper, due = sim.state().joints[0].due;
    const Index passes = sim.state().joints[0].passes;
    sim.advance_to(sim.step() + 1);
    if (sim.state().joints[0].passes != passes) continue;
    const double dt = sim.preparation().timeline.after();
    EXPECT_NEAR(dissipated_by_dampers(sim.state(), dt), booked, 1e-14) << sim.time();
    greatest = std::max(greatest, dt * std::abs(due));
  }
  EXPECT_GT(greatest, 1e-12) << "the joint must have taken some";
}

// ---- rings on a net, several on each closing thread

Scene closing_net(int elements) {
  Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "capture.toml");
  for (Thread& thread : scene.threads) thread.elements = elements;
  for (Ring& ring : scene.rings) ring.joint = RingJoint::sliding;
  for (Net& net : scene.nets) net.stowed_factor = 1;
  for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 1;
  scene.targets.clear();
  scene.closing.time = 0.001;
  scene.time.step = 5e-6;
  scene.time.end = 1;
  return scene;
}

TEST(SlidingJoint, RingsKeepTheirOrderAndMomentum) {
  Simulation sim(closing_net(26), 1);
  run_until(sim, 0.0009);
  const Momentum start = half_step_momentum(sim.model(), sim.state());
  int passes = 0, shared = 0;
  for (int i = 1; i <= 50; ++i) {
    run_until(sim, 0.01 * i);
    const auto& joints = sim.state().joints;
    ASSERT_EQ(joints.size(), 16u);
    for (const kernel::SlidingThread& thread : sim.model().sliding_threads)
      for (Index j = thread.joint_begin; j < thread.joint_end; ++j) {
        ASSERT_GE(joints[at(j)].element, 0);
        ASSERT_LT(joints[at(j)].element, thread.elements);
        if (j == thread.joint_begin) continue;
        ASSERT_GE(joints[at(j)].element, joints[at(j - 1)].element) << "ring " << j << " overtook another";
        shared += joints[at(j)].element == joints[at(j - 1)].element;
      }
  }
  for (const auto& joint : sim.state().joints) passes += joint.passes;
  EXPECT_GT(passes, 20);
  EXPECT_GT(shared, 10) << "several rings in one element";
  const Momentum end = half_step_momentum(sim.model(), sim.state());
  const double scale = 1.2 * 1;  // kg m/s, a kilogram and more at 1 m/s
  EXPECT_LT((end.linear - start.linear).norm(), 1e-11 * scale);
  EXPECT_LT(sim.summary().angular_momentum_drift, 1e-5 * scale);  // waypoints of several rings are not exact
}

// Where the closing threads lie on the edges: rings in the middle of meshes 1, 4, 7 and 10, 0.1 m of towing
// thread before them. With three elements, two rings share one.
TEST(SlidingJoint, ClosingThreadsBeginInTheRingsOnTheirEdge) {
  for (const int elements : {3, 26}) {
    SCOPED_TRACE(elements);
    Simulation sim(closing_net(elements), 1);
    run_until(sim, 0.001);
    sim.look();
    const auto& joints = sim.state().joints;
    ASSERT_EQ(joints.size(), 16u);
    for (std::size_t j = 0; j < joints.size(); ++j)
      EXPECT_NEAR(joints[j].along, 0.15 + 0.3 * static_cast<double>(j % 4), 0.01) << j;
  }
}

// Contact comes near with 480 elements on each closing thread; with 240, the mouth is 5 % of its area ahead.
TEST(SlidingJoint, MouthClosesAsWithContactOfManyElements) {
  double area[2];
  for (const bool sliding : {false, true}) {
    Scene scene = closing_net(sliding ? 12 : 480);
    if (!sliding)
      for (Ring& ring : scene.rings) ring.joint = RingJoint::contact;
    scene.time.step = sliding ? 5e-6 : 1e-6;
    Simulation sim(scene, 1);
    run_until(sim, 0.001);
    const double open = mouth_area(sim.look().ring_centers());
    run_until(sim, 0.15);
    area[sliding] = mouth_area(sim.look().ring_centers()) / open;
  }
  EXPECT_LT(area[0], 0.75);
  EXPECT_NEAR(area[1], area[0], 0.01);
}

// ---- what frames tell

// From node to node through the waypoints that lie in an element, m.
double length_of_way(const ResultModel& model, const Frame& frame, Index element) {
  double length = 0;
  Vec3 from = frame.position[at(model.elements[at(element)][0])];
  const auto through = waypoints_in(frame, element);
  for (const Vec3& to : through) length += (to - from).norm(), from = to;
  return length + (frame.position[at(model.elements[at(element)][1])] - from).norm();
}

// The way that a frame shows is the one that pulls, but for what rings move in a step: a look does not move
// waypoints. Rings that share an element are lifted a little from each other.
TEST(SlidingJoint, AFrameShowsTheWayThatPulls) {
  int bent = 0;
  for (const bool net : {false, true}) {
    Scene scene = net ? closing_net(12) : ring_pull(13);
    scene.time.joint_steps = 1;
    if (!net) scene.time.step = 5e-5;
    Simulation sim(scene, 1);
    const ResultModel model = sim.result_model();
    ASSERT_EQ(model.joints.size(), net ? 16u : 1u);
    for (int i = 1; i <= 20; ++i) {
      run_until(sim, 0.015 * i);
      const Frame frame = sim.frame();
      for (std::size_t j = 0; j < model.joints.size(); ++j) {
        const Index e = frame.joint_element[j];
        const auto ring = at(model.joints[j].ring);
        EXPECT_EQ(model.element_part[at(e)], model.joints[j].part);
        const Vec3 offset = frame.joint_waypoint[j] - frame.ring_center[ring];
        const double opening = sim.model().joints[j].opening;
        ASSERT_LE(offset.norm(), opening * (1 + 1e-9));
        if (frame.strain[at(e)] <= 0) continue;
        const double length = model.rest_length[at(e)] * (1 + frame.strain[at(e)]);
        const bool alone = waypoints_in(frame, e).size() == 1;
        EXPECT_NEAR(length_of_way(model, frame, e), length, (alone ? 3e-5 : 2e-3) * length) << i << " " << j;
        const auto& ends = model.elements[at(e)];
        bent += length > 1.001 * (frame.position[at(ends[1])] - frame.position[at(ends[0])]).norm();
      }
    }
  }
  EXPECT_GT(bent, 30);
}

TEST(SlidingJoint, BeforeItsThreadIsThereAJointStandsAtItsRing) {
  Scene scene = closing_net(12);
  scene.closing.time = 0.01;
  scene.probes = {{"drawn", "ring.r2", ProbeQuantity::material_coordinate, {}},
                  {"tension", "ring.r2", ProbeQuantity::tension, {}}};
  Simulation sim(scene, 1);
  run_until(sim, 0.002);
  const std::vector<double> waiting = sim.probe_row(sim.look());
  EXPECT_NEAR(waiting[0], 0.1 + 0.35, 1e-9) << "behind the towing thread, in the middle of the fourth cell";
  EXPECT_EQ(waiting[1], 0);
  const Frame before = sim.frame(sim.look());
  ASSERT_EQ(before.joint_element.size(), 16u);
  EXPECT_TRUE(std::is_sorted(before.joint_element.begin(), before.joint_element.end()));
  for (std::size_t j = 0; j < 16; ++j)
    EXPECT_EQ(before.joint_waypoint[j], before.ring_center[at(sim.result_model().joints[j].ring)]);
  run_until(sim, 0.01);
  EXPECT_EQ(sim.frame(sim.look()).joint_element, before.joint_element);
  EXPECT_NEAR(sim.probe_row(sim.look())[0], waiting[0], 1e-3) << "laid as it lay";
}

// ---- hosts that fold

// The two ends of a slack host meet at 0.1 m/s and are pushed apart by the ring's body. `before`: parts that
// come before theirs, `after`: more.
Scene folding_host(const std::string& before = "", const std::string& after = "") {
  return scene_of(std::string(R"(schema = 1
[time]
end_s = 1
step_s = 1e-5
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 970
)") + before + R"([thread.carrier]
material = "m"
diameter_m = 0.002
elements = 1
points_m = [[-0.02, 0, 0], [0.02, 0, 0]]
start = { mass_kg = 0.1, velocity_m_s = [0.05, 0, 0] }
end = { mass_kg = 0.1, velocity_m_s = [-0.05, 0, 0] }
[thread.main]
material = "m"
diameter_m = 0.002
elements = 4
points_m = [[-0.1, 0, 0], [0.1, 0, 0]]
length_m = 0.3
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.03
youngs_modulus_Pa = 1e9
on = "thread.carrier"
element = 0
joint = "sliding"
)" + after);
}

TEST(SlidingJoint, ARingKeepsTheEndsOfItsHostApart) {
  const Scene scene = folding_host();
  Simulation sim(scene, 1);
  double least = 1;
  for (int i = 0; i < 45000; ++i) {
    sim.advance_to(sim.step() + 1);
    least = std::min(least, place(sim, 1).x() - place(sim, 0).x());
  }
  const double stiffness = 1e8 * circle(0.002) / 0.04, mass = 0.1 + 0.015 + 970 * circle(0.002) * 0.02;
  EXPECT_NEAR(least, 0.02 * 0.04 - 0.1 * std::sqrt(mass / 2 / stiffness), 1e-6);
  EXPECT_NEAR(sim.state().vx[0], -0.05, 1e-4);
  EXPECT_NEAR(sim.state().vx[1], 0.05, 1e-4);
  EXPECT_LT(sim.summary().relative_residual, 1e-5);
  Simulation at_once(scene, 1);  // looks at hosts as seldom as motion allows
  at_once.advance_to(sim.step());
  EXPECT_EQ(state_hash(at_once.state()), state_hash(sim.state()));
}

// A ball that nothing reaches has its list of pairs renewed on the way; a filler of 63 nodes puts the host's
// ends into the shares of different threads.
TEST(SlidingJoint, AHostIsKeptApartWhateverThreadsAndListsDo) {
  const Scene scene = folding_host(R"([thread.filler]
material = "m"
diameter_m = 0.002
elements = 62
points_m = [[-0.31, 1, 0], [0.31, 1, 0]]
)",
                                   R"([target.ball]
center_m = [0, 0, 1]
radius_m = 0.1
youngs_modulus_Pa = 2e9
[contact]
margin_m = 0.001
)");
  Simulation stepwise(scene, 1), at_once(scene, 1), shared(scene, 2);
  const std::int64_t steps = 45000;
  while (stepwise.step() < steps) stepwise.advance_to(stepwise.step() + 1);
  at_once.advance_to(steps);
  shared.advance_to(steps);
  EXPECT_LT(stepwise.state().vx[63], -0.04) << "pushed apart";
  EXPECT_GT(at_once.stepper().contacts().rebuilds(), 10);
  EXPECT_EQ(shared.threads(), 2);
  EXPECT_EQ(state_hash(at_once.state()), state_hash(stepwise.state()));
  EXPECT_EQ(state_hash(shared.state()), state_hash(stepwise.state()));
}

// A net that is stowed to 1 % begins with its hosts far shorter, and nothing is thrown apart.
TEST(SlidingJoint, HostsOfAStowedNetBeginUnpressed) {
  Scene scene = closing_net(12);
  scene.nets[0].stowed_factor = 0.01;
  for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 0.01;
  Simulation sim(scene, 1);
  sim.advance_to(sim.preparation().closing_step + 1);
  EXPECT_TRUE(sim.closed_phase());
  EXPECT_LT(sim.look().energy().elastic, 1e-9);
}

// Bunched rings on the slack edge: without that, one turned by 80 degrees in a step and threw 20 J into the
// net.
TEST(SlidingJoint, BunchedRingsOnASlackEdgeCreateNoEnergy) {
  const Scene scene = read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "edge_closure.toml",
                                {{"case.method", "sliding"},
                                 {"time.step_s", "auto"},
                                 {"time.safety", "0.3"},
                                 {"thread.closing.elements", "24"}});
  Simulation sim(scene, 1);
  for (int k = 1; k <= 500; ++k) {
    run_until(sim, 0.001 * k);
    ASSERT_NO_THROW(sim.check_energy(sim.look())) << sim.time();
  }
  EXPECT_LT(sim.summary().relative_residual, 1e-4);
}

// ---- rings with a node of their own, and threads beside each other

// Two masses on a thread through a ring that does not turn.
Scene two_masses(const std::string& ring_keys, const std::string& more = "") {
  return scene_of(R"(
schema = 1
[time]
end_s = 1
step_s = 1e-5
[material.m]
youngs_modulus_Pa = 1e8
density_kg_m3 = 970
damping_ratio = 0.05
[thread.main]
material = "m"
diameter_m = 0.002
elements = 12
points_m = [[0, -0.3, 0], [0, 0.4, 0.1]]
start = { mass_kg = 0.1, velocity_m_s = [0.3, 0, -1] }
end = { mass_kg = 0.05, velocity_m_s = [0, 0.2, 1] }
[ring.r]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.03
youngs_modulus_Pa = 1e9
center_m = [0, 0, 0.043]
normal = [0.2, 1, 0]
joint = "sliding"
)" + ring_keys + more);
}

void expect_conserved(Simulation& sim) {
  run_until(sim, 0.5);
  const Summary summary = sim.summary();
  EXPECT_LT(summary.linear_momentum_drift, 1e-13);
  EXPECT_LT(summary.angular_momentum_drift.value(), 1e-10);
  EXPECT_LT(summary.relative_residual, 2e-5);
  EXPECT_GT(summary.ring_records[0].peak_force, 0.3) << "the thread must pull at the ring";
}

// What the supports of a ring that cannot turn take is booked.
// A thread that comes to a ring's plane and goes back does not pass; which way the normal points is all one.
TEST(SlidingJoint, AThreadPassesFromOneSideToTheOther) {
  const auto scene = [](const std::string& points, int elements, const char* normal) {
    return scene_of(
        "schema = 1\n[time]\nend_s = 1\n[material.m]\nyoungs_modulus_Pa = 1e8\ndensity_kg_m3 = 970\n"
        "[thread.main]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = " +
        std::to_string(elements) + "\npoints_m = " + points +
        "\n[ring.r]\ndiameter_m = 0.02\nwire_diameter_m = 0.004\nmass_kg = 0.03\n"
        "youngs_modulus_Pa = 1e9\ncenter_m = [0, 0, 0]\njoint = \"sliding\"\nnormal = " +
        normal + "\n");
  };
  for (const char* normal : {"[0, 1, 0]", "[0, -1, 0]"}) {
    SCOPED_TRACE(normal);
    const Simulation through(scene("[[0, -0.5, 0], [0, 0.5, 0]]", 2, normal), 1);  // a node in the plane
    EXPECT_EQ(through.state().joints.size(), 1u);
    EXPECT_EQ(through.state().joints[0].element, 1);
    EXPECT_THROW(Simulation(scene("[[0, -0.5, 0], [0, 0, 0]]", 2, normal), 1), CaseError);
    EXPECT_THROW(Simulation(scene("[[0, -0.5, -0.1], [0, 0, 0], [0, -0.5, 0.1]]", 2, normal), 1), CaseError);
  }
}

TEST(SlidingJoint, MomentumAndEnergyAreBookedForRingsOfEverySupport) {
  for (const char* support : {"", "support = \"guided\"\naxis = [1, 0, 1]\n", "support = \"fixed\"\n"}) {
    SCOPED_TRACE(support);
    Simulation sim(two_masses(support), 1);
    expect_conserved(sim);
    EXPECT_GT(sim.state().joints[0].passes, 0);
  }
}

const std::string second_thread = R"([thread.second]
material = "m"
diameter_m = 0.002
elements = 10
points_m = [[-0.1, -0.3, 0.043], [0.1, 0.3, 0.043]]
start = { mass_kg = 0.05, velocity_m_s = [0, 0, 1] }
end = { mass_kg = 0.05, velocity_m_s = [0, 0, 0.5] }
)";

TEST(SlidingJoint, TwoThreadsSlideThroughOneRing) {
  Simulation sim(two_masses("", second_thread), 1);
  ASSERT_EQ(sim.state().joints.size(), 2u);
  expect_conserved(sim);
  for (const auto& joint : sim.state().joints) EXPECT_GT(joint.passes, 0);
}

// Without a word about it, rings slide where they can.
TEST(AutomaticJoint, SlidesWhereItsThreadsPassThroughOnceWithRoom) {
  const auto slides = [](const Scene& scene) { return Simulation(scene, 1).model().slides(0); };
  Scene scene = two_masses("", second_thread);
  scene.rings[0].joint = RingJoint::automatic;
  EXPECT_TRUE(slides(scene)) << "two threads pass through it";
  Scene named = scene;
  named.rings[0].threads = {"main", "second"};
  EXPECT_TRUE(slides(named));
  named.threads[1].points = {Vec3(0.1, -0.3, 0), Vec3(0.1, 0.3, 0)};
  EXPECT_FALSE(slides(named)) << "one of those it names passes elsewhere";
  named.rings[0].threads = {};
  EXPECT_TRUE(slides(named)) << "it names none: one is enough";
  Scene beside = scene;
  beside.rings[0].center = Vec3(0.5, 0, 0);
  EXPECT_FALSE(slides(beside));
  Scene twice = scene;
  twice.threads[0].points = {Vec3(0, -0.3, 0.043), Vec3(0, 0.4, 0.043), Vec3(0.001, -0.3, 0.043)};
  EXPECT_FALSE(slides(twice)) << "a thread that comes back through it";
  Scene thick = scene;
  thick.threads[0].diameter = 0.02;
  EXPECT_FALSE(slides(thick));
}

TEST(AutomaticJoint, IsTheDefault) {
  const std::string path = (std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "ring_pull.toml").string();
  const Scene plain = read_case(path, {{"case.method", "sliding"}, {"time.step_s", "auto"}});
  EXPECT_TRUE(Simulation(plain, 1).model().slides(0));
  EXPECT_FALSE(Simulation(read_case(path), 1).model().slides(0)) << "the paper's case asks for contact";
}

TEST(SlidingJoint, RingsWithContactStandBesideThoseThatSlide) {
  Scene scene = two_masses("threads = [\"main\"]\n", second_thread + R"([ring.touched]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.03
youngs_modulus_Pa = 1e8
center_m = [0.02, 0.06, 0.0501]
normal = [0.3, 1, 0]
threads = ["second"]
)");
  scene.time.step = 2e-6;
  Simulation sim(scene, 1);
  expect_conserved(sim);
  EXPECT_EQ(sim.state().joints.size(), 1u);
  EXPECT_GT(sim.summary().ring_records[1].peak_force, 0.01) << "the second thread must touch its ring";
}

// ---- what cannot be

std::string refusal(const std::vector<Override>& sets) {
  std::vector<Override> all{{"ring.r1.joint", "\"sliding\""}};
  all.insert(all.end(), sets.begin(), sets.end());
  try {
    assemble(read_case(std::filesystem::path(CINCH_SOURCE_DIR) / "cases" / "ring_pull.toml", all));
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

TEST(SlidingJoint, AThreadThatPassesElsewhereMayBeTooThick) {
  Scene scene = ring_pull(13);
  Thread rope = scene.threads[0];
  rope.name = "rope";
  rope.diameter = 0.1;
  for (Vec3& point : rope.points) point.x() += 1;
  scene.threads.push_back(rope);
  EXPECT_EQ(assemble(scene).rings[0].threadings.size(), 1u);
}

TEST(SlidingJoint, ImpossibleThreadingsAreNamed) {
  const auto expect = [](const std::vector<Override>& sets, const std::string& words) {
    const std::string error = refusal(sets);
    EXPECT_NE(error.find("ring_pull.toml:"), std::string::npos) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  EXPECT_EQ(refusal({}), "");
  expect({{"ring.r1.center_m", "[0, 0, 0.03]"}}, "no thread passes through it");
  expect({{"ring.r1.center_m", "[0, 0, 0.03]"}, {"ring.r1.threads", "[\"main\"]"}},
         "thread 'main' does not pass through it");
  expect({{"ring.r1.diameter_m", "0.0055"}},
         "its opening of 0.0015 m leaves no room for thread 'main' of 0.002 m");
  expect({{"thread.main.points_m", "[[0, -0.2, 0], [0, 0.4, 0], [0, -0.1, 0.005], [0, 0.8, 0]]"}},
         "passes through it 3 times");
}

// ---- the stable step

TEST(SlidingJoint, StepBelowTheBoundIsStableForLightRings) {
  // one heavy ring leaves the thread's own bound, light ones pull it down
  const double alone = prepare(ring_pull(13)).stable_step;
  for (const double mass : {1e-1, 1e-4, 1e-5}) {
    Scene scene = ring_pull(13);
    scene.rings[0].mass = mass;
    const double bound = prepare(scene).stable_step;
    EXPECT_LT(bound, alone * (1 + 1e-12));
    if (mass < 1e-3) {
      EXPECT_LT(bound, 0.9 * alone);
    }
    scene.time.step = 0.98 * bound;
    Simulation sim(scene, 1);
    run_until(sim, 0.3);
    EXPECT_LT(std::abs(sim.summary().energy.residual), 0.05 * 0.05) << mass;
  }
}

}  // namespace
}  // namespace cinch
