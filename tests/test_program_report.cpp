// `cinch report` and `cinch check` on the paper's own cases, which most of the page is written for.
#include <sys/stat.h>

#include "support/program.hpp"

namespace {

using namespace cinch::test;

class Reported : public Program {
 protected:
  void simulate(const std::string& name, const std::string& out, const Words& sets) const {
    Words words{"run", CINCH_SOURCE_DIR "/cases/" + name + ".toml", "--quiet", "--out", out};
    for (const std::string& set : sets) words.insert(words.end(), {"--set", set});
    ASSERT_EQ(run(words), 0) << err();
  }
};

TEST_F(Reported, OnePageAndOneTableForSeveralResults) {
  for (const char* elements : {"50", "100", "200", "300"})
    simulate("ring_pull", std::string("r") + elements,
             {"time.end_s=0.05", std::string("thread.main.elements=") + elements});
  ASSERT_EQ(run({"report", "r50", "r100", "r200", "r300", "--html", "page.html", "--table", "table.md"}), 0)
      << err();
  EXPECT_TRUE(has(out(), "report: page.html")) << out();
  const std::string page = text_of(path("page.html")), table = text_of(path("table.md"));
  EXPECT_TRUE(has(page, "Verdict") && has(page, "No frame at"));
  EXPECT_TRUE(table.starts_with("| ring_pull | place | paper | Cinch | verdict |")) << table;
  EXPECT_TRUE(has(table, "(50 elements) | Fig. 9 | 4 N |")) << table;
}

TEST_F(Reported, ClosingTimesSideBySide) {
  std::vector<std::string> quick{"case.method=sliding", "time.step_s=auto", "output.frame_interval_s=0.05",
                                 "output.probe_interval_s=0.01"};
  for (const char* thread : {"c_top", "c_right", "c_bottom", "c_left"})
    quick.push_back(std::string("thread.") + thread + ".elements=12");
  for (const auto& [time, end] : {std::pair{"1.2", "1.65"}, {"1.3", "1.5"}}) {
    std::vector<std::string> sets = quick;
    sets.insert(sets.end(), {std::string("closing.time_s=") + time, std::string("time.end_s=") + end});
    simulate("capture", std::string("c") + time, sets);
  }
  ASSERT_EQ(run({"report", "c1.2", "c1.3", "--open", "c1.3"}), 0) << err();
  const std::string page = text_of(path("c1.2/report.html"));
  EXPECT_TRUE(has(page, "Closing times")) << out();
  EXPECT_TRUE(has(page, "closing at 1.2 s, t = 1.6 s")) << "0.4 s after it";
  EXPECT_TRUE(has(page, "No frame at 1.7 s"));
  const std::string row = page.substr(page.find("<td class=\"n\">1.3\u202fs</td>"));
  EXPECT_TRUE(has(row.substr(0, row.find("</tr>")), "<td>–</td>")) << "not yet decided whether it encloses";
}

TEST_F(Reported, CapturesMadeAgain) {
  const std::vector<std::string> quick{"case.method=sliding",          "time.step_s=auto",
                                       "closing.time_s=1.2",           "time.end_s=1.75",
                                       "output.frame_interval_s=0.01", "thread.c_top.elements=12",
                                       "thread.c_right.elements=12",   "thread.c_bottom.elements=12",
                                       "thread.c_left.elements=12"};
  simulate("capture", "c", quick);
  std::vector<std::string> otherwise = quick, later = quick;
  otherwise.push_back("net.main.stowed_factor=0.1001");
  simulate("capture", "again", otherwise);
  later.push_back("closing.time_s=1.3");
  simulate("capture", "later", later);
  ASSERT_EQ(run({"report", "c", "--again", "again", "later", "c", "--table", "table.md"}), 0) << err();
  EXPECT_EQ(err(),
            "warning: --again later is left out: no result closes at its time\n"
            "warning: --again c is left out: it is one of the results\n");
  EXPECT_TRUE(has(out(), "median of 2 runs")) << "on the terminal, too: " << out();
  const std::string table = text_of(path("table.md"));
  EXPECT_TRUE(has(table, "median of 2 runs")) << table;
}

TEST_F(Reported, StepsBeforeAndFromTheClosingTimeOn) {
  std::vector<std::string> sets{"case.method=sliding", "time.step_s=1e-6", "closing.time_s=0.001",
                                "time.end_s=0.002", "output.frame_interval_s=1e-4"};
  simulate("capture", "even", sets);
  sets.push_back("closing.step_s=3.5e-6");
  simulate("capture", "c", sets);
  ASSERT_EQ(run({"info", "c"}), 0) << err();
  EXPECT_TRUE(has(out(), "1286, of 1e-06 s before closing and 3.5e-06 s from then on, 0.002001 s simulated"))
      << out();
  ASSERT_EQ(run({"report", "c"}), 0) << err();
  EXPECT_TRUE(has(text_of(path("c/report.html")), "step before closing"));
  EXPECT_EQ(run({"compare", "c", "c"}), 0) << out();
  run({"compare", "even", "c"});
  EXPECT_FALSE(has(out(), "without partner")) << "frames lie up to 1.75e-6 s beside each other: " << out();
}

TEST_F(Reported, AnotherSceneIsNotJudgedByThePapersNumbers) {
  simulate("ring_pull", "r", {"time.end_s=0.01", "thread.main.start.mass_kg=5"});
  ASSERT_EQ(run({"report", "r", "--table", "table.md", "--open", "r"}), 0) << err();
  EXPECT_TRUE(err().starts_with("warning: --open r is left out: not the paper's scene: ")) << err();
  const std::string page = text_of(path("r/report.html"));
  EXPECT_TRUE(has(page, "Not the paper's scene: ball's mass 5 kg, the paper's 0.1 kg (Sec. 5.1)."));
  EXPECT_FALSE(has(page, "class=\"badge") || has(page, "... in the paper")) << "neither verdict nor run time";
  EXPECT_TRUE(has(out(), "\nnot the paper's scene: ball's mass 5 kg, the paper's 0.1 kg (Sec. 5.1)\n"))
      << out();
  EXPECT_FALSE(has(out(), "reproduced")) << out();
  EXPECT_TRUE(has(text_of(path("table.md")), "| ring_pull: not the paper's scene: ball's mass"));
}

TEST_F(Reported, AStoppedRunIsNotJudgedByWhatComesLater) {
  simulate("ring_pull", "r", {"time.end_s=0.01"});
  ASSERT_EQ(run({"report", "r"}), 0) << err();
  EXPECT_FALSE(has(out(), "reproduced") || has(out(), "converge")) << out();
  EXPECT_TRUE(has(out(), "not in these results   Ball passes the ring")) << out();
}

TEST_F(Reported, ThreeRingsWithoutANetAreNoMouth) {
  std::string text =
      "schema = 1\n[time]\nend_s = 0.01\n[material.m]\nyoungs_modulus_Pa = 1e9\ndensity_kg_m3 = 970\n"
      "[thread.t]\nmaterial = \"m\"\ndiameter_m = 0.002\n"
      "points_m = [[0, 0, 0], [0.2, 0.1, 0], [0.4, 0, 0], [0.5, 0, 0]]\nend = { velocity_m_s = [0, 1, 0] }\n";
  int number = 0;
  for (const char* center : {"0.1, 0.05, 0", "0.2, 0.1, 0", "0.3, 0.05, 0"})
    text += "[ring.r" + std::to_string(++number) +
            "]\ndiameter_m = 0.02\nwire_diameter_m = 0.004\nmass_kg = 0.1\nyoungs_modulus_Pa = 7e10\n"
            "normal = [1, 0, 0]\ncenter_m = [" +
            center + "]\n";
  write("rings.toml", text);
  ASSERT_EQ(run({"run", "rings.toml", "--quiet", "--out", "r"}), 0) << err();
  ASSERT_EQ(run({"report", "r"}), 0) << err();
  EXPECT_FALSE(has(text_of(path("r/report.html")), "Area of the mouth"));
}

// Its own pages are replaced, nothing else.
TEST_F(Reported, NoOtherFileIsReplaced) {
  ASSERT_EQ(run({"run", "tiny.toml", "--quiet", "--out", "r"}), 0) << err();
  ASSERT_EQ(run({"report", "r", "--html", "page.html", "--table", "table.md"}), 0) << err();
  EXPECT_EQ(run({"report", "r", "--html", "page.html", "--table", "table.md"}), 0) << err();
  const auto refused = [&](const Words& words, const std::string& file) {
    Words all{"report", "r"};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(run(all), 2) << file;
    EXPECT_TRUE(err().starts_with("error: " + file + " is not replaced: ")) << err();
  };
  refused({"--html", "tiny.toml"}, "tiny.toml");
  refused({"--table", "tiny.toml"}, "tiny.toml");
  refused({"--html", "table.md"}, "table.md");
  EXPECT_EQ(text_of(path("tiny.toml")), tiny_case);
  fs::create_symlink("/dev/null", path("null"));
  mkfifo(path("pipe").c_str(), 0600);
  refused({"--html", "null"}, "null");
  refused({"--table", "pipe"}, "pipe");
  refused({"--html", "r"}, "r");
  EXPECT_TRUE(fs::is_symlink(path("null")) && fs::is_fifo(path("pipe")));
  write("r/report.html", "mine");
  refused({}, "r/report.html");
  EXPECT_EQ(text_of(path("r/report.html")), "mine");
  EXPECT_EQ(run({"report", "r", "--html", "new", "--table", "./new"}), 2);
  EXPECT_FALSE(fs::exists(path("new")));
}

TEST_F(Reported, ANewRunTakesTheOldReportAway) {
  const Words again{"run", "tiny.toml", "--quiet", "--out", "r", "--overwrite"};
  const auto page = [&] { return fs::exists(path("r/report.html")); };
  ASSERT_EQ(run(again), 0) << err();
  ASSERT_EQ(run({"report", "r"}), 0) << err();
  ASSERT_TRUE(page());
  ASSERT_EQ(run(again), 0) << err();
  EXPECT_FALSE(page());
  ASSERT_EQ(run({"report", "r"}), 0) << err();
  ASSERT_EQ(run({"run", "--restart", "r", "--quiet", "--set", "time.end_s=0.0011"}), 0) << err();
  EXPECT_FALSE(page());
  write("r/report.html", "mine");
  ASSERT_EQ(run(again), 0) << err();
  EXPECT_TRUE(page()) << "not ours to remove";
}

TEST_F(Reported, HelpTellsOfSeveralResultsAndWhereThePageGoes) {
  ASSERT_EQ(run({"report", "--help"}), 0);
  EXPECT_TRUE(has(out(), "RESULT...") && !has(out(), "(1x)")) << out();
  EXPECT_TRUE(has(out(), "beside the first RESULT")) << out();
}

// The first tenths of a second; rings hang on the upper edge, masses on the thread through them.
TEST_F(Reported, HeightsOfAnEdgeThatCloses) {
  simulate("edge_closure", "e",
           {"time.end_s=0.1", "output.frame_interval_s=0.02", "rings.r.joint=sliding", "time.step_s=auto",
            "thread.closing.elements=24"});
  ASSERT_EQ(run({"report", "e", "--table", "table.md"}), 0) << err();
  const std::string page = text_of(path("e/report.html"));
  for (const char* words : {"Heights of the two masses", "Greatest distance between ring centres",
                            "Contact force on the rings", "right mass", "bunched"})
    EXPECT_TRUE(has(page, words)) << words;
  EXPECT_TRUE(has(text_of(path("table.md")), "| Greatest speed in the net at the start |"));
}

TEST_F(Reported, CheckLooksBeyondTheClosing) {
  const std::string capture = CINCH_SOURCE_DIR "/cases/capture.toml";
  ASSERT_EQ(run({"check", capture}), 0) << err();
  EXPECT_TRUE(has(out(), "closing          at 1.5 s: ") && has(out(), "expected time")) << out();
}

TEST_F(Reported, CheckTellsForHowManyStepsForcesOfJointsHold) {
  Words words{"check", CINCH_SOURCE_DIR "/cases/capture.toml"};
  for (const char* set : {"case.method=sliding", "time.step_s=auto", "time.joint_steps=2"})
    words.insert(words.end(), {"--set", set});
  for (const char* thread : {"c_top", "c_right", "c_bottom", "c_left"})
    words.insert(words.end(), {"--set", std::string("thread.") + thread + ".elements=12"});
  ASSERT_EQ(run(words), 0) << err();
  EXPECT_TRUE(has(out(), "sliding joints       16 rings on 4 threads, every 2 steps")) << out();
}

// A bar in a folder's name would end the cell.
TEST_F(Reported, CellsOfTheTableStayWhole) {
  for (const char* name : {"a|b", "c"}) simulate("ring_pull", name, {"time.end_s=0.01"});
  ASSERT_EQ(run({"report", "a|b", "c", "--html", "page.html", "--table", "table.md"}), 0) << err();
  EXPECT_TRUE(has(text_of(path("table.md")), "(a\\|b)")) << text_of(path("table.md"));
}

TEST_F(Reported, CheckTellsThatTheMotionGoesWrong) {
  ASSERT_EQ(run({"check", "tiny.toml", "--set", "time.step_s=1.25e-5", "--set", "time.allow_unstable=true",
                 "--set", "time.end_s=1"}),
            3)
      << err();
  EXPECT_TRUE(has(out(), "\nthe case is valid, but its trial stopped: at t = ")) << out();
}

}  // namespace
