// The same bits for any number of threads, any instruction set, with frames taken on the way or not.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "input/case_reader.hpp"
#include "plan/simulation.hpp"
#include "store/fields.hpp"
#include "support/outcome.hpp"
#include "support/quick_cases.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

Outcome run(const Case& one, int threads) {
  Simulation simulation(read(one), threads);
  simulation.advance_to(one.steps);
  EXPECT_EQ(simulation.threads(), threads);
  return outcome_of(simulation);
}

void expect_same_for_all_threads(const Case& one, const std::vector<int>& numbers, std::size_t rings,
                                 bool ball) {
  const Outcome serial = run(one, 1);
  EXPECT_TRUE(serial.closed);
  EXPECT_GE(serial.rings_touched, rings) << "the scene must reach contacts";
  EXPECT_EQ(serial.ball_touched, ball);
  for (int round = 0; round < 2; ++round)
    for (const int threads : numbers) {
      SCOPED_TRACE(std::to_string(threads) + " threads, round " + std::to_string(round));
      expect_same(run(one, threads), serial);
    }
}

TEST(Determinism, RingPull) { expect_same_for_all_threads(ring_pull(), {1, 2, 3, 4, 7}, 1, false); }
TEST(Determinism, EdgeClosure) { expect_same_for_all_threads(edge_closure(), {1, 2, 3, 4, 7}, 4, false); }
TEST(Determinism, Capture) { expect_same_for_all_threads(capture(), {1, 2, 3, 4, 7}, 8, true); }
TEST(Determinism, SmallLargeCapture) {
  expect_same_for_all_threads(small_large_capture(), {1, 2, 3, 4, 7}, 8, true);
}
TEST(Determinism, SlidingRingPull) { expect_same_for_all_threads(sliding_ring_pull(), {1, 2, 3}, 1, false); }
TEST(Determinism, SlidingCapture) {
  expect_same_for_all_threads(sliding_capture(), {1, 2, 4}, 8, true);
  const Simulation start(read(sliding_capture()), 1);
  const std::vector<Index>& element = start.preparation().whole().joint_element;
  EXPECT_NE(std::adjacent_find(element.begin(), element.end()), element.end());
}
TEST(Determinism, HeldCapture) { expect_same_for_all_threads(held_capture(), {2, 3}, 8, true); }
TEST(Determinism, CaptureInTwoSteps) { expect_same_for_all_threads(capture_in_two_steps(), {2, 3}, 8, true); }
TEST(Determinism, FullLargeCapture) { expect_same_for_all_threads(full_large_capture(), {2, 7}, 0, true); }

TEST(Determinism, ThreadsMayChangeAtAnyStep) {
  for (const Case& one : {ring_pull(), edge_closure(), capture(), small_large_capture(), sliding_ring_pull(),
                          sliding_capture(), held_capture()}) {
    SCOPED_TRACE(one.name);
    Simulation simulation(read(one), 2);
    std::int64_t step = 0;
    for (std::int64_t change = 0; step < one.steps; ++change) {
      simulation.use_threads(static_cast<int>(1 + change % 3));
      simulation.advance_to(step = std::min(step + 1 + 41 * change, one.steps));
      if (change % 2 == 0) simulation.look();  // before and after a change
    }
    expect_same(outcome_of(simulation), run(one, 1));
  }
}

// A hanging net too large for the cache, without contacts: several steps go through it in one sweep.
const char* const hanging_net = R"(schema = 1
[time]
end_s = 1
step_s = 1e-6
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
damping_ratio = 0.1
[net.main]
material = "m"
diameter_m = 0.002
size_m = [10, 10]
mesh_m = 0.1
elements_per_side = 2
stowed_factor = 1.001
[net.main.node]
top_left = { support = "fixed" }
"knot.50.50" = { support = "fixed" }
top_right = { support = "guided", axis = [1, 0, 0] }
)";

TEST(Determinism, SweepsOfALargeNet) {
  Simulation step_by_step(parse_case(hanging_net, "net.toml"), 1);
  for (int step = 0; step < 100; ++step) step_by_step.stepper().advance(step_by_step.state(), 1);
  const Outcome expected = outcome_of(step_by_step);
  for (const int threads : {1, 2, 3, 7}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    Simulation simulation(parse_case(hanging_net, "net.toml"), threads);
    simulation.advance_to(33);  // no multiple of the steps of a sweep
    simulation.advance_to(100);
    expect_same(outcome_of(simulation), expected);
  }
}

// ----------------------------------------------------------------------------------------------------
// Looking changes nothing

TEST(Determinism, FramesOnTheWayChangeNothing) {
  for (const Case& one : {ring_pull(), edge_closure(), capture(), small_large_capture(), sliding_ring_pull(),
                          sliding_capture(), held_capture()}) {
    SCOPED_TRACE(one.name);
    Simulation looked_at(read(one), 1);
    for (std::int64_t step = 0; step < one.steps; step = std::min(step + 37, one.steps)) {
      looked_at.advance_to(step);
      const State before = looked_at.state();
      const Look& now = looked_at.look();
      looked_at.note_events(now);
      looked_at.probe_row(now);
      looked_at.frame(now);
      looked_at.summary();
      ASSERT_TRUE(before.x == looked_at.state().x && before.vz == looked_at.state().vz &&
                  before.dissipated == looked_at.state().dissipated);
    }
    looked_at.advance_to(one.steps);
    expect_same(outcome_of(looked_at), run(one, 1));
  }
}

TEST(Determinism, StretchesOfAnyLengthGiveTheSame) {
  const Case one = capture();
  Simulation in_bits(read(one), 1);
  std::int64_t step = 0;
  for (std::int64_t stretch = 1; step < one.steps; stretch = stretch % 97 + 5)
    in_bits.advance_to(step = std::min(step + stretch, one.steps));
  expect_same(outcome_of(in_bits), run(one, 1));
}

// ----------------------------------------------------------------------------------------------------
// The hash

// FNV-1a, 64 bits: offset basis and prime of the published definition.
struct Fnv {
  std::uint64_t value = 14695981039346656037ULL;
  void byte(unsigned char b) { value = (value ^ b) * 1099511628211ULL; }
  void word(std::uint64_t w) {
    for (unsigned shift = 0; shift < 64; shift += 8) byte(static_cast<unsigned char>(w >> shift));
  }
};

std::uint64_t hash_of(const State& s) {
  Fnv hash;
  hash.word(static_cast<std::uint64_t>(s.step));
  for (const auto* field : {&s.x, &s.y, &s.z, &s.vx, &s.vy, &s.vz})
    for (const double value : *field) hash.word(std::bit_cast<std::uint64_t>(value));
  return hash.value;
}

TEST(StateHash, IsFnv1aOverStepAndNodeFields) {
  Fnv known;  // the published value of "a"
  known.byte('a');
  ASSERT_EQ(known.value, 0xaf63dc4c8601ec8cULL);
  Simulation simulation(read(capture()), 1);
  simulation.advance_to(150);
  EXPECT_EQ(state_hash(simulation.state()), hash_of(simulation.state()));
  EXPECT_EQ(simulation.summary().state_hash, hash_of(simulation.state()));
}

TEST(StateHash, SeesEveryBit) {
  Simulation simulation(read(ring_pull()), 1);
  State state = simulation.state();
  const std::uint64_t hash = state_hash(state);
  for (const auto field : {&State::x, &State::y, &State::z, &State::vx, &State::vy, &State::vz}) {
    State changed = state;
    double& last = (changed.*field).back();
    last = std::bit_cast<double>(std::bit_cast<std::uint64_t>(last) ^ 1);
    EXPECT_NE(state_hash(changed), hash);
  }
  state.step += 1;
  EXPECT_NE(state_hash(state), hash);
}

// ----------------------------------------------------------------------------------------------------
// Instruction sets, through the program

bool machine_has(const std::string& isa) {
#if defined(__x86_64__)
  if (isa == "v3") return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (isa == "v4")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
#endif
  return isa == "base";
}

bool build_has(const std::string& isa) {
  return std::string(" " CINCH_KERNEL_ISAS " ").find(" " + isa + " ") != std::string::npos;
}

class InstructionSets : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("cinch_isa_" + std::string(GetParam()) + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  nlohmann::json summary(const Case& one, const std::string& isa) const {
    const std::filesystem::path out =
        folder_ / (std::string(one.name) + "_" + std::to_string(one.steps) + "_" + isa);
    std::string command = "CINCH_ISA=" + isa + " '" + CINCH_PROGRAM + "' run '" + case_file(one) +
                          "' --quiet --out '" + out.string() + "' --threads 1";
    for (const Override& set : one.sets) command += " --set '" + set.key + "=" + set.value + "'";
    command += " --set time.end_s=" + std::to_string(prepare(read(one)).timeline.time_of(one.steps));
    EXPECT_EQ(std::system((command + " > '" + (folder_ / "log").string() + "' 2>&1").c_str()), 0) << command;
    std::ifstream file(out / "summary.json");
    return nlohmann::json::parse(file);
  }

  // A set that the build lacks is refused as a wrong command line is, not replaced by another.
  static void expect_refused(const std::string& isa) {
    const std::string command = "CINCH_ISA=" + isa + " '" + CINCH_PROGRAM + "' check '" +
                                case_file(ring_pull()) + "' >/dev/null 2>&1";
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 2) << command;
  }

 private:
  std::filesystem::path folder_;
};

TEST_P(InstructionSets, GiveTheSameHash) {
  const std::string isa = GetParam();
  if (!machine_has(isa)) GTEST_SKIP() << "this machine has no x86-64-" << isa;
  if (!build_has(isa)) return expect_refused(isa);
  for (const Case& one : {ring_pull(), edge_closure(), capture(), small_large_capture(), sliding_ring_pull(),
                          sliding_capture(), held_capture()}) {
    SCOPED_TRACE(one.name);
    const nlohmann::json base = summary(one, "base"), other = summary(one, isa);
    EXPECT_EQ(base.at("isa"), "base");
    EXPECT_EQ(other.at("isa"), isa);
    EXPECT_EQ(base.at("state_hash"), other.at("state_hash"));
    EXPECT_EQ(base.at("energy"), other.at("energy"));
    EXPECT_EQ(base.at("rings"), other.at("rings"));
    EXPECT_EQ(base.at("max_penetration"), other.at("max_penetration"));
  }
}

INSTANTIATE_TEST_SUITE_P(X86, InstructionSets, testing::Values("v3", "v4"),
                         [](const auto& isa) { return std::string(isa.param); });

}  // namespace
