// Two runs and one folder: only one of them writes there, whatever the moment at which the other begins.
#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "output/folder_lock.hpp"
#include "output/result_reader.hpp"
#include "support/program.hpp"

namespace {

using namespace cinch::test;

class TwoRuns : public Program {
 protected:
  const Words tiny{"run", "tiny.toml", "--quiet"};
  Words tiny_in(const std::string& folder, const Words& more = {}) const {
    Words words{"run", "tiny.toml", "--quiet", "--out", folder};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  const Words go_on{"run", "--quiet", "--restart", "r", "--set", "time.end_s=0.0012"};
  std::string files(const std::string& folder) const {
    std::string all;
    for (const char* name : {"/run.vtkhdf", "/run.xdmf", "/summary.json", "/checkpoint.h5"})
      all += text_of(path(folder + name));
    return all;
  }
  void expect_refused(const Words& words, const std::string& folder) const {
    EXPECT_EQ(run(words), 4);
    EXPECT_EQ(err(), "error: " + folder + ": another cinch run is writing to it\n");
  }
};

TEST_F(TwoRuns, TheSecondChangesNothing) {
  ASSERT_EQ(run(tiny_in("r")), 0) << err();
  const std::string before = files("r");
  const cinch::FolderLock first(path("r"));
  first.write();
  expect_refused(tiny_in("r", {"--overwrite"}), "r");
  expect_refused(tiny_in("r"), "r");
  expect_refused(go_on, "r");
  Words elsewhere = go_on;
  elsewhere.insert(elsewhere.end(), {"--out", "other"});
  expect_refused(elsewhere, "r");
  EXPECT_FALSE(fs::exists(path("other")));
  elsewhere.back() = "../" + path("r").parent_path().filename().string() + "/r";  // the same by another name
  elsewhere.push_back("--overwrite");
  expect_refused(elsewhere, "r");
  EXPECT_TRUE(files("r") == before);
  for (const Words& look : {Words{"info", "r"}, Words{"compare", "r", "r"}, Words{"report", "r"}})
    EXPECT_EQ(run(look), 0) << look[0] << err();
}

TEST_F(TwoRuns, WithoutOutTheSecondTakesTheNextFolder) {
  fs::create_directories(path("results/tiny"));
  const cinch::FolderLock first(path("results/tiny"));
  first.write();
  ASSERT_EQ(run(tiny), 0) << err();
  EXPECT_EQ(out(), "results: results/tiny-2\n");
  Words replace = tiny;
  replace.push_back("--overwrite");
  expect_refused(replace, "results/tiny");
}

TEST_F(TwoRuns, BegunAtOnceEachHasItsOwn) {
  const pid_t one = start(tiny), other = start(tiny);
  EXPECT_EQ(wait_for(one), 0) << err();
  EXPECT_EQ(wait_for(other), 0) << err();
  for (const char* name : {"results/tiny", "results/tiny-2"})
    EXPECT_EQ(cinch::Result(path(name)).frames(), 11) << name;
}

TEST_F(TwoRuns, BegunAtOnceInOneNewFolder) {
  const pid_t one = start(tiny_in("new/r")), other = start(tiny_in("new/r"));
  const int first = wait_for(one), second = wait_for(other);
  EXPECT_EQ(std::min(first, second), 0);
  EXPECT_EQ(std::max(first, second), 4);
  EXPECT_EQ(cinch::Result(path("new/r")).frames(), 11);
  EXPECT_EQ(summary("new/r").at("status"), "done");
}

// What is copied must hold still; the run that goes on elsewhere lets go of it then.
TEST_F(TwoRuns, AResultIsGoneOnFromByTwo) {
  ASSERT_EQ(run(tiny_in("r")), 0) << err();
  const cinch::FolderLock reader(path("r"));
  reader.read();
  Words elsewhere = go_on;
  elsewhere.insert(elsewhere.end(), {"--out", "other"});
  EXPECT_EQ(run(elsewhere), 0) << err();
  EXPECT_EQ(run(go_on), 4);
  EXPECT_EQ(err(), "error: r: another cinch run is reading it\n");
}

TEST_F(TwoRuns, AKilledRunHoldsNothing) {
  const pid_t child = start(endless);
  for (int k = 0; k < 1200 && !fs::exists(path("r/run.vtkhdf")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  expect_refused(tiny_in("r", {"--overwrite"}), "r");
  kill(child, SIGSTOP);  // its file holds still
  waitpid(child, nullptr, WUNTRACED);
  ASSERT_EQ(run({"info", "r"}), 0) << err();
  EXPECT_TRUE(has(out(), "status          not finished: still running\n")) << out();
  kill(child, SIGKILL);
  wait_for(child);
  ASSERT_EQ(run({"info", "r"}), 0) << err();
  EXPECT_TRUE(
      has(out(),
          "status          not finished: stopped before its end, as no run on this machine writes to it\n"))
      << out();
  EXPECT_EQ(run(tiny_in("r", {"--overwrite"})), 0) << err();
  EXPECT_EQ(cinch::writer_of(path("nowhere")), cinch::Writer::unknown);
}

TEST_F(TwoRuns, WhoLooksIsWaitedFor) {
  ASSERT_EQ(run(tiny_in("r")), 0) << err();
  std::optional<cinch::FolderLock> look(path("r"));
  look->read();
  std::thread leaves([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    look.reset();
  });
  EXPECT_EQ(run(go_on), 0) << err();
  leaves.join();
}

}  // namespace
