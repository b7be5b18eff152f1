// A second signal ends a run at once, whatever the first has come to. A pipe that nobody reads stands where
// the program writes a file, so that it waits there for ever: no clock decides what these tests see.
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "output/result_reader.hpp"
#include "support/program.hpp"

namespace {

using namespace cinch::test;
using std::chrono::milliseconds;

class Signalled : public Program {
 protected:
  void block(const std::string& name) const {
    fs::create_directories(path(name).parent_path());
    ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
  }

  void wait_for_file(const std::string& name) const {
    for (int k = 0; k < 1200 && !fs::exists(path(name)); ++k) std::this_thread::sleep_for(milliseconds(50));
    ASSERT_TRUE(fs::exists(path(name))) << err();
  }

  // Sends a signal again and again, further apart than one request's, and returns how the program ended. A
  // program that lives on is killed.
  static int insist(pid_t child, int signal) {
    for (int k = 0; k < 100; ++k) {
      std::this_thread::sleep_for(milliseconds(150));
      kill(child, signal);
      int status = 0;
      if (waitpid(child, &status, WNOHANG) == child) return code_of(status);
    }
    kill(child, SIGKILL);
    return wait_for(child);
  }
};

class SignalledTwice : public Signalled, public testing::WithParamInterface<int> {
 protected:
  int code() const { return GetParam() == SIGTERM ? 143 : 130; }
};

TEST_P(SignalledTwice, EndsBeforeTheFirstIsLookedAt) {
  block("r/run.xdmf.tmp");  // written with the first frame
  const pid_t child = start(endless);
  wait_for_file("r/run.vtkhdf");
  kill(child, SIGINT);
  EXPECT_EQ(insist(child, GetParam()), code()) << err();
  EXPECT_FALSE(fs::exists(path("r/summary.json")));
  EXPECT_FALSE(fs::exists(path("r/checkpoint.h5")));
}

TEST_P(SignalledTwice, EndsTheOrderlyEnd) {
  block("r/summary.json.tmp");  // written last
  const pid_t child = start(endless);
  wait_for_file("r/run.vtkhdf");
  kill(child, SIGINT);
  wait_for_file("r/checkpoint.h5");
  EXPECT_EQ(insist(child, GetParam()), code()) << err();
  EXPECT_FALSE(fs::exists(path("r/summary.json")));
  EXPECT_EQ(run({"info", "r"}), 0) << err();
  fs::remove(path("r/summary.json.tmp"));
  const std::string later = std::to_string(cinch::Result(path("r")).frame_times().back() + 0.01);
  EXPECT_EQ(run({"run", "--restart", "r", "--set", "time.end_s=" + later}), 0) << err();
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalledTwice, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& signal) { return std::string(sigabbrev_np(signal.param)); });

// As `timeout` and closing terminals send them: both wait for a stopped program, and come one right after the
// other.
TEST_F(Signalled, TwiceAtOnceIsOneRequest) {
  const pid_t child = start(endless);
  wait_for_file("r/run.vtkhdf");
  kill(child, SIGSTOP);
  waitpid(child, nullptr, WUNTRACED);
  for (const int signal : {SIGINT, SIGTERM, SIGCONT}) kill(child, signal);
  const int code = wait_for(child);
  EXPECT_TRUE(code == 130 || code == 143) << code;
  EXPECT_EQ(summary("r").at("status"), code == 130 ? "interrupted" : "terminated");
  EXPECT_TRUE(fs::exists(path("r/checkpoint.h5")));
}

// As nohup does, and shells for what runs in the background.
TEST_F(Signalled, WhatIsIgnoredStaysSo) {
  const pid_t child = start(endless, "trap '' INT HUP; ");
  wait_for_file("r/run.vtkhdf");
  const std::string status = text_of("/proc/" + std::to_string(child) + "/status");
  const auto in = [&](const std::string& mask, int signal) {
    return (std::stoull(status.substr(status.find(mask) + mask.size()), nullptr, 16) >> (signal - 1) & 1) !=
           0;
  };
  for (const int signal : {SIGINT, SIGHUP}) {
    EXPECT_TRUE(in("SigIgn:", signal)) << status;
    kill(child, signal);
  }
  EXPECT_TRUE(in("SigCgt:", SIGTERM)) << status;
  kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child), 143) << err();
  EXPECT_EQ(summary("r").at("status"), "terminated");
}

// While it sleeps in a call of the system, which the signal interrupts.
TEST_F(Signalled, AnInterruptedWriteGoesOn) {
  block("r/run.xdmf.tmp");
  const pid_t child = start(endless);
  wait_for_file("r/run.vtkhdf");
  const std::string stat = "/proc/" + std::to_string(child) + "/stat";
  for (int k = 0; k < 1200 && !has(text_of(stat), ") S "); ++k) std::this_thread::sleep_for(milliseconds(50));
  kill(child, SIGTERM);
  std::this_thread::sleep_for(milliseconds(50));
  const int pipe = open(path("r/run.xdmf.tmp").c_str(), O_RDWR);  // never waits, and holds what is written
  EXPECT_EQ(wait_for(child), 143) << err();
  close(pipe);
  EXPECT_EQ(summary("r").at("status"), "terminated");
}

}  // namespace
