// The program itself, driven as a user drives it: exit codes, files, messages, signals.
#include <sched.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "output/result_reader.hpp"
#include "support/pendulum.hpp"
#include "support/program.hpp"
#include "support/shadowed.hpp"

namespace {

using namespace cinch::test;

// What is started meanwhile may use one processor.
class OneProcessor {
 public:
  OneProcessor() {
    CPU_ZERO(&before_);
    EXPECT_EQ(sched_getaffinity(0, sizeof before_, &before_), 0);
    int first = 0;
    while (!CPU_ISSET(first, &before_)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    EXPECT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  }
  ~OneProcessor() { sched_setaffinity(0, sizeof before_, &before_); }
  OneProcessor(const OneProcessor&) = delete;

 private:
  cpu_set_t before_;
};

// ----------------------------------------------------------------------------------------------------
// A run that ends well

TEST_F(Program, RunWritesItsThreeFiles) {
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "r"}), 0) << err();
  EXPECT_TRUE(fs::exists(path("r/run.vtkhdf")));
  EXPECT_TRUE(fs::exists(path("r/run.xdmf")));
  const cinch::Result result(path("r"));
  EXPECT_EQ(result.frames(), 11);
  EXPECT_EQ(result.probe_times().size(), 21u);
  EXPECT_EQ(result.frame_steps().front(), 0);
  EXPECT_EQ(result.frame_steps().back(), 1000);
  EXPECT_EQ(result.frame_steps()[3], 300);
  EXPECT_TRUE(has(out(), "results: r")) << out();
  EXPECT_EQ(text_of(path("r/run.xdmf")).substr(0, 5), "<?xml");
}

TEST_F(Program, SummaryHoldsEveryField) {
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "r", "--quiet", "--threads", "1"}), 0) << err();
  const Json s = summary("r");
  for (const char* name : {"status",
                           "case",
                           "version",
                           "threads",
                           "steps",
                           "time_step",
                           "closing_time_step",
                           "simulated_seconds",
                           "wall_seconds",
                           "minutes_per_simulated_second",
                           "nodes",
                           "elements",
                           "rings",
                           "stable_step",
                           "stable_step_limited_by",
                           "state_hash",
                           "energy",
                           "momentum",
                           "max_penetration",
                           "stages",
                           "events"})
    EXPECT_TRUE(s.contains(name)) << name;
  EXPECT_EQ(s.at("status"), "done");
  EXPECT_EQ(s.at("case"), "tiny");
  EXPECT_EQ(s.at("threads"), 1);
  EXPECT_EQ(s.at("steps"), 1000);
  EXPECT_EQ(s.at("time_step"), 1e-6);
  EXPECT_NEAR(s.at("simulated_seconds"), 1e-3, 1e-15);
  EXPECT_GT(s.at("wall_seconds"), 0);
  EXPECT_NEAR(s.at("minutes_per_simulated_second").get<double>(),
              s.at("wall_seconds").get<double>() / 60 / 1e-3, 1e-6);
  EXPECT_EQ(s.at("nodes"), 102);
  EXPECT_EQ(s.at("elements"), 100);
  EXPECT_GT(s.at("stable_step"), 3e-6);
  EXPECT_TRUE(has(s.at("stable_step_limited_by"), "thread.main"));
  EXPECT_TRUE(has(s.at("state_hash"), "0x"));
  for (const char* name :
       {"kinetic", "elastic", "contact", "gravity", "dissipated_damper", "dissipated_contact",
        "work_separation", "booked_activation", "booked_couple", "residual", "relative_residual"})
    EXPECT_TRUE(s.at("energy").at(name).is_number()) << name;
  EXPECT_LT(s.at("energy").at("relative_residual"), 1e-4);
  EXPECT_LT(s.at("momentum").at("linear_drift"), 1e-12);
  EXPECT_GT(s.at("max_penetration"), 0);
  ASSERT_FALSE(s.at("stages").empty());
  for (const Json& stage : s.at("stages"))
    EXPECT_TRUE(stage.at("name").is_string() && stage.at("seconds").is_number() &&
                stage.at("share").is_number());
  ASSERT_EQ(s.at("rings").size(), 1u);
  const Json& ring = s.at("rings").front();
  EXPECT_EQ(ring.at("name"), "r1");
  EXPECT_NEAR(ring.at("first_contact_time"), 1e-4, 3e-6);
  EXPECT_GT(ring.at("first_contact_force"), 0);
  EXPECT_GE(ring.at("peak_force"), ring.at("first_contact_force"));
  EXPECT_GE(ring.at("peak_time"), ring.at("first_contact_time"));
  ASSERT_EQ(s.at("events").size(), 1u);
  EXPECT_EQ(s.at("events").front().at("kind"), "ring_contact");
  EXPECT_EQ(s.at("events").front().at("time"), ring.at("first_contact_time"));
}

TEST_F(Program, ProgressIsPlainWithoutATerminal) {
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "r"}), 0);
  EXPECT_FALSE(has(err(), "\r") || has(err(), "\033") || has(out(), "\r") || has(out(), "\033"));
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "q", "--quiet"}), 0);
  EXPECT_EQ(err(), "");
  EXPECT_FALSE(has(out(), "residual")) << "no verdict: " << out();
}

// Lines come every 10 s without a terminal.
TEST_F(Program, LongRunsTellTheirProgressInLines) {
  const pid_t child = start(endless);
  for (int k = 0; k < 300 && err().empty(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child), 143);
  const std::string lines = err();
  EXPECT_TRUE(has(lines, "t = ") && has(lines, "steps/s") && has(lines, "left") && lines.ends_with("\n"))
      << lines;
  EXPECT_FALSE(has(lines, "\r") || has(lines, "\033"));
}

TEST_F(Program, WithoutOutTheNextFreeFolderIsTaken) {
  ASSERT_EQ(run({"run", "tiny.toml", "--quiet"}), 0);
  ASSERT_EQ(run({"run", "tiny.toml", "--quiet"}), 0);
  EXPECT_TRUE(fs::exists(path("results/tiny/summary.json")));
  EXPECT_TRUE(fs::exists(path("results/tiny-2/summary.json")));
}

TEST_F(Program, CompareTellsEqualFromDifferent) {
  write("tiny.toml", with("end_s = 0.001", "end_s = 0.0003"));
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "a", "--quiet"}), 0);
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "b", "--quiet", "--threads", "2"}), 0);
  ASSERT_EQ(
      run({"run", "tiny.toml", "--out", "c", "--quiet", "--set", "thread.main.start.mass_kg=0.1000001"}), 0);
  EXPECT_EQ(summary("b").at("threads"), 2);
  EXPECT_EQ(run({"compare", "a", "a"}), 0);
  EXPECT_EQ(run({"compare", "a", "b"}), 0) << out();
  EXPECT_TRUE(has(out(), "identical")) << out();
  EXPECT_EQ(run({"compare", "a", "c"}), 5);
  EXPECT_FALSE(has(out(), "identical")) << out();
  EXPECT_EQ(run({"compare", "a", "nowhere"}), 4);
}

TEST_F(Program, CheckSaysWhatACaseWouldDo) {
  ASSERT_EQ(run({"check", "tiny.toml"}), 0) << err();
  const std::string text = out();
  EXPECT_TRUE(has(text, "102 nodes, 100 elements, 1 rings")) << text;
  EXPECT_TRUE(has(text, "stable step") && has(text, "thread.main"));
  EXPECT_TRUE(has(text, "1000 steps"));
  for (const char* stage : {"target contact", "gravity"}) {
    const auto at = text.find(stage);
    ASSERT_NE(at, std::string::npos) << stage;
    const std::string line = text.substr(text.rfind('\n', at) + 1, at - text.rfind('\n', at) - 1);
    EXPECT_TRUE(has(line, "left out")) << line << stage;
  }
  const auto rings = text.find("ring contact");
  ASSERT_NE(rings, std::string::npos);
  EXPECT_TRUE(has(text.substr(text.rfind('\n', rings), 12), "runs"));
  EXPECT_TRUE(has(text, "MB while stepping")) << text;
  EXPECT_TRUE(has(text, "expected time    about")) << text;
  EXPECT_TRUE(has(text, "the case is valid"));
  EXPECT_FALSE(fs::exists(path("results"))) << "a check writes nothing";
  ASSERT_EQ(run({"check", "tiny.toml", "--resolved"}), 0);
  EXPECT_TRUE(has(out(), "alpha_ring_s_m"));
}

// A light mass on a slack rope, whirled for as long as it takes to forget how it began.
TEST_F(Program, CheckTellsWhatIsByChance) {
  write("whirled.toml", R"(schema = 1
[time]
end_s = 8
[output]
frame_interval_s = 0.1
[gravity]
acceleration_m_s2 = [0, 0, -9.81]
[material.m]
youngs_modulus_Pa = 1e6
density_kg_m3 = 970
damping_ratio = 0.06
[thread.main]
material = "m"
diameter_m = 0.01
elements = 4
points_m = [[0, 0, 0], [0.3, 0, 0.4]]
start = { support = "fixed" }
end = { mass_kg = 0.02, velocity_m_s = [0, 1, 3] }
[probe.end]
quantity = "position"
of = "thread.main.end"
)");
  ASSERT_EQ(run({"check", "whirled.toml", "--error"}), 0) << err();
  EXPECT_TRUE(has(out(), "  by chance\n") && has(out(), "--runs N compares means")) << out();
}

TEST_F(Program, CheckTellsTheErrorWhereAsked) {
  ASSERT_EQ(run({"check", "tiny.toml", "--error"}), 0) << err();
  const std::string text = out();
  EXPECT_FALSE(has(err(), "error:")) << err();
  EXPECT_TRUE(has(err(), "running 4 of 4: ")) << err();
  const std::string row = text.substr(text.find("\n  force ") + 1);
  EXPECT_TRUE(has(row.substr(0, row.find('\n')), "peak")) << text;
  EXPECT_TRUE(has(row.substr(0, row.find('\n')), " N ")) << text;
  EXPECT_TRUE(has(text, "\n  all nodes ")) << text;
  EXPECT_FALSE(has(text, "nan")) << text;
  ASSERT_EQ(run({"check", "tiny.toml"}), 0);
  EXPECT_FALSE(has(out(), "all nodes"));
  EXPECT_EQ(run({"check", "tiny.toml", "--runs", "3"}), 2);
  EXPECT_EQ(run({"check", "tiny.toml", "--error", "--runs", "0"}), 2);
  EXPECT_EQ(run({"check", "tiny.toml", "--error", "--set", "time.speed_limit_m_s=0.1"}), 3);
  EXPECT_TRUE(has(out(), "its trial stopped: at t = 1e-06 s node 0") && has(out(), "moves at")) << out();
}

const std::string swinging = pendulum_case("[time]\nend_s = 0.05\n" + falling, "1e9", R"([probe.start]
quantity = "position"
of = "thread.main.start"
)");

TEST_F(Program, AnEstimateWithAStoppedRunEndsWithThree) {
  write("pendulum.toml", swinging);
  EXPECT_EQ(run({"check", "pendulum.toml", "--error", "--set", "time.step_s=0.01"}), 3) << err();
  EXPECT_TRUE(has(out(), "\nstopped          half the step, twice the elements in threads: ")) << out();
  EXPECT_EQ(run({"check", "pendulum.toml", "--error"}), 0) << err();
  EXPECT_FALSE(has(out(), "stopped")) << out();
}

TEST_F(Program, AnEstimateSaysWhatDoesNotMove) {
  write("pendulum.toml", swinging);
  ASSERT_EQ(run({"check", "pendulum.toml", "--error"}), 0) << err();
  EXPECT_TRUE(has(out(), "\n  start                    greatest over time  does not move\n")) << out();
}

TEST_F(Program, AResolvedCaseRunsToTheSameBits) {
  ASSERT_EQ(run({"check", "tiny.toml", "--resolved"}), 0);
  write("resolved.toml", out());
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "a", "--quiet"}), 0);
  ASSERT_EQ(run({"run", "resolved.toml", "--out", "b", "--quiet"}), 0) << err();
  EXPECT_EQ(summary("a").at("state_hash"), summary("b").at("state_hash"));
}

// ----------------------------------------------------------------------------------------------------
// Mistakes: exit code 2, a message, nothing written

TEST_F(Program, AnUnknownKeyIsNamedWithItsPlace) {
  write("bad.toml", with("elements = 100", "elments = 100"));
  EXPECT_EQ(run({"run", "bad.toml", "--out", "r"}), 2);
  EXPECT_TRUE(has(err(), "bad.toml:16:1: error")) << err();
  EXPECT_TRUE(has(err(), "'elements'")) << "the nearest key: " << err();
  EXPECT_FALSE(fs::exists(path("r")));
  EXPECT_EQ(run({"check", "bad.toml"}), 2);
}

TEST_F(Program, AStepAboveTheBoundIsRefused) {
  EXPECT_EQ(run({"run", "tiny.toml", "--set", "time.step_s=1e-5", "--out", "r"}), 2);
  EXPECT_TRUE(has(err(), "element ") && has(err(), "thread.main") && has(err(), "largest step that works"))
      << err();
  EXPECT_FALSE(fs::exists(path("r")));
  // the step that the message offers works
  const std::string words = "largest step that works is ";
  const auto at = err().find(words);
  ASSERT_NE(at, std::string::npos);
  const double step = std::strtod(err().c_str() + at + words.size(), nullptr);
  EXPECT_GT(step, 1e-6);
  EXPECT_EQ(run({"check", "tiny.toml", "--set", "time.step_s=" + std::to_string(step * 1e6) + "e-6", "--set",
                 "ring.r1.center_m=[1, 0, 0]"}),
            0)
      << err();
}

TEST_F(Program, HostileCasesEndWithTwoAndWriteNothing) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {with("elements = 100", "elements = 1000000000000"), "bad.toml:16:12: error: thread.main.elements"},
      {with("[[0, -0.1, 0], [0, 0.4, 0]]", "[[0, 0, 0], [1e308, 0, 0]]"), "bad.toml:17:25: error: "},
      {with("end_s = 0.001", "end_s = 1e999"), "bad.toml:5:"},
      {with("start = {", "start = { on = \"thread.main.end\", "), "bad.toml:19:1: error: there is no node"},
      {with("diameter_m = 0.002", "diameter_m = 1e-200"), "bad.toml:13:9: error: elements of length"},
      {"schema = 1\nx = " + std::string(100000, '['), "bad.toml:2:"},
      {std::string("\x7f"
                   "ELF\0\0",
                   6),
       "bad.toml:1:5: error: the file contains a NUL byte"},
      {"", "bad.toml:1:1: error: missing key 'schema'"},
      {std::string(100000000, ' '), "bad.toml: error: the file is larger than"},
  };
  for (const auto& [text, message] : cases) {
    SCOPED_TRACE(message);
    write("bad.toml", text);
    EXPECT_EQ(run({"check", "bad.toml"}), 2);
    EXPECT_TRUE(has(err(), message)) << err();
    EXPECT_EQ(run({"run", "bad.toml", "--out", "r"}), 2);
    EXPECT_TRUE(has(err(), message)) << err();
  }
  EXPECT_EQ(run({"run", ".", "--out", "r"}), 2);
  EXPECT_TRUE(has(err(), "is a directory")) << err();
  EXPECT_FALSE(fs::exists(path("r")));
}

// More steps than can be counted lie between two frames; the run is over long before.
TEST_F(Program, AFrameIntervalFarBeyondTheEnd) {
  const pid_t child = start({"run", "tiny.toml", "--set", "time.end_s=1e-11", "--set", "time.step_s=1e-14",
                             "--set", "output.frame_interval_s=1e6", "--out", "r", "--quiet"});
  for (int k = 0; k < 200 && !fs::exists(path("r/summary.json")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill(child, SIGKILL);  // too late where all is well
  wait_for(child);
  ASSERT_TRUE(fs::exists(path("r/summary.json"))) << "not done within 10 s";
  EXPECT_EQ(summary("r").at("steps"), 1000);
  EXPECT_EQ(cinch::Result(path("r")).frames(), 2);
}

TEST_F(Program, UsageErrors) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"simulate", "tiny.toml"}), 2);
  EXPECT_EQ(run({"rum", "tiny.toml"}), 2);
  EXPECT_TRUE(has(err(), "'run'")) << "the nearest command: " << err();
  EXPECT_EQ(run({"run"}), 2);
  EXPECT_EQ(run({"run", "tiny.toml", "--frobnicate"}), 2);
  EXPECT_EQ(run({"run", "tiny.toml", "--threads", "0"}), 2);
  EXPECT_EQ(run({"run", "tiny.toml", "--set", "nonsense", "--out", "r"}), 2);
  EXPECT_EQ(run({"run", "tiny.toml", "--set", "thread.other.elements=3", "--out", "r"}), 2);
  EXPECT_EQ(run({"run", "missing.toml", "--out", "r"}), 2);
  EXPECT_TRUE(has(err(), "missing.toml")) << err();
  EXPECT_FALSE(fs::exists(path("r")));
}

// They would wait for each other; how many a machine has does not matter here.
TEST_F(Program, MoreThreadsThanProcessorsAreWarnedOf) {
  const OneProcessor one;
  const Words words{"tiny.toml", "--set", "time.end_s=1e-5"};
  const auto with_words = [&](Words command, const Words& more) {
    command.insert(command.end(), words.begin(), words.end());
    command.insert(command.end(), more.begin(), more.end());
    return command;
  };
  const std::string told =
      "warning: --threads 2: this process may use 1 processor; more threads than that wait for each other\n";
  EXPECT_EQ(run(with_words({"run"}, {"--quiet", "--threads", "2"})), 0);
  EXPECT_EQ(err(), told);
  EXPECT_EQ(run(with_words({"run"}, {"--quiet", "--overwrite"}), "export CINCH_THREADS=2; "), 0);
  EXPECT_EQ(err(), told);
  EXPECT_EQ(run(with_words({"check"}, {"--threads", "2"})), 0);
  EXPECT_EQ(err(), told);
  for (const char* threads : {"--threads=1", "--set=output.checkpoint=false"}) {
    EXPECT_EQ(run(with_words({"run"}, {"--quiet", "--overwrite", threads})), 0);
    EXPECT_EQ(err(), "") << threads;
  }
}

TEST_F(Program, AnUnknownInstructionSetIsRefused) {
  for (const char* threads : {"1", "2"}) {
    EXPECT_EQ(run({"run", "tiny.toml", "--out", "r", "--threads", threads}, "export CINCH_ISA=v9; "), 2);
    EXPECT_TRUE(has(err(), "CINCH_ISA=v9") && has(err(), "base")) << err();
  }
}

TEST_F(Program, HelpAndVersion) {
  EXPECT_EQ(run({"--help"}), 0);
  for (const char* command : {"run", "check", "info", "report", "compare"}) EXPECT_TRUE(has(out(), command));
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_TRUE(has(out(), "cinch"));
}

// ----------------------------------------------------------------------------------------------------
// Files: exit code 4

TEST_F(Program, AFolderThatCannotBeWritten) {
  write("file", "no folder");
  EXPECT_EQ(run({"run", "tiny.toml", "--out", "file/r"}), 4);
  EXPECT_TRUE(has(err(), "file/r")) << err();
  if (geteuid() == 0) return;  // nothing is closed to root
  fs::create_directory(path("closed"));
  chmod(path("closed").c_str(), 0555);
  EXPECT_EQ(run({"run", "tiny.toml", "--out", "closed/r"}), 4);
}

#ifndef CINCH_SHADOWED
TEST_F(Program, ASceneLargerThanTheMemory) {
  const std::string little = "ulimit -v 700000; ", less = "ulimit -v 100000; ";
  ASSERT_EQ(run({"--version"}, less), 0) << err();
  for (const Words& command : {Words{"check"}, Words{"run", "--out", "r"}}) {
    Words words = command;
    words.insert(words.end(), {"tiny.toml", "--set", "thread.main.elements=5000000", "--threads", "1"});
    EXPECT_EQ(run(words, little), 4);
    EXPECT_EQ(err(), "error: not enough memory for this scene (5000002 nodes, 5000000 elements)\n");
    EXPECT_FALSE(fs::exists(path("r")));
  }
  std::string points;  // the scene is not known yet
  for (int k = 0; k < 200000; ++k) points += "[0,0,0],";
  write("long.toml", with("[[0, -0.1, 0], [0, 0.4, 0]]", "[" + points + "[1,0,0]]"));
  EXPECT_EQ(run({"check", "long.toml"}, less), 4);
  EXPECT_EQ(err(), "error: not enough memory\n");
}
#endif

TEST_F(Program, AResultIsNotReplacedUnasked) {
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "r", "--quiet"}), 0);
  const std::string before = text_of(path("r/run.vtkhdf")) + text_of(path("r/summary.json"));
  EXPECT_EQ(run({"run", "tiny.toml", "--out", "r", "--set", "time.end_s=0.0005"}), 4);
  EXPECT_TRUE(has(err(), "--overwrite")) << err();
  EXPECT_TRUE(before == text_of(path("r/run.vtkhdf")) + text_of(path("r/summary.json"))) << "left untouched";
  EXPECT_EQ(run({"run", "tiny.toml", "--out", "r", "--set", "time.end_s=0.0005", "--overwrite", "--quiet"}),
            0);
  EXPECT_EQ(summary("r").at("steps"), 500);
}

TEST_F(Program, WhatStandsInTheWayIsNamed) {
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "r", "--quiet"}), 0);
  fs::remove(path("r/run.xdmf"));
  fs::create_directories(path("r/run.xdmf/full"));
  EXPECT_EQ(run({"run", "--restart", "r", "--set", "time.end_s=0.0011"}), 4);
  EXPECT_TRUE(has(err(), "run.xdmf: cannot replace it: ")) << err();
  EXPECT_EQ(run({"run", "tiny.toml", "--out", "r", "--overwrite"}), 4);
  EXPECT_TRUE(has(err(), "run.xdmf: cannot remove it: ")) << err();
}

TEST_F(Program, InfoAndReportOfNoResult) {
  EXPECT_EQ(run({"info", "nowhere"}), 4);
  write("run.vtkhdf", "this is no HDF5 file");
  EXPECT_EQ(run({"info", "run.vtkhdf"}), 4);
  EXPECT_EQ(run({"report", "nowhere"}), 4);
}

// ----------------------------------------------------------------------------------------------------
// Runs that do not end as planned: what was computed is kept

TEST_F(Program, ANumericalFailureKeepsItsFrames) {
  EXPECT_EQ(run({"run", "tiny.toml", "--set", "time.step_s=1.25e-5", "--set", "time.allow_unstable=true",
                 "--set", "time.end_s=1", "--out", "r"}),
            3);
  EXPECT_TRUE(has(err(), "error") && has(err(), "at t = ")) << err();
  const Json s = summary("r");
  EXPECT_EQ(s.at("status"), "failed");
  EXPECT_TRUE(has(s.at("message"), "likely cause")) << s.at("message");
  const cinch::Result result(path("r"));
  ASSERT_GE(result.frames(), 1);
  EXPECT_EQ(result.frame(0).step, 0);
  const cinch::Frame last = result.frame(result.frames() - 1);
  ASSERT_FALSE(s.at("history").empty());
  EXPECT_GT(s.at("history").back().at("speed").get<double>(), 1e5) << "the look that stopped it";
  EXPECT_TRUE(has(s.at("history").back().at("fastest_node"), "of thread.main"));
  EXPECT_EQ(last.step, s.at("steps")) << "it ends with the last sound state";
  for (const cinch::Vec3& v : last.velocity) ASSERT_LT(v.norm(), 1e5) << "kept frames are sound";
  for (const cinch::Vec3& x : last.position) ASSERT_TRUE(x.allFinite());
  EXPECT_EQ(run({"info", "r"}), 0);
}

class Stopped : public Program, public testing::WithParamInterface<int> {};

TEST_P(Stopped, KeepsItsFrames) {
  const int signal = GetParam();
  const pid_t child = start(endless);
  // stop it when it has begun to write frames
  for (int k = 0; k < 200 && !fs::exists(path("r/run.vtkhdf")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, signal);
  EXPECT_EQ(wait_for(child), signal == SIGINT ? 130 : 143);
  const Json s = summary("r");
  EXPECT_EQ(s.at("status"), signal == SIGINT ? "interrupted" : "terminated");
  EXPECT_LT(s.at("simulated_seconds"), 100);
  EXPECT_GT(s.at("simulated_seconds"), 0);
  const cinch::Result result(path("r"));
  ASSERT_GE(result.frames(), 2);
  EXPECT_EQ(result.frame(result.frames() - 1).step, s.at("steps")) << "the last frame is where it stopped";
  EXPECT_EQ(run({"info", "r"}), 0);
}

INSTANTIATE_TEST_SUITE_P(Signals, Stopped, testing::Values(SIGINT, SIGTERM),
                         [](const auto& signal) { return signal.param == SIGINT ? "SIGINT" : "SIGTERM"; });

TEST_F(Program, AKilledRunKeepsItsFrames) {
  const pid_t child = start(endless);
  for (int k = 0; k < 200 && !fs::exists(path("r/run.vtkhdf")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGKILL);
  EXPECT_EQ(wait_for(child), 1000 + SIGKILL);
  EXPECT_FALSE(fs::exists(path("r/summary.json")));
  const cinch::Result result(path("r"));
  EXPECT_GE(result.frames(), 2);
  EXPECT_EQ(run({"info", "r"}), 0);
}

}  // namespace
