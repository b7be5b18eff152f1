// The broadphase against brute force: no pair too few, none too many, and a list that stays good for as
// long as it is used.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "input/case_reader.hpp"
#include "oracle/closest.hpp"
#include "plan/contact_list.hpp"
#include "plan/simulation.hpp"
#include "store/fields.hpp"
#include "support/quick_cases.hpp"

namespace {

using namespace cinch;
using test::large_capture_with;
using Sets = std::vector<Override>;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Scene read(const std::string& name, const Sets& sets = {}) {
  return read_case(std::string(CINCH_SOURCE_DIR) + "/cases/" + name + ".toml", sets);
}

Scene net_with_rings(int columns) {
  Sets sets = large_capture_with(columns);
  sets.push_back({"time.step_s", "1e-6"});
  return read("large_capture", sets);
}

struct Built {
  Scene scene;
  Assembly assembly;
  Model model;
  State state;

  explicit Built(const Scene& from)
      : scene(from),
        assembly(assemble(scene)),
        model(build_model(assembly, scene, Stage::closing)),
        state(initial_state(model, assembly)) {}
};

Vec3 place(const State& s, Index i) { return {s.x[at(i)], s.y[at(i)], s.z[at(i)]}; }

double distance_to_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
  return oracle::closest_to_point(a, b, point).distance;
}

// ----------------------------------------------------------------------------------------------------
// The list of one state

bool allowed(const Assembly& assembly, const std::vector<Index>& parts, Index user_element) {
  return std::find(parts.begin(), parts.end(), assembly.elements[at(user_element)].part) != parts.end();
}

double thickest(const Assembly& assembly, const std::vector<Index>& parts) {
  double most = 0;
  for (Index e = 0; e < static_cast<Index>(assembly.elements.size()); ++e)
    if (allowed(assembly, parts, e)) most = std::max(most, assembly.elements[at(e)].radius);
  return most;
}

// The pairs [begin, end) must be all allowed elements within `reach` of `center`, in ascending order.
void expect_all_within(const Built& b, const ContactList& list, Index begin, Index end,
                       const std::vector<Index>& parts, const Vec3& center, double reach) {
  std::vector<char> listed(at(b.model.elements));
  for (Index i = begin; i < end; ++i) {
    const kernel::Pair& c = list.pairs[at(i)];
    ASSERT_TRUE(i == begin || list.pairs[at(i) - 1].element < c.element);
    ASSERT_EQ(c.a, b.model.end_a[at(c.element)]);
    ASSERT_EQ(c.b, b.model.end_b[at(c.element)]);
    listed[at(c.element)] = 1;
  }
  for (Index e = 0; e < b.model.elements; ++e) {
    const double distance = allowed(b.assembly, parts, e)
                                ? distance_to_segment(place(b.state, b.model.end_a[at(e)]),
                                                      place(b.state, b.model.end_b[at(e)]), center)
                                : 1e300;
    if (std::abs(distance - reach) < 1e-12) continue;  // rounding may decide
    ASSERT_EQ(listed[at(e)] != 0, distance < reach)
        << "element " << e << " at " << distance << " m, reach " << reach;
  }
}

// Checks the whole list; returns the number of pairs.
std::size_t expect_as_brute_force(Built& b, double margin) {
  ContactList list(b.model, margin);
  list.rebuild(b.model, b.state);
  EXPECT_EQ(list.ring_begin.size(), b.model.rings.size() + 1);
  EXPECT_EQ(list.ball_begin.size(), b.model.balls.size() + 1);
  EXPECT_EQ(list.ring_begin.back(), list.ball_begin.front());
  EXPECT_EQ(list.ball_begin.back(), static_cast<Index>(list.pairs.size()));
  for (std::size_t r = 0; r < b.assembly.rings.size(); ++r) {
    const AssemblyRing& ring = b.assembly.rings[r];
    const Vec3 center = ring.element < 0
                            ? place(b.state, ring.node)
                            : Vec3(0.5 * (place(b.state, b.assembly.elements[at(ring.element)].a) +
                                          place(b.state, b.assembly.elements[at(ring.element)].b)));
    const double reach = ring.radius + ring.wire_radius + thickest(b.assembly, ring.parts) + list.margin();
    expect_all_within(b, list, list.ring_begin[r], list.ring_begin[r + 1], ring.parts, center, reach);
    if (testing::Test::HasFatalFailure()) return 0;
  }
  for (std::size_t i = 0; i < b.assembly.balls.size(); ++i) {
    const AssemblyBall& ball = b.assembly.balls[i];
    expect_all_within(b, list, list.ball_begin[i], list.ball_begin[i + 1], ball.parts, ball.center,
                      ball.radius + thickest(b.assembly, ball.parts) + list.margin());
    if (testing::Test::HasFatalFailure()) return 0;
  }
  return list.pairs.size();
}

// Moves every node by up to `shift` m after a shrink of the scene about `center`.
void scatter(Built& b, double factor, const Vec3& center, double shift, unsigned seed) {
  b.state = initial_state(b.model, b.assembly);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-shift, shift);
  for (std::size_t i = 0; i < at(b.model.nodes); ++i) {
    b.state.x[i] = center.x() + factor * (b.state.x[i] - center.x()) + noise(random);
    b.state.y[i] = center.y() + factor * (b.state.y[i] - center.y()) + noise(random);
    b.state.z[i] = center.z() + factor * (b.state.z[i] - center.z()) + noise(random);
  }
}

TEST(Broadphase, PairsAreThoseOfBruteForce) {
  for (const char* name : {"ring_pull", "edge_closure", "capture"}) {
    SCOPED_TRACE(name);
    Built b(read(name, name == std::string("capture") ? Sets{{"net.main.stowed_factor", "1"}} : Sets{}));
    std::size_t seen = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
      for (const double margin : {0.0, 0.0005, 0.03}) {
        scatter(b, 1, {0, 0, 0}, 0.003 * seed, seed);  // nearly as laid
        seen += expect_as_brute_force(b, margin);
        scatter(b, 1, {0, 0, 0}, 0.4, seed);  // no order left: long elements everywhere
        seen += expect_as_brute_force(b, margin);
        scatter(b, 0.05, {0.1, 0.2, 1.05}, 0.004, seed);  // bunched, beside the ball
        seen += expect_as_brute_force(b, margin);
      }
    }
    EXPECT_GT(seen, 1000u) << "an empty list would prove nothing";
  }
}

TEST(Broadphase, DegenerateStates) {
  Built b(read("capture"));
  b.state = initial_state(b.model, b.assembly);
  for (auto* field : {&b.state.x, &b.state.y, &b.state.z}) std::fill(field->begin(), field->end(), 0.25);
  const std::size_t all = expect_as_brute_force(b, 0.001);  // all in one point
  EXPECT_EQ(all, 16u * 960u);
  for (auto* field : {&b.state.x, &b.state.y, &b.state.z})
    for (std::size_t i = 0; i < field->size(); ++i)
      (*field)[i] = 10 * static_cast<double>(i);  // all far apart
  expect_as_brute_force(b, 0.001);
}

TEST(Broadphase, ListedThreadsOnly) {
  Built b(read("capture", {{"net.main.stowed_factor", "1"},
                           {"rings.r.threads", "[\"c_top\"]"},
                           {"target.ball.touches", "[\"mechanism.m1\", \"thread.c_left\"]"}}));
  scatter(b, 0.05, {0, 0, 1}, 0.02, 3);
  EXPECT_GT(expect_as_brute_force(b, 0.01), 100u);
  scatter(b, 1, {0, 0, 0}, 0.02, 4);
  expect_as_brute_force(b, 0.01);
}

// ----------------------------------------------------------------------------------------------------
// A running scene

struct Watched {
  long pairs_near = 0, pairs_in_contact = 0, looks = 0;
};

// Every pair that is nearer than its reach, and so every pair in contact, must stand in the list that the
// stepper uses for the present state.
void look(Simulation& simulation, const Assembly& assembly, Watched& seen) {
  State& state = simulation.state();
  const Model& model = simulation.model();
  simulation.look();
  const ContactList& list = simulation.stepper().contacts();
  const auto listed = [&](Index begin, Index end, Index element) {
    for (Index i = begin; i < end; ++i)
      if (list.pairs[at(i)].element == element) return true;
    return false;
  };
  ++seen.looks;
  for (Index e = 0; e < model.elements; ++e) {
    const AssemblyElement& element = assembly.elements[at(e)];
    const Vec3 a = place(state, element.a), b = place(state, element.b);
    for (std::size_t r = 0; r < assembly.rings.size(); ++r) {
      const AssemblyRing& ring = assembly.rings[r];
      if (!allowed(assembly, ring.parts, e)) continue;
      const AssemblyElement& host = assembly.elements[at(ring.element)];
      const Vec3 h_a = place(state, host.a), h_b = place(state, host.b), center = 0.5 * (h_a + h_b);
      const double touch = element.radius + ring.wire_radius;
      // who touches the circle passes its centre within the radius and the contact distance
      if (((a + b) / 2 - center).norm() - (b - a).norm() / 2 > ring.radius + touch) continue;
      if (distance_to_segment(a, b, center) >= ring.radius + touch) continue;
      ++seen.pairs_near;
      ASSERT_TRUE(listed(list.ring_begin[r], list.ring_begin[r + 1], e)) << "ring " << r << ", element " << e;
      const Vec3 normal = (h_b - h_a).normalized();
      seen.pairs_in_contact += oracle::closest_to_circle(a, b, center, normal, ring.radius).distance < touch;
    }
    for (std::size_t i = 0; i < assembly.balls.size(); ++i) {
      const AssemblyBall& ball = assembly.balls[i];
      if (!allowed(assembly, ball.parts, e)) continue;
      if (distance_to_segment(a, b, ball.center) >= element.radius + ball.radius) continue;
      ++seen.pairs_in_contact;
      ASSERT_TRUE(listed(list.ball_begin[i], list.ball_begin[i + 1], e)) << "ball " << i << ", element " << e;
    }
  }
}

const Sets& near_capture() {
  static const Sets sets{{"net.main.stowed_factor", "1"},
                         {"closing.time_s", "0.0005"},
                         {"target.ball.center_m", "[0.05, 0, 0.1505]"}};
  return sets;
}

TEST(Broadphase, ARunningCaptureMissesNoContact) {
  Sets sets = near_capture();
  sets.push_back({"contact.margin_m", "0.0005"});  // small: many lists, each used to its end
  const Scene scene = read("capture", sets);
  const Assembly assembly = assemble(scene);
  Simulation simulation(scene, 1);
  simulation.advance_to(12000);
  Watched seen;
  while (simulation.step() < 40000 && !HasFatalFailure()) {
    // to the last step before a new list, and the first one after it
    const std::int64_t lists = simulation.stepper().contacts().rebuilds();
    while (simulation.stepper().contacts().rebuilds() == lists && simulation.step() < 40000) {
      if (simulation.step() % 16 == 0) look(simulation, assembly, seen);
      simulation.advance_to(simulation.step() + 1);
      simulation.look();
    }
    look(simulation, assembly, seen);
    simulation.advance_to(simulation.step() + 400);
  }
  EXPECT_GT(seen.pairs_near, 1000);
  EXPECT_GT(seen.pairs_in_contact, 200);
  EXPECT_GT(seen.looks, 100);
}

TEST(Broadphase, AListServesManySteps) {
  Simulation simulation(read("capture", near_capture()), 1);
  simulation.advance_to(20000);
  const ContactList& list = simulation.stepper().contacts();
  EXPECT_GT(list.rebuilds(), 5);
  EXPECT_LT(list.rebuilds(), 20000 / 50) << "a step normally pays nothing for the broadphase";
}

// ----------------------------------------------------------------------------------------------------
// What the list does not change, and what it costs

TEST(Broadphase, TheMarginDoesNotChangeTheMotion) {
  std::vector<std::uint64_t> hashes;
  std::vector<std::int64_t> lists;
  for (const char* margin : {"0", "0.0002", "0.002", "0.05"}) {
    Sets sets = near_capture();
    sets.push_back({"contact.margin_m", margin});
    Simulation simulation(read("capture", sets), 1);
    simulation.advance_to(20000);
    hashes.push_back(state_hash(simulation.state()));
    lists.push_back(simulation.stepper().contacts().rebuilds());
    std::size_t touched = 0;
    for (const auto& ring : simulation.state().rings) touched += ring.first_time >= 0;
    EXPECT_GE(touched, 4u);
  }
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
  EXPECT_GT(lists[1], lists[2]);
  EXPECT_GT(lists[2], lists[3]);
}

TEST(Broadphase, ThreadsFindTheSamePairs) {
  Built b(net_with_rings(50));
  scatter(b, 1, {0, 0, 0}, 0.01, 5);
  ContactList alone(b.model, 0.02);
  alone.rebuild(b.model, b.state);
  EXPECT_GT(alone.pairs.size(), 1000u);
  for (const int threads : {2, 5}) {
    ContactList shared(b.model, 0.02, threads);
    for (int once_more = 0; once_more < 2; ++once_more) {
      shared.rebuild(b.model, b.state);
      EXPECT_EQ(shared.ring_begin, alone.ring_begin);
      EXPECT_EQ(shared.ball_begin, alone.ball_begin);
      ASSERT_EQ(shared.pairs.size(), alone.pairs.size());
      for (std::size_t i = 0; i < alone.pairs.size(); ++i) {
        EXPECT_EQ(shared.pairs[i].element, alone.pairs[i].element) << "pair " << i;
        EXPECT_EQ(shared.pairs[i].with, alone.pairs[i].with) << "pair " << i;
      }
    }
    EXPECT_EQ(shared.pairs_tested(), 2 * alone.pairs_tested());
  }
}

// Tests of boxes and elements for one list.
std::int64_t pairs_tested(const Built& b, State state) {
  ContactList list(b.model, 0.0025);
  list.rebuild(b.model, state);
  return list.pairs_tested();
}

TEST(Broadphase, CostGrowsNoFasterThanNLogN) {
  struct Row {
    double elements, rings, laid, shaken;
  };
  std::vector<Row> rows;
  for (const int columns : {12, 25, 50, 100, 200}) {
    Built b(net_with_rings(columns));
    const double laid = static_cast<double>(pairs_tested(b, b.state));
    scatter(b, 1, {0, 0, 0}, 0.01, 5);
    rows.push_back({static_cast<double>(b.model.contact_sets[at(b.model.ring_set.front())].elements.size()),
                    static_cast<double>(b.model.rings.size()), laid,
                    static_cast<double>(pairs_tested(b, b.state))});
  }
  EXPECT_EQ(rows.front().rings, 48);
  EXPECT_EQ(rows.back().rings, 800);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Row &a = rows[i - 1], &b = rows[i];
    const double growth = b.rings / a.rings * std::log2(b.elements) / std::log2(a.elements);
    EXPECT_LE(b.laid / a.laid, 1.1 * growth) << b.rings << " rings";
    EXPECT_LE(b.shaken / a.shaken, 1.1 * growth) << b.rings << " rings";
  }
  // brute force would test 800 x 16000 pairs
  EXPECT_LT(rows.back().laid, 0.02 * rows.back().rings * rows.back().elements);
}

}  // namespace
