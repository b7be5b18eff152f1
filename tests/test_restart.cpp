// A simulation that goes on from what was saved is the one that was never stopped, to the last bit; what does
// not belong to it is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "plan/simulation.hpp"
#include "support/file_error.hpp"
#include "support/memory_archive.hpp"
#include "support/outcome.hpp"
#include "support/quick_cases.hpp"
#include "support/scenes.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

Entries saved(Simulation& simulation) {
  MemoryArchive archive;
  simulation.save(archive);
  return archive.entries;
}

Simulation restored(const Scene& scene, int threads, const Entries& entries) {
  MemoryArchive archive(entries);
  return Simulation(scene, prepare(scene), threads, archive);
}

std::string refusal(const Scene& scene, const Entries& entries) {
  return file_error_of([&] { restored(scene, 1, entries); });
}

// Looks as a run does.
void advance(Simulation& simulation, std::int64_t until) {
  while (simulation.step() < until) {
    simulation.advance_to(std::min(until, simulation.step() / 37 * 37 + 37));
    if (simulation.step() % 37 == 0) simulation.note_events(simulation.look());
  }
}

void expect_same_summary(Summary a, Summary b) {
  EXPECT_EQ(a.energy.values(), b.energy.values());
  EXPECT_EQ(a.energy_initial, b.energy_initial);
  EXPECT_EQ(a.relative_residual, b.relative_residual);
  EXPECT_EQ(a.linear_momentum_drift, b.linear_momentum_drift);
  EXPECT_EQ(a.angular_momentum_drift, b.angular_momentum_drift);
  EXPECT_EQ(a.max_penetration, b.max_penetration);
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    EXPECT_EQ(a.events[i].time, b.events[i].time);
    EXPECT_EQ(a.events[i].kind, b.events[i].kind);
    EXPECT_EQ(a.events[i].name, b.events[i].name);
  }
  for (std::size_t r = 0; r < a.ring_records.size(); ++r) {
    EXPECT_EQ(a.ring_records[r].first_contact_time, b.ring_records[r].first_contact_time);
    EXPECT_EQ(a.ring_records[r].peak_force, b.ring_records[r].peak_force);
    EXPECT_EQ(a.ring_records[r].peak_time, b.ring_records[r].peak_time);
  }
}

// Stopped at several steps on the way, by turns with one, two and three threads.
void expect_goes_on(const Scene& scene, std::int64_t steps, const std::vector<std::int64_t>& stops) {
  Simulation whole(scene, 1);
  advance(whole, steps);
  const Outcome expected = outcome_of(whole);
  const Summary summary = whole.summary();
  Simulation begin(scene, 2);
  advance(begin, stops.front());
  Entries entries = saved(begin);
  for (std::size_t k = 1; k <= stops.size(); ++k) {
    const int threads = static_cast<int>(k % 3) + 1;
    SCOPED_TRACE(std::to_string(threads) + " threads from step " + std::to_string(stops[k - 1]));
    Simulation next = restored(scene, threads, entries);
    ASSERT_EQ(next.step(), stops[k - 1]);
    const std::int64_t until = k < stops.size() ? stops[k] : steps;
    advance(next, until);
    entries = saved(next);
    if (k < stops.size()) continue;
    expect_same(outcome_of(next), expected);
    expect_same_summary(next.summary(), summary);
  }
}

void expect_goes_on(const Case& one, const std::vector<std::int64_t>& stops) {
  expect_goes_on(read(one), one.steps, stops);
}

TEST(Restart, RingPull) { expect_goes_on(ring_pull(), {0, 1, 100, 201, 399}); }
TEST(Restart, EdgeClosure) { expect_goes_on(edge_closure(), {3, 500, 777, 1111}); }
TEST(Restart, CaptureBeforeAtAndAfterItCloses) {
  expect_goes_on(capture(), {50, 99, 100, 101, 333, 700, 999});
}
TEST(Restart, SmallLargeCapture) { expect_goes_on(small_large_capture(), {150, 201, 555}); }
TEST(Restart, SlidingRingPull) {
  Case one = sliding_ring_pull();
  one.steps = 7000;
  expect_goes_on(one, {1, 1501, 3777, 5001});
}
TEST(Restart, SlidingCapture) { expect_goes_on(sliding_capture(), {20, 26, 1111, 5003}); }
TEST(Restart, HeldCapture) { expect_goes_on(held_capture(), {20, 25, 26, 27, 1111, 5003}); }

TEST(Restart, CaptureInTwoSteps) { expect_goes_on(capture_in_two_steps(), {20, 24, 25, 26, 1111, 5003}); }

// A mass with a radius hits the target 0.1 ms after the start; its thread touches nothing.
Scene thrown_sphere() {
  return scene_of(R"(schema = 1
[time]
end_s = 1
step_s = 1e-6
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.002
elements = 10
points_m = [[0, 0, 0.1201], [0.3, 0, 0.1201]]
start = { mass_kg = 0.05, radius_m = 0.02, velocity_m_s = [0, 0, -1] }
[target.ball]
center_m = [0, 0, 0]
radius_m = 0.1
youngs_modulus_Pa = 1e7
)");
}
TEST(Restart, AMassThatTouches) { expect_goes_on(thrown_sphere(), 600, {50, 150, 333}); }

// Each step is a stop: whatever a step leaves behind is saved.
TEST(Restart, AfterEachStep) {
  Case one = capture();
  one.steps = 160;
  const Scene scene = read(one);
  Simulation whole(scene, 1);
  advance(whole, one.steps);
  Simulation begin(scene, 1);
  advance(begin, 90);
  Entries entries = saved(begin);
  for (std::int64_t step = 91; step <= one.steps; ++step) {
    Simulation next = restored(scene, 1, entries);
    advance(next, step);
    entries = saved(next);
  }
  Simulation last = restored(scene, 1, entries);
  expect_same(outcome_of(last), outcome_of(whole));
  expect_same_summary(last.summary(), whole.summary());
}

TEST(Restart, WhatIsSavedComesBack) {
  const Case one = capture();
  const Scene scene = read(one);
  Simulation simulation(scene, 1);
  advance(simulation, 400);
  const Entries entries = saved(simulation);
  Simulation again = restored(scene, 2, entries);
  EXPECT_EQ(saved(again), entries);
}

// A thread laid 0.1 mm deep into a target: what is told of that, and what faults of the first looks are put
// down to, does not end with a stop.
TEST(Restart, KnowsTheOverlapAtTheStart) {
  const Scene scene = scene_of(R"(schema = 1
[time]
end_s = 0.02
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.t]
material = "m"
diameter_m = 0.002
elements = 10
points_m = [[-0.5, 0, 0], [0.5, 0, 0]]
start = { mass_kg = 0.01 }
end = { mass_kg = 0.01 }
[target.b]
center_m = [0, 0, -0.1009]
radius_m = 0.1
youngs_modulus_Pa = 1e6
)");
  Simulation simulation(scene, 1);
  advance(simulation, 74);
  ASSERT_NE(simulation.overlap_warning(), "");
  Entries entries = saved(simulation);
  EXPECT_EQ(restored(scene, 1, entries).overlap_warning(), simulation.overlap_warning());
  Simulation next = restored(scene, 1, entries);
  EXPECT_EQ(saved(next), entries);
  std::get<std::vector<std::int64_t>>(entries.at("overlap/with"))[0] = 1;
  EXPECT_EQ(refusal(scene, entries), "error: memory: overlap/with holds 1; allowed: 0 to 0");
  std::erase_if(entries, [](const auto& entry) { return entry.first.starts_with("overlap/"); });
  EXPECT_EQ(restored(scene, 1, entries).overlap_warning(), "") << "as earlier versions saved it";
}

// The mouth counts as closed below a share of the greatest area that it ever had.
TEST(Restart, KnowsTheGreatestMouthSoFar) {
  const Scene scene = read(capture());
  Simulation simulation(scene, 1);
  advance(simulation, 300);
  Entries entries = saved(simulation);
  const auto closed = [](Simulation& next) {
    next.advance_to(next.step() + 1);
    next.note_events(next.look());
    for (const Event& event : next.summary().events)
      if (event.kind == "mouth_closed") return true;
    return false;
  };
  Simulation same = restored(scene, 1, entries);
  EXPECT_FALSE(closed(same));
  std::get<std::vector<double>>(entries.at("watch/greatest_mouth"))[0] *= 100;
  Simulation larger = restored(scene, 1, entries);
  EXPECT_TRUE(closed(larger));
}

// ----------------------------------------------------------------------------------------------------
// What is refused

TEST(Restart, RefusesWhatBelongsToAnotherCase) {
  Simulation simulation(read(capture()), 1);
  advance(simulation, 300);
  const Entries entries = saved(simulation);
  EXPECT_NE(refusal(read(edge_closure()), entries).find("memory: "), std::string::npos);
  Scene other_step = read(capture());
  other_step.time.step = 0.9e-6;
  EXPECT_NE(refusal(other_step, entries).find(" time_step is not the one"), std::string::npos);
  Scene other_closing_step = read(capture());
  other_closing_step.closing.step = 0.9e-6;
  EXPECT_NE(refusal(other_closing_step, entries).find("closing_time_step is not the one"), std::string::npos);
}

template <class Value>
std::vector<Value>& list(Entries& entries, const std::string& name) {
  return std::get<std::vector<Value>>(entries.at(name));
}

TEST(Restart, RefusalsNameTheFieldAndWhatIsAllowed) {
  const Scene scene = read(capture());
  Simulation simulation(scene, 1);
  advance(simulation, 300);
  const Entries entries = saved(simulation);
  const auto refused = [&](auto&& spoil) {
    Entries spoilt = entries;
    spoil(spoilt);
    return refusal(scene, spoilt);
  };
  EXPECT_EQ(refused([](Entries& e) { e.erase("ledger/work"); }), "error: memory: ledger/work is missing");
  EXPECT_EQ(refused([](Entries& e) { list<double>(e, "state/vx")[3] = std::nan(""); }),
            "error: memory: state/vx holds what is no finite number");
  EXPECT_EQ(refused([](Entries& e) { list<std::int64_t>(e, "rings/state")[0] = 3; }),
            "error: memory: rings/state holds 3; allowed: 0 to 2");
  EXPECT_EQ(refused([](Entries& e) { list<std::int64_t>(e, "phase")[0] = 0; }),
            "error: memory: state/x has another length");
  EXPECT_EQ(refused([](Entries& e) {
              list<std::int64_t>(e, "state/step")[0] = std::numeric_limits<std::int64_t>::max();
            }),
            "error: memory: state/step holds 9223372036854775807; allowed: 0 to 1000000000000000");
  EXPECT_EQ(refused([](Entries& e) { list<std::int64_t>(e, "state/step")[0] = 7; }),
            "error: memory: phase is not the one at that time");
  EXPECT_NE(refused([](Entries& e) { list<std::int64_t>(e, "contacts/element").pop_back(); }), "");
  EXPECT_NE(refused([](Entries& e) { list<std::int64_t>(e, "contacts/element")[0] = 0; }), "");
  EXPECT_NE(refused([](Entries& e) { list<std::string>(e, "events/name").pop_back(); }), "");
  EXPECT_EQ(refused([](Entries& e) {
              list<std::int64_t>(e, "contacts/element").pop_back();
              --list<std::int64_t>(e, "contacts/target_begin").back();
            }),
            "error: memory: targets does not fit the pairs of contacts");
}

TEST(Restart, RefusesContactsOfAMassThatHasNone) {
  const Scene scene = thrown_sphere();
  Simulation simulation(scene, 1);
  advance(simulation, 150);
  Entries entries = saved(simulation);
  auto& touching = list<std::int64_t>(entries, "contacts/element");
  ASSERT_EQ(std::count_if(touching.begin(), touching.end(), [](std::int64_t label) { return label < 0; }), 1);
  for (std::int64_t& label : touching)
    if (label < 0) label = kernel::sphere_label(3);
  EXPECT_EQ(refusal(scene, entries), "error: memory: contacts/element names a mass that has no such contact");
}

TEST(Restart, RefusesRingsOutOfTheirOrderAlongTheThread) {
  const Scene scene = read(sliding_capture());
  Simulation simulation(scene, 1);
  advance(simulation, 100);
  Entries entries = saved(simulation);
  std::vector<std::int64_t>& elements = list<std::int64_t>(entries, "joints/element");
  ASSERT_GT(elements.size(), 2u);
  ASSERT_LT(elements[0], 2);
  elements[0] = 2;  // three elements: an allowed number, but not before the ring that follows
  ASSERT_LT(elements[1], 2);
  EXPECT_EQ(refusal(scene, entries),
            "error: memory: joints/element is not in the order of the rings along their thread");
}

TEST(Restart, RefusesForcesOnNodesThatTheyDoNotActOn) {
  const Scene scene = read(held_capture());
  Simulation simulation(scene, 1);
  advance(simulation, 100);  // closed
  while (simulation.step() < 8000 && simulation.state().held.count[0].hosts == 0)
    advance(simulation, simulation.step() + 100);
  ASSERT_GT(simulation.state().held.count[0].hosts, 0) << "no force holds";
  Entries entries = saved(simulation);
  EXPECT_EQ(refusal(scene, entries), "");
  const Index first = kernel::joint_thread_loads * simulation.model().sliding_threads[0].joint_end;
  list<std::int64_t>(entries, "joints/held_node")[at(first)] =
      simulation.preparation().assembly.node_of("net.main.knot.5.5");
  EXPECT_EQ(refusal(scene, entries), "error: memory: joints/held_node names a node that has no such force");
}

// Numbers as a damaged or hostile file might hold them: each is refused, or the simulation that they give can
// be stepped and looked at (it may stop with an error, but does not crash).
template <class Random>
void spoil(Entry& entry, Random& random) {
  constexpr double strange[] = {0,
                                -1,
                                1e300,
                                -1e300,
                                1e-310,
                                7,
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()};
  constexpr std::int64_t whole[] = {0,
                                    -1,
                                    1,
                                    2,
                                    5,
                                    1000,
                                    std::numeric_limits<int>::max(),
                                    std::numeric_limits<int>::min(),
                                    std::numeric_limits<std::int64_t>::max(),
                                    std::numeric_limits<std::int64_t>::min()};
  const auto pick = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  std::visit(
      [&](auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        const std::size_t way = pick(8);
        if (values.empty() || way == 0) values.push_back(Value{});
        else if (way == 1) values.pop_back();
        else if constexpr (std::is_same_v<Value, double>) values[pick(values.size())] = strange[pick(8)];
        else if constexpr (std::is_same_v<Value, std::int64_t>) values[pick(values.size())] = whole[pick(10)];
        else values[pick(values.size())] = std::string(1000, 'x');
      },
      entry);
}

void expect_survives(const Case& one, std::int64_t step, int rounds) {
  const Scene scene = read(one);
  Simulation simulation(scene, 1);
  advance(simulation, step);
  const Entries entries = saved(simulation);
  std::mt19937 random(20261126);
  int refused = 0, stopped = 0;
  for (int round = 0; round < rounds; ++round) {
    Entries spoilt = entries;
    auto victim = spoilt.begin();
    std::advance(victim, std::uniform_int_distribution<std::size_t>(0, spoilt.size() - 1)(random));
    spoil(victim->second, random);
    SCOPED_TRACE("spoilt: " + victim->first);
    try {
      Simulation next = restored(scene, round % 2 + 1, spoilt);
      next.advance_to(next.step() + 3);
      next.frame();
      next.summary();
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("error: memory: "), std::string::npos) << error.what();
      ++refused;
    } catch (const NumericalError&) {
      ++stopped;
    }
  }
  EXPECT_GT(refused, rounds / 8);
  EXPECT_LT(refused + stopped, rounds);
}

TEST(Restart, StrangeNumbersDoNotCrash) {
  expect_survives(capture(), 300, 150);
  expect_survives(sliding_capture(), 300, 150);
  expect_survives(held_capture(), 301, 300);
  expect_survives(ring_pull(), 200, 150);
}

// What flies straight at a ball rounds off in each step: the ball is placed so that this alone makes it
// touch, and who has just woken up must not see that earlier.
TEST(Restart, JustBeforeABallIsTouched) {
  const auto scene = [](double speed, double center) {
    Scene s = thread_scene(1e9, 0.1, R"(
elements = 10
length_m = 1.2
points_m = [[-0.45, 0, 1000], [0.55, 0, 1000]]
[target.b]
center_m = [0, 0, 0]
radius_m = 0.1
youngs_modulus_Pa = 2.3e9
)");
    s.time.step = 2e-6;
    s.contact.margin = 5;
    s.threads.front().velocity.z() = speed;
    s.targets.front().center.z() = center;
    return s;
  };
  int tried = 0;
  for (int k = 0; k < 20; ++k) {
    const double speed = 4 + 0.137 * k;
    const std::int64_t touching = std::llround(0.15 / (speed * 2e-6));
    Simulation apart(scene(speed, 1010), 1);
    apart.advance_to(touching);
    const double drift = apart.state().z[5] - (1000 + static_cast<double>(touching) * 2e-6 * speed);
    if (drift < 0) continue;
    const Scene one = scene(speed, apart.state().z[5] + 0.101 - 0.3 * drift);
    Simulation whole(one, 1), begun(one, 1);
    whole.advance_to(touching + 30);
    begun.advance_to(touching - 1);
    Simulation next = restored(one, 1, saved(begun));
    next.advance_to(touching + 30);
    EXPECT_EQ(state_hash(next.state()), state_hash(whole.state())) << speed;
    ++tried;
  }
  EXPECT_GT(tried, 3);
}

}  // namespace
