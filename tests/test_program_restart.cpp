// Runs that are stopped, killed or short of disk, and go on: driven as a user drives them.
#include <chrono>
#include <random>
#include <thread>

#include "output/compare.hpp"
#include "output/result_reader.hpp"
#include "support/program.hpp"

namespace {

using namespace cinch::test;

class Restarted : public Program {
 protected:
  // Until `end_s`, in one go or further.
  Words begin(const std::string& end_s, const std::string& out) const {
    return {"run", "tiny.toml", "--quiet", "--set", "time.end_s=" + end_s, "--out", out};
  }
  Words go_on(const std::string& end_s, const std::string& from) const {
    return {"run", "--quiet", "--restart", from, "--set", "time.end_s=" + end_s};
  }
  bool same(const std::string& a, const std::string& b) const {
    const cinch::Comparison found = cinch::compare_results(cinch::Result(path(a)), cinch::Result(path(b)));
    std::ostringstream text;
    cinch::print_comparison(found, text);
    EXPECT_TRUE(found.identical) << text.str();
    return found.identical;
  }
  std::string last_energies(const std::string& name) const { return summary(name).at("energy").dump(); }
};

TEST_F(Restarted, IsTheSameAsOneRun) {
  ASSERT_EQ(run(begin("0.001", "whole")), 0) << err();
  ASSERT_EQ(run(begin("0.00043", "r")), 0) << err();  // no time of a frame
  ASSERT_EQ(run(go_on("0.000777", "r")), 0) << err();
  Words last = go_on("0.001", "r/checkpoint.h5");  // the file by name
  last.insert(last.end(), {"--threads", "2"});
  ASSERT_EQ(run(last), 0) << err();
  EXPECT_TRUE(same("whole", "r"));
  EXPECT_EQ(last_energies("whole"), last_energies("r"));
  EXPECT_EQ(summary("whole").at("rings"), summary("r").at("rings"));
  EXPECT_EQ(summary("whole").at("events"), summary("r").at("events"));
  EXPECT_EQ(cinch::Result(path("r")).frames(), 11);
  EXPECT_EQ(cinch::Result(path("r")).probe_times().size(), 21u);
  EXPECT_FALSE(fs::exists(path("r/run.vtkhdf.tmp")));
}

// Killed within its first minute: why there is no checkpoint, and what to do.
TEST_F(Restarted, AKilledRunWithoutCheckpointIsToldWhy) {
  ASSERT_EQ(run({"run", "tiny.toml", "--quiet", "--out", "r", "--set", "output.checkpoint=false"}), 0)
      << err();
  EXPECT_EQ(run(go_on("0.002", "r")), 4);
  EXPECT_TRUE(err().starts_with("error: r: no checkpoint.h5 in this directory, but a result: ")) << err();
  for (const char* words : {"or the disk was full", "once a minute by default", "run the case anew",
                            "output.checkpoint_run_time_s=10"})
    EXPECT_TRUE(has(err(), words)) << err();
}

TEST_F(Restarted, FromWithinItsFolder) {
  ASSERT_EQ(run(begin("0.001", "whole")), 0) << err();
  ASSERT_EQ(run(begin("0.0004", ".")), 0) << err();
  ASSERT_EQ(run(go_on("0.001", "checkpoint.h5")), 0) << err();
  EXPECT_TRUE(same("whole", "."));
}

TEST_F(Restarted, ElsewhereLeavesWhatItGoesOnFrom) {
  ASSERT_EQ(run(begin("0.001", "whole")), 0) << err();
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  const std::string before = text_of(path("r/run.vtkhdf")), checkpoint = text_of(path("r/checkpoint.h5"));
  Words elsewhere = go_on("0.001", "r");
  elsewhere.insert(elsewhere.end(), {"--out", "other"});
  ASSERT_EQ(run(elsewhere), 0) << err();
  EXPECT_TRUE(same("whole", "other"));
  EXPECT_EQ(text_of(path("r/run.vtkhdf")), before);
  EXPECT_EQ(text_of(path("r/checkpoint.h5")), checkpoint);
  EXPECT_EQ(run(elsewhere), 4) << "there is a result already";
  EXPECT_TRUE(has(err(), "other holds a result already")) << err();
}

TEST_F(Restarted, ElsewhereReplacesAllOfAnOldRun) {
  const std::string tiny = tiny_case;
  write("plain.toml", tiny.substr(0, tiny.find("[ring.r1]")));
  ASSERT_EQ(run({"run", "plain.toml", "--quiet", "--set", "time.end_s=0.0004", "--out", "r"}), 0) << err();
  ASSERT_EQ(run(begin("0.0008", "other")), 0) << err();
  for (const char* name : {"other/checkpoint.h5", "other/rings.xdmf"}) ASSERT_TRUE(fs::exists(path(name)));
  Words elsewhere = go_on("0.001", "r");
  elsewhere.insert(elsewhere.end(), {"--out", "other", "--overwrite", "--set", "output.checkpoint=false"});
  ASSERT_EQ(run(elsewhere), 0) << err();
  EXPECT_EQ(cinch::Result(path("other")).frames(), 11);
  for (const char* name : {"other/checkpoint.h5", "other/rings.xdmf"}) EXPECT_FALSE(fs::exists(path(name)));
  EXPECT_TRUE(fs::exists(path("r/checkpoint.h5")));
}

TEST_F(Restarted, ACheckpointOfAnotherRunIsRefused) {
  for (const char* name : {"r", "other"}) ASSERT_EQ(run(begin("0.0004", name)), 0) << err();
  const std::string own = text_of(path("r/checkpoint.h5"));
  write("r/checkpoint.h5", text_of(path("other/checkpoint.h5")));
  const std::string before = text_of(path("r/run.vtkhdf"));
  EXPECT_EQ(run(go_on("0.0006", "r")), 4);
  EXPECT_TRUE(has(err(), "error: r/checkpoint.h5: does not belong to r/run.vtkhdf, which is of another run"))
      << err();
  EXPECT_EQ(text_of(path("r/run.vtkhdf")), before);
  write("r/checkpoint.h5", own);
  ASSERT_EQ(run(go_on("0.0006", "r")), 0) << err();
  write("r/checkpoint.h5", own);  // as a kill before the next one leaves it
  EXPECT_EQ(run(go_on("0.0008", "r")), 0) << err();
}

TEST_F(Restarted, ThatFailsAtOnceRepeatsNoFrame) {
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  Words slow = go_on("0.001", "r");
  slow.insert(slow.end(), {"--set", "time.speed_limit_m_s=1e-3"});
  EXPECT_EQ(run(slow), 3) << err();
  EXPECT_EQ(cinch::Result(path("r")).frame_steps(), (std::vector<std::int64_t>{0, 100, 200, 300, 400}));
}

TEST_F(Restarted, WhileSomebodyReadsTheResult) {
  ASSERT_EQ(run(begin("0.001", "whole")), 0) << err();
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  const cinch::Result open(path("r"));
  ASSERT_EQ(run(go_on("0.001", "r")), 0) << err();
  EXPECT_EQ(open.frames(), 5);
  EXPECT_EQ(open.frame(4).step, 400) << "what was opened is still there";
  EXPECT_TRUE(same("whole", "r"));
}

TEST_F(Restarted, AfterASignal) {
  const pid_t child = start(endless);
  for (int k = 0; k < 200 && !fs::exists(path("r/run.vtkhdf")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130);
  const double stopped = summary("r").at("simulated_seconds");
  ASSERT_GT(stopped, 0);
  const std::string end = std::to_string(stopped + 0.0137);
  ASSERT_EQ(run(go_on(end, "r")), 0) << err();
  Words whole = endless;
  whole.insert(whole.end(), {"--set", "time.end_s=" + end, "--out", "whole", "--quiet"});
  std::erase(whole, "time.end_s=100");
  whole.erase(std::find(whole.begin(), whole.end(), "--set"));  // the one that is left without a value
  whole.erase(std::find(whole.begin(), whole.end(), "r"));
  whole.erase(std::find(whole.begin(), whole.end(), "--out"));
  ASSERT_EQ(run(whole), 0) << err();
  EXPECT_TRUE(same("whole", "r"));
}

TEST_F(Restarted, RunTimesAddUp) {
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  const double first = summary("r").at("wall_seconds");
  ASSERT_EQ(run(go_on("0.0005", "r")), 0) << err();
  EXPECT_GT(summary("r").at("wall_seconds").get<double>(), first);
}

// ----------------------------------------------------------------------------------------------------
// Runs that end when the mouth has closed

class EndsClosed : public Restarted {
 protected:
  // The open net closes at once, in a third of a second.
  Words closing(const std::string& out, const Words& more) const {
    Words words{"run", CINCH_SOURCE_DIR "/cases/capture.toml", "--quiet", "--out", out};
    const Words changes{
        "case.method=sliding",      "time.step_s=auto",    "time.safety=0.8", "thread.*.elements=8",
        "net.main.stowed_factor=1", "closing.time_s=0.05", "time.end_s=0.5",  "output.probe_interval_s=0.01"};
    for (const Words& list : {changes, more})
      for (const std::string& change : list) words.insert(words.end(), {"--set", change});
    return words;
  }
  double closed_at(const std::string& name) const {
    const Json found = summary(name);
    for (const Json& event : found.at("events"))
      if (event.at("kind") == "mouth_closed") return event.at("time");
    return -1;
  }
  double end_of(const std::string& name) const { return summary(name).at("simulated_seconds"); }
};

TEST_F(EndsClosed, AtTheSampleThatShowsItOrLater) {
  ASSERT_EQ(run(closing("whole", {})), 0) << err();
  EXPECT_NEAR(end_of("whole"), 0.5, 1e-5);
  const double closed = closed_at("whole");
  ASSERT_GT(closed, 0.1);
  ASSERT_LT(closed, 0.4);
  ASSERT_EQ(run(closing("r", {"time.end_when=mouth_closed"})), 0) << err();
  EXPECT_EQ(closed_at("r"), closed);
  EXPECT_EQ(end_of("r"), closed);
  EXPECT_EQ(summary("r").at("status"), "done");
  EXPECT_EQ(cinch::Result(path("r")).frame_times().back(), closed);
  ASSERT_EQ(run(closing("later", {"time.end_when=mouth_closed", "time.end_delay_s=0.0137"})), 0) << err();
  EXPECT_NEAR(end_of("later"), closed + 0.0137, 1e-5);
  ASSERT_EQ(run(closing("early", {"time.end_when=mouth_closed", "time.end_s=0.1"})), 0) << err();
  EXPECT_NEAR(end_of("early"), 0.1, 1e-5);
}

TEST_F(EndsClosed, AndGoesOnWhenAsked) {
  ASSERT_EQ(run(closing("whole", {})), 0) << err();
  ASSERT_EQ(run(closing("r", {"time.end_when=mouth_closed"})), 0) << err();
  EXPECT_EQ(run({"run", "--restart", "r"}), 2);
  EXPECT_TRUE(has(err(), "as its mouth has closed; to go on take --set time.end_when=never")) << err();
  ASSERT_EQ(run({"run", "--restart", "r", "--set", "time.end_delay_s=0.02"}), 0) << err();
  EXPECT_NEAR(end_of("r"), closed_at("whole") + 0.02, 1e-5);
  ASSERT_EQ(run({"run", "--restart", "r", "--set", "time.end_when=never", "--threads", "2"}), 0) << err();
  EXPECT_TRUE(same("whole", "r"));
  EXPECT_EQ(last_energies("whole"), last_energies("r"));
}

TEST_F(EndsClosed, NeedsAMouth) {
  EXPECT_EQ(run({"run", "tiny.toml", "--out", "r", "--set", "time.end_when=mouth_closed"}), 2);
  EXPECT_TRUE(has(err(), "the case has no mouth that closes")) << err();
  EXPECT_FALSE(fs::exists(path("r")));
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  EXPECT_EQ(
      run({"run", "--restart", "r", "--set", "time.end_s=0.001", "--set", "time.end_when=mouth_closed"}), 2);
  EXPECT_TRUE(has(err(), "the case has no mouth that closes")) << err();
}

// ----------------------------------------------------------------------------------------------------
// Killed at random moments

TEST_F(Restarted, AfterTwoHundredKills) {
  std::mt19937 random(20261126);
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_EQ(run(begin("0.001", "short")), 0) << err();
  const std::chrono::duration<double> short_run = std::chrono::steady_clock::now() - begun;
  std::uniform_real_distribution<double> lifetime(
      0, 3 * short_run.count());  // s: before it starts up and long after
  const Words sets{"--quiet", "--set", "output.checkpoint_run_time_s=0.002"};
  Words first{"run",
              "tiny.toml",
              "--overwrite",
              "--out",
              "r",
              "--set",
              "output.frame_interval_s=0.001",
              "--set",
              "output.probe_interval_s=0.0003",
              "--set",
              "time.end_s=1000",
              "--set",  // after a second, where a quick machine may come to
              "contact.leaving=event"};
  Words next{"run", "--restart", "r"};
  for (Words* words : {&first, &next}) words->insert(words->end(), sets.begin(), sets.end());
  int went_on = 0, frames = 0;
  for (int life = 0; life < 200; ++life) {
    const bool kept = fs::exists(path("r/checkpoint.h5"));
    const pid_t child = start(kept ? next : first);
    std::this_thread::sleep_for(std::chrono::duration<double>(lifetime(random)));
    kill(child, SIGKILL);
    ASSERT_EQ(wait_for(child), 1000 + SIGKILL) << err();
    went_on += kept;
    if (!fs::exists(path("r/checkpoint.h5"))) continue;
    const cinch::Result result(path("r"));  // throws for what cannot be read
    for (int k = std::max(result.frames() - 3, 0); k < result.frames(); ++k)
      for (const cinch::Vec3& x : result.frame(k).position) ASSERT_TRUE(x.allFinite());
    frames = std::max(frames, result.frames());
  }
  EXPECT_GT(went_on, 50);
  EXPECT_GT(frames, 3) << "it got on from life to life";
  const std::string end = "time.end_s=" + std::to_string(0.001 * frames + 0.0137);
  next.insert(next.end(), {"--set", end});
  ASSERT_EQ(run(next), 0) << err();
  first[4] = "whole";
  first.insert(first.end(), {"--set", end});
  ASSERT_EQ(run(first), 0) << err();
  EXPECT_TRUE(same("whole", "r"));
  EXPECT_EQ(last_energies("whole"), last_energies("r"));
}

// ----------------------------------------------------------------------------------------------------
// No room on the disk

TEST_F(Restarted, AFullDiskKeepsFramesAndCheckpoint) {
  const Words words = {"run",
                       "tiny.toml",
                       "--quiet",
                       "--out",
                       "r",
                       "--set",
                       "time.end_s=0.2",
                       "--set",
                       "output.checkpoint_interval_s=0.001"};
  EXPECT_EQ(run(words, "ulimit -f 4000; "), 4) << "files may not grow beyond 4000 blocks";
  EXPECT_TRUE(has(err(), "r/run.vtkhdf") && has(err(), "File too large")) << err();
  const int kept = cinch::Result(path("r")).frames();
  EXPECT_GT(kept, 10);
  ASSERT_EQ(run(go_on("0.05", "r")), 0) << "with room again: " << err();
  Words whole = words;
  whole[4] = "whole";
  whole[6] = "time.end_s=0.05";
  ASSERT_EQ(run(whole), 0) << err();
  EXPECT_TRUE(same("whole", "r"));
}

TEST_F(Restarted, ThatFindsNoRoomLeavesNoDraft) {
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  const std::string before = text_of(path("r/run.vtkhdf"));
  EXPECT_EQ(run(go_on("0.001", "r"), "ulimit -f 10; "), 4);
  EXPECT_TRUE(has(err(), "r/run.vtkhdf.tmp") && has(err(), "File too large")) << err();
  EXPECT_FALSE(fs::exists(path("r/run.vtkhdf.tmp")));
  EXPECT_EQ(text_of(path("r/run.vtkhdf")), before);
  EXPECT_EQ(summary("r").at("status"), "done") << "that of what is still there";
  EXPECT_EQ(run(go_on("0.001", "r")), 0) << "with room again: " << err();
}

// A folder in the way.
TEST_F(Restarted, ACheckpointThatCannotBeWrittenEndsNoRun) {
  fs::create_directories(path("r/checkpoint.h5.tmp"));
  Words words = begin("0.001", "r");
  words.insert(words.end(), {"--set", "output.checkpoint_interval_s=0.0001"});
  EXPECT_EQ(run(words), 4);
  const std::string said = err(), warning = "no checkpoint could be written: r/checkpoint.h5.tmp: ";
  EXPECT_TRUE(said.starts_with("warning: at t = 0.0001 s " + warning)) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  const Json told = summary("r");
  EXPECT_EQ(told.at("status"), "done");
  EXPECT_EQ(told.at("steps"), 1000);
  EXPECT_EQ(told.at("events").size(), 1u);
  ASSERT_EQ(told.at("warnings").size(), 1u);
  EXPECT_TRUE(has(told.at("warnings")[0], warning)) << told.at("warnings");
  EXPECT_EQ(cinch::Result(path("r")).frames(), 11);
}

// ----------------------------------------------------------------------------------------------------
// What is refused, with nothing changed

TEST_F(Restarted, ChangesThatTheMotionWouldHaveToKnowAreRefused) {
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  const std::string before = text_of(path("r/run.vtkhdf"));
  Words changed = go_on("0.001", "r");
  changed.insert(changed.end(), {"--set", "ring.r1.mass_kg=1"});
  EXPECT_EQ(run(changed), 2);
  EXPECT_TRUE(has(err(), "ring.r1.mass_kg=1: a run that goes on keeps its case; allowed: time.end_s"))
      << err();
  EXPECT_EQ(run(go_on("0.0004", "r")), 2);
  EXPECT_TRUE(has(err(), "stands at 0.0004 s, and the case ends at 0.0004 s")) << err();
  EXPECT_EQ(run(go_on("soon", "r")), 2);
  EXPECT_TRUE(has(err(), "time.end_s=soon")) << err();
  EXPECT_EQ(run({"run", "tiny.toml", "--restart", "r"}), 2);
  EXPECT_EQ(run({"run"}), 2);
  EXPECT_TRUE(has(err(), "CASE")) << err();
  EXPECT_EQ(text_of(path("r/run.vtkhdf")), before);
  EXPECT_EQ(summary("r").at("status"), "done");
}

TEST_F(Restarted, WhatIsMissingOrDamagedIsNamed) {
  EXPECT_EQ(run({"run", "--restart", "nowhere"}), 4);
  EXPECT_TRUE(has(err(), "nowhere: no such file or directory")) << err();
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  const std::string checkpoint = text_of(path("r/checkpoint.h5")), early = text_of(path("r/run.vtkhdf"));
  std::string damaged = checkpoint;
  damaged[damaged.size() / 2] ^= 1;
  write("r/checkpoint.h5", damaged);
  EXPECT_EQ(run(go_on("0.001", "r")), 4);
  EXPECT_TRUE(has(err(), "r/checkpoint.h5: the checkpoint is damaged")) << err();

  write("r/checkpoint.h5", checkpoint);
  ASSERT_EQ(run(go_on("0.0008", "r")), 0) << err();
  write("r/run.vtkhdf", early);  // holds less than the checkpoint counts on
  EXPECT_EQ(run(go_on("0.001", "r")), 4);
  EXPECT_TRUE(has(err(), "holds 5 frames and 9 rows of probes; the checkpoint needs 9 and 17")) << err();
  EXPECT_EQ(text_of(path("r/run.vtkhdf")), early);
  EXPECT_FALSE(fs::exists(path("r/run.vtkhdf.tmp")));
  fs::remove(path("r/run.vtkhdf"));
  EXPECT_EQ(run(go_on("0.001", "r")), 4);
}

TEST_F(Restarted, ACaseMayDoWithoutCheckpoints) {
  ASSERT_EQ(run(begin("0.0004", "r")), 0) << err();
  Words without = begin("0.0004", "r");
  without.insert(without.end(), {"--overwrite", "--set", "output.checkpoint=false"});
  ASSERT_EQ(run(without), 0) << err();
  EXPECT_FALSE(fs::exists(path("r/checkpoint.h5"))) << "that of the run before does not belong to this one";
  EXPECT_EQ(run(go_on("0.001", "r")), 4);
  EXPECT_TRUE(has(err(), "r: no checkpoint.h5 in this directory")) << err();
}

}  // namespace
