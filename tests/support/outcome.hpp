// Everything that a simulation has computed, as bits.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <vector>

#include "plan/simulation.hpp"
#include "store/fields.hpp"

namespace cinch::test {

template <class List>
inline void append(std::string& bits, const List& list) {
  static_assert(std::has_unique_object_representations_v<typename List::value_type> ||
                    std::is_trivially_copyable_v<typename List::value_type>,
                "plain data without pointers");
  bits.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(typename List::value_type));
}

static_assert(sizeof(kernel::JointState) == 13 * sizeof(double) + 4 * sizeof(int),
              "no padding between its fields");
static_assert(sizeof(kernel::RingTally) == 16 * sizeof(double) + 2 * sizeof(int),
              "no padding between its fields");

struct Outcome {
  std::uint64_t hash = 0;
  std::string nodes, rings, joints, reactions, dissipated, energies, frame;
  double ball_impulse = 0;
  std::size_t rings_touched = 0;
  bool ball_touched = false, closed = false;

  bool operator==(const Outcome&) const = default;
};

inline Outcome outcome_of(Simulation& simulation) {
  Outcome out;
  const Frame frame = simulation.frame();  // brings all tallies to the present step
  const State& s = simulation.state();
  out.hash = state_hash(s);
  for (const auto* field : {&s.x, &s.y, &s.z, &s.vx, &s.vy, &s.vz}) append(out.nodes, *field);
  append(out.rings, s.rings);
  append(out.joints, s.joints);
  append(out.reactions, s.reactions);
  append(out.dissipated, s.dissipated);
  append(out.energies, frame.energy.values());
  append(out.frame, frame.tension);
  for (const auto* field : {&frame.position, &frame.velocity, &frame.contact_force, &frame.ring_force})
    for (const Vec3& v : *field) append(out.frame, std::vector<double>{v.x(), v.y(), v.z()});
  for (const auto& ball : s.balls)
    for (const kernel::BallTally& tally : ball) {
      out.ball_impulse +=
          tally.impulse[0] + 3 * tally.impulse[1] + 7 * tally.impulse[2] + 11 * tally.dissipated;
      out.ball_touched = out.ball_touched || tally.first_time >= 0;
    }
  for (const kernel::RingTally& ring : s.rings) out.rings_touched += ring.first_time >= 0;
  out.closed = simulation.closed_phase();
  return out;
}

inline void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_TRUE(a.nodes == b.nodes) << "node fields";
  EXPECT_TRUE(a.rings == b.rings) << "ring tallies";
  EXPECT_TRUE(a.joints == b.joints) << "sliding joints";
  EXPECT_TRUE(a.reactions == b.reactions) << "reactions";
  EXPECT_TRUE(a.dissipated == b.dissipated) << "energy lost in dampers";
  EXPECT_TRUE(a.energies == b.energies) << "energies";
  EXPECT_TRUE(a.frame == b.frame) << "frame";
  EXPECT_TRUE(a == b) << "anything else";
}

}  // namespace cinch::test
