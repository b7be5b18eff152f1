// Ways through rings that are found side by side are, bit by bit, those found alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/aligned.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/way_lanes.hpp"
#include "support/dice.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

using namespace test;

// ---- through the kernel: threads of one element each, all in one call or each in a call of its own

struct Found {
  std::vector<kernel::JointState> states;
  std::vector<kernel::Load> on_threads, on_hosts;
};

struct Threads {
  std::array<std::vector<double>, 3> x, v;
  std::vector<Index> nodes;
  std::vector<kernel::Joint> joints;
  std::vector<kernel::JointState> states;
  std::vector<kernel::SlidingThread> threads;

  Index add(const Vec3& place, const Vec3& velocity) {
    for (int d = 0; d < 3; ++d) x[at(d)].push_back(place[d]), v[at(d)].push_back(velocity[d]);
    return static_cast<Index>(x[0].size()) - 1;
  }

  // A thread from a to b through rings that are fixed; `looseness` of its rest length.
  void add_thread(Dice& dice, int rings, double looseness) {
    const Vec3 a = dice.in_box(0.1), b = a + Vec3(0.06, 0, 0) + dice.in_box(0.01);
    const auto begin = static_cast<Index>(nodes.size()), first = static_cast<Index>(joints.size());
    nodes.push_back(add(a, dice.in_box(1)));
    nodes.push_back(add(b, dice.in_box(1)));
    Vec3 last = a;
    for (int r = 0; r < rings; ++r) {
      const double share = (r + dice.between(0, 1)) / rings;
      Vec3 center = a + share * (b - a) + dice.in_box(dice.between(0, 1) < 0.2 ? 0.002 : 0.02);
      if (r > 0 && dice.between(0, 1) < 0.2) center = last;  // two at one place
      last = center;
      const Index host = add(center, dice.in_box(1));
      const Vec3 normal = dice.direction();
      const double opening = std::pow(10, dice.between(-3, -1.7));
      joints.push_back({static_cast<Index>(joints.size()),
                        host,
                        host,
                        {normal.x(), normal.y(), normal.z()},
                        opening,
                        0,
                        0});
      const Vec3 on_rim = opening * normal.cross(dice.direction()).normalized();  // if only by chance well
      const Vec3 guess = dice.between(0, 1) < 0.3 ? Vec3::Zero() : on_rim;
      states.push_back({});
      for (int d = 0; d < 3; ++d) states.back().offset[d] = guess[d];
    }
    threads.push_back(
        {begin, 1, first, static_cast<Index>(joints.size()), 1000, 0.1, looseness * (b - a).norm(), true});
  }

  Found evaluate(std::size_t first, std::size_t count, double dt) const {
    Found found{states, std::vector<kernel::Load>(4 * joints.size()),
                std::vector<kernel::Load>(4 * joints.size())};
    const std::vector<kernel::RingTally*> books(joints.size(), nullptr);
    const std::vector<double> mobility(nodes.size(), 100);
    std::vector<kernel::SlidingLoads> ends(count);
    AlignedVector<double> scratch(kernel::sliding_scratch + joints.size() * kernel::joint_scratch);
    const kernel::ContactArguments contact{x[0].data(), x[1].data(), x[2].data(), v[0].data(),
                                           v[1].data(), v[2].data(), nullptr,     0,
                                           0,           dt,          1e-6};
    const kernel::SlidingArguments all{contact,
                                       0,
                                       1e-6,
                                       nodes.data(),
                                       mobility.data(),
                                       &threads[first],
                                       static_cast<Index>(count),
                                       joints.data(),
                                       found.states.data(),
                                       books.data(),
                                       ends.data(),
                                       scratch.data()};
    kernels().sliding_joints(all, found.on_threads.data(), found.on_hosts.data());
    found.on_threads.resize(at(ends.back().threads));
    found.on_hosts.resize(at(ends.back().hosts));
    return found;
  }
};

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// `one` is what stands in `all` from `from` on, which goes behind it.
void expect_part(const std::vector<kernel::Load>& one, const std::vector<kernel::Load>& all,
                 std::size_t& from) {
  ASSERT_LE(from + one.size(), all.size());
  for (const kernel::Load& a : one) {
    const kernel::Load& b = all[from++];
    ASSERT_TRUE(a.node == b.node && same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z));
  }
}

// Each thread alone: a call for fewer than three elements finds them one after the other.
void expect_the_same_alone(const Threads& threads, double dt) {
  const Found all = threads.evaluate(0, threads.threads.size(), dt);
  std::size_t on_threads = 0, on_hosts = 0;
  for (std::size_t t = 0; t < threads.threads.size(); ++t) {
    const Found one = threads.evaluate(t, 1, dt);
    const kernel::SlidingThread& thread = threads.threads[t];
    for (auto j = at(thread.joint_begin); j < at(thread.joint_end); ++j)  // a state has no padding
      ASSERT_EQ(std::memcmp(&one.states[j], &all.states[j], sizeof one.states[j]), 0) << t;
    expect_part(one.on_threads, all.on_threads, on_threads);
    expect_part(one.on_hosts, all.on_hosts, on_hosts);
  }
  EXPECT_EQ(on_threads, all.on_threads.size());
  EXPECT_EQ(on_hosts, all.on_hosts.size());
}

TEST(WayLanes, FindWhatIsFoundAlone) {
  Dice dice(1);
  for (int run = 0; run < 1000; ++run) {
    Threads threads;
    const int count = 3 + run % 20;
    for (int t = 0; t < count; ++t)
      threads.add_thread(dice, run % 3 == 0 ? 1 : 1 + static_cast<int>(dice.between(0, 10)),
                         dice.between(0.9, 1.3));
    expect_the_same_alone(threads, 1e-6);
    expect_the_same_alone(threads, 0);  // a look, which finds slack ways as well
  }
}

// ---- the lanes themselves

plain::V3 plain_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Rings at places from 0 to 0.1 m along x, nodes 2 cm beside it: most ways lead over a rim.
void fill_lane(plain::WayLanes& lanes, int i, int rings, Dice& dice) {
  lanes.rings.put(i, rings);
  put(plain_of(Vec3(0, 0.02, 0) + dice.in_box(0.002)), lanes.place[0], i);
  lanes.lift2[0].put(i, 0);
  for (int k = 0; k < rings; ++k) {
    const double radius = 0.005;
    put(plain_of(Vec3(0.1 * (k + 1) / (rings + 1), 0, 0) + dice.in_box(0.002)), lanes.opening[k].center, i);
    put(plain_of((Vec3::UnitX() + dice.in_box(0.3)).normalized()), lanes.opening[k].normal, i);
    lanes.opening[k].radius.put(i, radius);
    put({0, 0, 0}, lanes.offset[k], i);
    put(at(lanes.opening[k].center, i), lanes.place[k + 1], i);
    const double lift = radius / 16;
    lanes.lift2[k + 1].put(i, k + 1 < rings ? lift * lift : 0);
  }
  put(plain_of(Vec3(0.1, 0.02, 0) + dice.in_box(0.002)), lanes.end, i);
  put(at(lanes.end, i), lanes.place[rings + 1], i);
}

TEST(WayLanes, LeaveFewWaysToBeFoundAlone) {
  Dice dice(2);
  plain::WayLanes lanes;
  int hard = 0;
  constexpr int runs = 200;
  for (int run = 0; run < runs; ++run) {
    for (int i = 0; i < plain::way_lanes; ++i) fill_lane(lanes, i, 1 + i % 4, dice);
    find_way_lanes(lanes);
    for (int i = 0; i < plain::way_lanes; ++i) hard += lanes.hard[i] > 0;
  }
  EXPECT_LT(hard, runs * plain::way_lanes / 50);
}

// Whatever the width of registers: eight.hpp has a branch for each.
TEST(WayLanes, PassOneRingAsShortestPassage) {
  Dice dice(4);
  plain::WayLanes lanes;
  int rim = 0;
  for (int run = 0; run < 200; ++run) {
    for (int i = 0; i < plain::way_lanes; ++i) fill_lane(lanes, i, 1, dice);
    std::vector<plain::Passage> alone;
    for (int i = 0; i < plain::way_lanes; ++i) {
      const auto& o = lanes.opening[0];
      alone.push_back(shortest_passage(plain::Opening{at(o.center, i), at(o.normal, i), o.radius[i]},
                                       {at(lanes.place[0], i), 0}, {at(lanes.end, i), 0}, {0, 0, 0}));
    }
    find_way_lanes(lanes);
    for (int i = 0; i < plain::way_lanes; ++i) {
      if (lanes.hard[i] > 0) continue;
      const plain::V3 found = at(lanes.offset[0], i), right = alone[at(i)].offset;
      ASSERT_TRUE(same_bits(found.x, right.x) && same_bits(found.y, right.y) && same_bits(found.z, right.z));
      ASSERT_EQ(lanes.straight[i] > 0, alone[at(i)].straight);
      rim += norm(found) > 0.999 * lanes.opening[0].radius[i];
    }
  }
  EXPECT_GT(rim, 200);
}

// A node in the middle of the opening, whose direction from there is none.
TEST(WayLanes, SayWhereTheyFindNothing) {
  Dice dice(3);
  plain::WayLanes lanes;
  for (int i = 0; i < plain::way_lanes; ++i) fill_lane(lanes, i, 1, dice);
  for (plain::Eights* end : {&lanes.place[0], &lanes.place[2], &lanes.end})
    put(at(lanes.opening[0].center, 5), *end, 5);
  find_way_lanes(lanes);
  for (int i = 0; i < plain::way_lanes; ++i) EXPECT_EQ(lanes.hard[i] > 0, i == 5) << i;
}

}  // namespace
}  // namespace cinch
