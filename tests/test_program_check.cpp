// What `cinch check` and `cinch run` say of cases that are valid and go wrong, or mean something else.
#include <algorithm>

#include "support/program.hpp"

namespace {

using namespace cinch::test;

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  return text.substr(text.rfind('\n', end) + 1, end - text.rfind('\n', end));
}

// A small net whose edge a closing thread is laid along between two mechanisms, with rings on it.
const char* const closing_case = R"(schema = 1
[time]
end_s = 0.02
[closing]
time_s = 0.01
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [0.3, 0.3]
mesh_m = 0.1
[mechanism.m1]
corner = "net.main.top_left"
launcher_mass_kg = 0.05
split_mass_kg = 0.1
towing_material = "m"
towing_diameter_m = 0.002
towing_length_m = 0.1
launch_speed_m_s = 1
separation_a_m_s = [-1, -1, 0]
separation_b_m_s = [1, 1, 0]
[mechanism.m2]
corner = "net.main.top_right"
launcher_mass_kg = 0.05
split_mass_kg = 0.1
towing_material = "m"
towing_diameter_m = 0.002
towing_length_m = 0.1
launch_speed_m_s = 1
separation_a_m_s = [-1, 1, 0]
separation_b_m_s = [1, -1, 0]
[thread.c]
material = "m"
diameter_m = 0.002
along = ["mechanism.m1", "net.main.top", "mechanism.m2"]
start = { on = "mechanism.m1.b" }
end = { on = "mechanism.m2.a" }
[rings.r]
net = "main"
edges = ["top"]
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.006
youngs_modulus_Pa = 70e9
)";

class Doubtful : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("closing.toml", closing_case);
  }
};

// A thread too thick for the ring that it passes through by contact.
const Words thick{
    "tiny.toml", "--set",          "ring.r1.center_m=[0, 0, 0]", "--set", "thread.main.diameter_m=0.03",
    "--set",     "time.end_s=0.02"};

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Doubtful, ACaseWhoseTrialStopsIsNotFine) {
  EXPECT_EQ(run(Words{"check"} + thick), 3) << err();
  const std::string last = last_line(out());
  EXPECT_TRUE(last.starts_with("the case is valid, but its trial stopped: at t = 0 s element ")) << out();
  EXPECT_TRUE(has(last, "overlap at the start")) << last;
  EXPECT_TRUE(has(out(), "expected time    unknown")) << out();
  EXPECT_EQ(run(Words{"check", "--error"} + thick), 3);
  EXPECT_FALSE(has(out(), "all nodes")) << "no estimate of a case that does not run";
}

TEST_F(Doubtful, ARunNamesAnOverlapAtTheStart) {
  EXPECT_EQ(run(Words{"run", "--out", "r"} + thick), 3);
  for (const char* piece : {"error: at t = 0 s element ", " of thread.main ",
                            " m deep in ring 'r1'; likely cause: an overlap "
                            "at the start, ",
                            "; what it led to: at t = "})
    EXPECT_TRUE(has(err(), piece)) << piece << "\n" << err();
  EXPECT_FALSE(has(err(), "take half of it")) << err();
}

TEST_F(Doubtful, AnOverlapWithATargetIsNamed) {
  const std::string ball =
      "[target.ball]\ncenter_m = [0, 0, 0.1]\nradius_m = 0.15\nyoungs_modulus_Pa = 2.3e9\n";
  write("ball.toml", closing_case + ball);
  EXPECT_EQ(run({"check", "ball.toml"}), 3) << err();
  EXPECT_TRUE(has(last_line(out()), " m deep in target 'ball'; likely cause: an overlap at the start"))
      << out();
  EXPECT_EQ(run({"run", "ball.toml", "--out", "r"}), 3);
  EXPECT_TRUE(has(err(), " m deep in target 'ball'; likely cause: an overlap at the start")) << err();
}

TEST_F(Doubtful, AShallowOverlapIsNotBlamedForOtherFaults) {
  write("ball.toml",  // 0.01 mm into the net
        closing_case + std::string("[target.ball]\ncenter_m = [0, 0, 0.142467]\nradius_m = 0.15\n"
                                   "youngs_modulus_Pa = 2.3e9\n"));
  EXPECT_EQ(run({"run", "ball.toml", "--out", "r", "--set", "time.speed_limit_m_s=0.5"}), 3);
  EXPECT_TRUE(has(err(), "(time.speed_limit_m_s = 0.5)")) << err();
  EXPECT_FALSE(has(err(), "overlap")) << err();
}

TEST_F(Doubtful, AnOverlapOfClosingThreadsIsOneOfClosing) {
  const Words thick_thread{"closing.toml", "--set", "thread.c.diameter_m=0.03", "--set",
                           "case.method=contact"};
  EXPECT_EQ(run(Words{"check"} + thick_thread), 3);
  EXPECT_TRUE(has(last_line(out()), " of thread.c ") && has(last_line(out()), "an overlap at the start"))
      << out();
  EXPECT_EQ(run(Words{"run", "--out", "r"} + thick_thread), 3);
  EXPECT_TRUE(has(err(), "error: at t = 0.01 s element ")) << err();
  EXPECT_TRUE(has(err(), "likely cause: an overlap at the start of closing, ")) << err();
}

TEST_F(Doubtful, ASoundClosingCaseHasNoWarnings) {
  EXPECT_EQ(run({"check", "closing.toml"}), 0);
  EXPECT_EQ(err(), "");
  EXPECT_TRUE(has(out(), "joints           sliding: r1, r2, r3\n")) << out();
  EXPECT_EQ(last_line(out()), "the case is valid");
  EXPECT_EQ(run({"run", "closing.toml", "--out", "r", "--quiet"}), 0);
  EXPECT_EQ(err(), "");
}

TEST_F(Doubtful, AClosingTimeBehindTheEndIsToldOf) {
  for (const Words& words :
       {Words{"check", "closing.toml"}, Words{"run", "closing.toml", "--out", "r", "--quiet"}}) {
    EXPECT_EQ(run(words + Words{"--set", "time.end_s=0.005"}), 0) << err();
    EXPECT_TRUE(has(err(),
                    "closing.toml:5:10: warning: closing.time_s = 0.01 s comes after time.end_s = 0.005 s: "
                    "nothing closes\n"))
        << err();
  }
}

TEST_F(Doubtful, AClosingThreadFarTooShortIsToldOf) {
  EXPECT_EQ(run({"check", "closing.toml", "--set", "thread.c.length_m=0.48"}), 0) << err() << out();
  EXPECT_EQ(err(), "") << "4 %";
  run({"check", "closing.toml", "--set", "thread.c.length_m=0.4"});
  EXPECT_TRUE(
      has(err(),
          "closing.toml:34:9: warning: closing thread 'c' of length_m = 0.4 m is laid over 0.5 m (along "
          "mechanism.m1, net.main.top, mechanism.m2): it begins with 25 % of strain"))
      << err();
  run({"run", "closing.toml", "--set", "thread.c.length_m=0.4", "--out", "r", "--quiet"});
  EXPECT_TRUE(has(err(), "warning: closing thread 'c'")) << err();
}

TEST_F(Doubtful, GreatStrainAtTheStartIsToldOf) {
  for (const Words& words : {Words{"check", "closing.toml"},
                             Words{"run", "closing.toml", "--out", "r", "--quiet", "--overwrite"}}) {
    run(words + Words{"--set", "net.main.stowed_factor=1.2"});
    for (const char* part : {"closing.toml:9:6: warning: element 0 of net.main ",
                             "closing.toml:14:12: warning: element 0 of mechanism.m1 "})
      EXPECT_TRUE(has(err(), part)) << words[0] << ": " << err();
    EXPECT_TRUE(has(err(), " begins with 20 % of strain")) << err();
  }
}

TEST_F(Doubtful, StepsBeforeAndFromTheClosingTimeOnAreTold) {
  const std::vector<std::string> words{"check", std::string(CINCH_SOURCE_DIR) + "/cases/capture.toml",
                                       "--set", "case.method=sliding",
                                       "--set", "time.step_s=2e-6",
                                       "--set", "closing.safety=0.5"};
  ASSERT_EQ(run(words), 0) << err();
  EXPECT_TRUE(
      has(out(), "\nstep             2e-06 s (given, 0.23 of the stable step), 750000 steps to 1.5 s\n"))
      << out();
  EXPECT_TRUE(has(out(), " s (automatic, 0.5 of the stable step), ")) << out();
  std::vector<std::string> open = words;
  open.insert(open.end(), {"--set", "time.end_s=1"});
  ASSERT_EQ(run(open), 0) << err();
  EXPECT_TRUE(has(out(), " 500000 steps to 1 s\n")) << out();
  EXPECT_FALSE(has(out(), "(automatic")) << "what comes after the end has none: " << out();
}

TEST_F(Doubtful, AnAutomaticJointThatNoThreadPassesIsToldOf) {
  std::string text = with("joint = \"contact\"\n", "");
  text.replace(text.find("0.0069"), 6, "0.0200");
  write("auto.toml", text);
  EXPECT_EQ(run({"check", "auto.toml"}), 0) << err();
  EXPECT_TRUE(
      has(err(),
          "auto.toml:21:7: warning: no thread passes through ring 'r1': the nearest, thread.main, lies "
          "0.013 m outside of its opening; its joint = \"auto\" becomes contact"))
      << err();
  EXPECT_TRUE(has(out(), "joints           contact, as no thread passes through: r1\n")) << out();
  EXPECT_EQ(run({"run", "auto.toml", "--out", "r", "--quiet"}), 0);
  EXPECT_TRUE(has(err(), "warning: no thread passes through ring 'r1'")) << err();
  EXPECT_EQ(run({"check", "tiny.toml"}), 0);
  EXPECT_EQ(err(), "") << "it asks for contact";
  EXPECT_TRUE(has(out(), "joints           contact: r1\n")) << out();
}

TEST_F(Doubtful, AThreadTooThickForItsRingIsToldOf) {
  std::string text = with("joint = \"contact\"\n", "");
  text.replace(text.find("0.0069"), 6, "0.0000");  // the thread goes through it
  text.replace(text.find("diameter_m = 0.002"), 18, "diameter_m = 0.050");
  write("thick.toml", text);
  EXPECT_NE(run({"run", "thick.toml", "--out", "r", "--quiet"}), 0);
  const std::string told =
      "thick.toml:21:7: warning: thread.main (diameter 0.05 m) does not fit the opening (0.016 m) of ring "
      "'r1'; its joint = \"auto\" becomes contact";
  EXPECT_TRUE(err().starts_with(told)) << err();
  EXPECT_NE(run({"check", "thick.toml"}), 0);
  EXPECT_TRUE(has(err(), told)) << err();
  EXPECT_TRUE(has(out(), "joints           contact, as the thread is too thick: r1\n")) << out();
}

TEST_F(Doubtful, ABodyThatCanFallHasNoEquilibrium) {
  const std::string falls =
      with("end = { support = \"fixed\" }", "[gravity]\nacceleration_m_s2 = [0, 0, -9.81]") +
      "[start]\nequilibrium = true\n";
  write("falls.toml", falls);
  for (const Words& words : {Words{"run", "falls.toml", "--out", "r"}, Words{"check", "falls.toml"}}) {
    EXPECT_EQ(run(words), 2);
    EXPECT_TRUE(
        has(err(), "falls.toml:36:15: error: start.equilibrium: found true, but node 0 of thread.main at "))
        << err();
    EXPECT_TRUE(has(err(), "can fall: no fixed node")) << err();
  }
  EXPECT_FALSE(fs::exists(path("r")));
}

TEST_F(Program, FlagsTakeNoValue) {
  for (const char* flag : {"--error=0.01", "--error=0", "--error=yes", "--error=5", "--resolved=true"}) {
    EXPECT_EQ(run({"check", "tiny.toml", flag}), 2) << flag;
    const std::string word = flag, message = "error: " + word + ": " + word.substr(0, word.find('=')) +
                                             " takes no value\n";
    EXPECT_TRUE(err().starts_with(message)) << err();
    EXPECT_EQ(out(), "");
  }
  EXPECT_EQ(run({"run", "tiny.toml", "--quiet=no", "--out", "r"}), 2);
  EXPECT_TRUE(has(err(), "error: --quiet=no: --quiet takes no value")) << err();
}

TEST_F(Program, MistakesOnTheCommandLineAreOneErrorEach) {
  for (const Words& words :
       {Words{}, Words{"rum", "tiny.toml"}, Words{"run"}, Words{"run", "tiny.toml", "--frobnicate"},
        Words{"run", "tiny.toml", "--threads", "0"}, Words{"run", "tiny.toml", "--set", "nonsense"},
        Words{"run", "missing.toml"}, Words{"info", "nowhere"}, Words{"compare", "a", "b"},
        Words{"run", "--restart", "nowhere"}}) {
    EXPECT_NE(run(words), 0);
    const std::string text = err();
    const std::size_t first = text.find("error: ");
    EXPECT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find("error: ", first + 1), std::string::npos) << text;
  }
}

TEST_F(Program, AFullDiskBehindStandardOutputIsAnError) {
  ASSERT_EQ(run({"run", "tiny.toml", "--out", "r", "--quiet"}), 0);
  for (const Words& words : {Words{"info", "r"}, Words{"compare", "r", "r"}, Words{"check", "tiny.toml"},
                             Words{"--help"}, Words{"run", "tiny.toml", "--out", "q", "--quiet"}}) {
    EXPECT_EQ(run(words, "exec > /dev/full; "), 4) << words[0];
    const std::string text = err();
    EXPECT_TRUE(text.starts_with("error: standard output: cannot write")) << words[0] << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
  EXPECT_TRUE(fs::exists(path("q/summary.json"))) << "the result is whole";
}

TEST_F(Program, APipeThatNobodyReadsCostsNoRun) {
  const std::string pipe = path("pipe").string();
  const auto into_pipe = [&](const char* number) {
    fs::remove(pipe);
    return "mkfifo " + pipe + "; exec 3<>" + pipe + " " + number + ">" + pipe + " 3<&-; ";
  };
  const Words far{"run", "tiny.toml", "--set", "ring.r1.joint=auto", "--set", "ring.r1.center_m=[1, 0, 0]"};
  Words words = far;
  words.insert(words.end(), {"--out", "r"});
  ASSERT_EQ(run(words), 0);
  ASSERT_TRUE(has(err(), "warning: ")) << err();
  words.back() = "q";
  EXPECT_EQ(run(words, into_pipe("2")), 0);
  EXPECT_EQ(summary("q").at("state_hash"), summary("r").at("state_hash"));
  words.back() = "p";
  EXPECT_EQ(run(words, into_pipe("1")), 4);
  EXPECT_TRUE(has(err(), "error: standard output: cannot write")) << err();
  EXPECT_EQ(summary("p").at("status"), "done");
}

}  // namespace
