// Result files: what is written is what is read, to the bit, whatever happens to the writer.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "output/compare.hpp"
#include "output/info.hpp"
#include "output/recorder.hpp"
#include "output/result_layout.hpp"
#include "output/result_reader.hpp"
#include "output/summary_json.hpp"
#include "output/text_file.hpp"
#include "output/ways.hpp"
#include "output/xdmf.hpp"
#include "support/file_error.hpp"

namespace cinch {
namespace {

namespace fs = std::filesystem;

/// A directory of its own that goes away with the test.
struct Scratch {
  fs::path path;
  Scratch() {
    std::string name = (fs::temp_directory_path() / "cinch-results-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Scratch() { fs::remove_all(path); }
};

/// A thread of `nodes` nodes with two rings, which slide on it, and a ball.
ResultModel small_model(int nodes) {
  ResultModel model;
  model.case_name = "small";
  model.title = "a <small> \"net\" & more";
  model.about = std::string(70000, 'x');  // more than an HDF5 attribute holds
  model.case_toml = "schema = 1\n# caf\xc3\xa9\n";
  model.version = "0.1.0";
  model.commit = "";
  model.compiler = "g++ 12";
  model.isa = "avx2";
  model.threads = 3;
  model.time_step = 1e-6 / 3;
  model.closing_time_step = 1e-6 / 7;
  for (int i = 0; i + 1 < nodes; ++i) {
    model.elements.push_back({i + 1, i});
    model.rest_length.push_back(0.1 / (i + 1));
    model.element_radius.push_back(0.001 + i);
    model.element_part.push_back(i % 2);
  }
  for (int i = 0; i < nodes; ++i) model.node_mass.push_back(1.0 / (3 + i));
  model.parts = {{"net", "main", false}, {"thread", "closing", true}};
  model.rings = {{"r1", 0.05, 0.002}, {"r2", 0.06, 0.003}};
  model.joints = {{1, 1}, {1, 0}};
  model.balls = {{"target", Vec3(1, 2, 1.0 / 3), 0.75}};
  model.masses = {{"m1.launcher", nodes - 1, 0.5}};
  model.closing_time = 0.1;
  model.probes = {{"tension_1", "tension", "thread.closing", "N"}, {"height", "position_z", "net.main", "m"}};
  return model;
}

/// Frame k: values that no other frame, node or element has.
Frame small_frame(const ResultModel& model, int k) {
  Frame frame;
  frame.time = k / 30.0;
  frame.step = 1000L * k + 7;
  const std::size_t nodes = model.node_mass.size();
  for (std::size_t i = 0; i < nodes; ++i) {
    const double x = static_cast<double>(i), t = k + 1;
    frame.position.emplace_back(std::sqrt(t + x), x / (3 * t), -t);
    frame.velocity.emplace_back(t / 7, -x / t, 1e-300 * t);
    frame.contact_force.emplace_back(-0.0, t * 1e17, x / 11 + t);
  }
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const double x = static_cast<double>(e);
    frame.tension.push_back((x + 1) / (k + 3));
    frame.strain.push_back(x / 9 - k);
    frame.active.push_back(static_cast<std::uint8_t>((e + static_cast<std::size_t>(k)) % 2));
  }
  for (std::size_t r = 0; r < model.rings.size(); ++r) {
    const double x = static_cast<double>(r) + 0.1 * k;
    frame.ring_center.emplace_back(x, x / 3, 1);
    frame.ring_normal.emplace_back(0, std::sin(x), std::cos(x));
    frame.ring_force.emplace_back(x * x, -x, 0);
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    frame.joint_element.push_back(j > 0 && nodes > 4 && k > 0 ? 3 : 1);
    frame.joint_waypoint.emplace_back(k, static_cast<double>(j) / 3, -k / 7.0);
  }
  std::vector<double> terms;
  for (std::size_t i = 0; i < Energies::names().size(); ++i) {
    terms.push_back((k + 1) / (static_cast<double>(i) + 3));
  }
  frame.energy = Energies::from_values(terms);
  return frame;
}

std::vector<double> probe_row(int row) { return {row / 3.0, std::sqrt(2.0 + row)}; }

Summary small_summary() {
  Summary summary;
  summary.status = "done";
  summary.message = "line one\nline \"two\"";
  summary.case_name = "small";
  summary.host = "host";
  summary.threads = 3;
  summary.steps = 5'000'000'000;
  summary.time_step = 0.1;
  summary.closing_time_step = 0.3;
  summary.joint_steps = 4;
  summary.simulated_seconds = 1.0 / 3;
  summary.wall_seconds = 7.7;
  summary.nodes = 5;
  summary.elements = 4;
  summary.rings = 2;
  summary.stable_step = 5e-324;
  summary.stable_step_limited_by = "thread.closing";
  summary.state_hash = 0x0123456789abcdefULL;
  summary.energy = Energies::from_values({1.0 / 3, 2, 3, 4, 5, 6, 7, 8, 9, -1e-17});
  summary.energy_initial = 1e22 / 7;
  summary.relative_residual = 1e-17 / 3;
  summary.linear_momentum_drift = 1e-16;
  summary.max_penetration = 1e-4;
  summary.stages = {{"elements", 3}, {"rings", 1}};
  summary.events = {{0.25, "ring_contact", "r1"}, {1.0 / 3, "separation", "m1"}};
  summary.ring_records = {{"r1", 0.25, 3, 5, 0.3}, {"r2", -1, 0, 0, -1}};
  summary.history = {{0.3, "node 3 of thread.main", 1.0 / 3}};
  return summary;
}

void record(const fs::path& directory, const ResultModel& model, int frames, bool compress = false,
            const std::function<void(Frame&)>& change = {}) {
  Recorder recorder(directory, model, {.compress = compress});
  for (int k = 0; k < frames; ++k) {
    Frame frame = small_frame(model, k);
    if (change) change(frame);
    recorder.probes(frame.time, probe_row(2 * k));
    recorder.probes(frame.time + 0.01, probe_row(2 * k + 1));
    recorder.frame(frame);
  }
  recorder.finish(small_summary());
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_bits(const Frame& a, const Frame& b) {
  return same_bits(std::vector{a.time}, std::vector{b.time}) && a.step == b.step &&
         same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
         same_bits(a.contact_force, b.contact_force) && same_bits(a.tension, b.tension) &&
         same_bits(a.strain, b.strain) && same_bits(a.active, b.active) &&
         same_bits(a.ring_center, b.ring_center) && same_bits(a.ring_normal, b.ring_normal) &&
         same_bits(a.ring_force, b.ring_force) && same_bits(a.joint_element, b.joint_element) &&
         same_bits(a.joint_waypoint, b.joint_waypoint) && same_bits(a.energy.values(), b.energy.values());
}

TEST(Results, ModelComesBack) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  record(scratch.path / "run", model, 1);
  const ResultModel read = Result(scratch.path / "run").model();
  EXPECT_EQ(read.case_name, model.case_name);
  EXPECT_EQ(read.title, model.title);
  EXPECT_EQ(read.about, model.about);
  EXPECT_EQ(read.case_toml, model.case_toml);
  EXPECT_EQ(read.version, model.version);
  EXPECT_EQ(read.commit, model.commit);
  EXPECT_EQ(read.compiler, model.compiler);
  EXPECT_EQ(read.isa, model.isa);
  EXPECT_EQ(read.threads, model.threads);
  EXPECT_EQ(read.time_step, model.time_step);
  EXPECT_EQ(read.closing_time_step, model.closing_time_step);
  EXPECT_EQ(read.closing_time, model.closing_time);
  EXPECT_EQ(read.elements, model.elements);
  EXPECT_EQ(read.rest_length, model.rest_length);
  EXPECT_EQ(read.element_radius, model.element_radius);
  EXPECT_EQ(read.element_part, model.element_part);
  EXPECT_EQ(read.node_mass, model.node_mass);
}

TEST(Results, PartsAndBodiesComeBack) {
  const Scratch scratch;
  record(scratch.path, small_model(5), 1);
  const ResultModel read = Result(scratch.path).model();
  ASSERT_EQ(read.parts.size(), 2u);
  EXPECT_EQ(read.parts[1].kind, "thread");
  EXPECT_EQ(read.parts[1].name, "closing");
  EXPECT_TRUE(read.parts[1].closing);
  EXPECT_FALSE(read.parts[0].closing);
  ASSERT_EQ(read.rings.size(), 2u);
  EXPECT_EQ(read.rings[1].name, "r2");
  EXPECT_EQ(read.rings[1].radius, 0.06);
  EXPECT_EQ(read.rings[1].wire_radius, 0.003);
  ASSERT_EQ(read.joints.size(), 2u);
  EXPECT_EQ(read.joints[0].part, 1);
  EXPECT_EQ(read.joints[0].ring, 1);
  EXPECT_EQ(read.joints[1].ring, 0);
  ASSERT_EQ(read.balls.size(), 1u);
  EXPECT_EQ(read.balls[0].center, Vec3(1, 2, 1.0 / 3));
  EXPECT_EQ(read.balls[0].radius, 0.75);
  ASSERT_EQ(read.masses.size(), 1u);
  EXPECT_EQ(read.masses[0].name, "m1.launcher");
  EXPECT_EQ(read.masses[0].node, 4);
  EXPECT_EQ(read.masses[0].mass, 0.5);
  ASSERT_EQ(read.probes.size(), 2u);
  EXPECT_EQ(read.probes[1].quantity, "position_z");
  EXPECT_EQ(read.probes[1].of, "net.main");
  EXPECT_EQ(read.probes[1].unit, "m");
}

TEST(Results, FramesComeBackToTheBit) {
  // 60,000 nodes: a frame of positions is larger than a chunk.
  for (const auto& [nodes, compress] : {std::pair{5, false}, {5, true}, {60001, false}, {60001, true}}) {
    const Scratch scratch;
    const ResultModel model = small_model(nodes);
    record(scratch.path, model, 3, compress);
    const Result result(scratch.path);
    ASSERT_EQ(result.frames(), 3);
    for (int k = 2; k >= 0; --k) EXPECT_TRUE(same_bits(result.frame(k), small_frame(model, k))) << k;
    EXPECT_EQ(result.frame_times()[2], 2 / 30.0);
    EXPECT_EQ(result.frame_steps()[2], 2007);
    EXPECT_TRUE(same_bits(result.energies().at(1).values(), small_frame(model, 1).energy.values()));
    EXPECT_THROW(result.frame(3), FileError);
    EXPECT_THROW(result.frame(-1), FileError);
  }
}

TEST(Results, SceneWithoutRingsBallsAndProbes) {
  const Scratch scratch;
  ResultModel model = small_model(3);
  model.rings.clear();
  model.joints.clear();
  model.balls.clear();
  model.masses.clear();
  model.probes.clear();
  model.closing_time.reset();
  {
    Recorder recorder(scratch.path, model, {});
    recorder.probes(0, {});
    recorder.frame(small_frame(model, 0));
    recorder.finish(small_summary());
  }
  const Result result(scratch.path);
  EXPECT_TRUE(same_bits(result.frame(0), small_frame(model, 0)));
  EXPECT_FALSE(result.model().closing_time);
  EXPECT_TRUE(result.probe_times().empty());
  EXPECT_FALSE(fs::exists(scratch.path / "rings.xdmf"));
  EXPECT_FALSE(fs::exists(scratch.path / "ways.xdmf"));
  EXPECT_FALSE(fs::exists(scratch.path / "balls.xdmf"));
}

TEST(Results, ProbesComeBack) {
  const Scratch scratch;
  record(scratch.path, small_model(4), 3);
  const Result result(scratch.path);
  ASSERT_EQ(result.probe_times().size(), 6u);
  EXPECT_EQ(result.probe_times()[5], 2 / 30.0 + 0.01);
  EXPECT_TRUE(result.has_probe("height"));
  EXPECT_FALSE(result.has_probe("width"));
  for (int row = 0; row < 6; ++row) {
    EXPECT_EQ(result.probe("tension_1")[static_cast<std::size_t>(row)], probe_row(row)[0]);
    EXPECT_EQ(result.probe("height")[static_cast<std::size_t>(row)], probe_row(row)[1]);
  }
  try {
    result.probe("width");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("tension_1, height"), std::string::npos) << error.what();
  }
}

TEST(Results, ProbeRowsAfterTheLastFrameAreKept) {
  const Scratch scratch;
  const ResultModel model = small_model(4);
  Recorder recorder(scratch.path, model, {});
  recorder.frame(small_frame(model, 0));
  recorder.probes(1, probe_row(1));
  EXPECT_EQ(Result(scratch.path).probe_times().size(), 0u);
  recorder.finish(small_summary());
  EXPECT_EQ(Result(scratch.path).probe_times(), std::vector<double>{1});
}

TEST(Results, FramesWaitToBeHandedOverTogether) {
  const Scratch scratch;
  const ResultModel model = small_model(40);
  const auto found = [&] { return Result(scratch.path).frames(); };
  {
    Recorder recorder(scratch.path, model, {.patience = 1e6});
    recorder.probes(0, probe_row(0));
    recorder.frame(small_frame(model, 0));
    EXPECT_EQ(found(), 1) << "the first waits for nobody";
    for (int k = 1; k < 4; ++k) {
      recorder.probes(k, probe_row(k));
      recorder.frame(small_frame(model, k));
      recorder.catch_up();
    }
    EXPECT_EQ(found(), 1);
    recorder.sync();
    EXPECT_EQ(found(), 4);
    EXPECT_EQ(Result(scratch.path).probe_times().size(), 4u);
    recorder.frame(small_frame(model, 4));
    EXPECT_EQ(found(), 4);
  }
  const Result result(scratch.path);
  ASSERT_EQ(result.frames(), 5);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(same_bits(result.frame(k), small_frame(model, k))) << k;
}

TEST(Results, FramesThatHaveWaitedLongEnoughAreHandedOver) {
  const Scratch scratch;
  const ResultModel model = small_model(4);
  Recorder recorder(scratch.path, model, {.patience = 0.01});
  for (int k = 0; k < 2; ++k) recorder.frame(small_frame(model, k));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  recorder.catch_up();
  EXPECT_EQ(Result(scratch.path).frames(), 2);
}

TEST(Results, WaitingFramesTakeLittleMemory) {
  const Scratch scratch;
  const ResultModel model = small_model(4000);  // 96 kB of places: every frame goes straight to the file
  Recorder recorder(scratch.path, model, {.patience = 1e6});
  for (int k = 0; k < 3; ++k) recorder.frame(small_frame(model, k));
  recorder.sync();
  const Result result(scratch.path);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(same_bits(result.frame(k), small_frame(model, k))) << k;

  const Scratch other;
  const ResultModel small = small_model(400);  // 9.6 kB: a hundred of them and some make a megabyte
  Recorder patient(other.path, small, {.patience = 1e6});
  for (int k = 0; k < 120; ++k) patient.frame(small_frame(small, k));
  EXPECT_GT(Result(other.path).frames(), 100);
}

TEST(Results, SummaryComesBackToTheBit) {
  Summary summary = small_summary();
  summary.angular_momentum_drift = 2.0 / 3;
  const std::string text = summary_to_json(summary);
  const Summary read = summary_from_json(text, "text");
  EXPECT_EQ(summary_to_json(read), text);
  EXPECT_EQ(read.message, summary.message);
  EXPECT_EQ(read.steps, summary.steps);
  EXPECT_EQ(read.state_hash, summary.state_hash);
  EXPECT_EQ(read.stable_step, summary.stable_step);
  EXPECT_EQ(read.energy.values(), summary.energy.values());
  EXPECT_EQ(read.energy_initial, summary.energy_initial);
  EXPECT_EQ(read.angular_momentum_drift, summary.angular_momentum_drift);
  EXPECT_EQ(read.events.at(1).time, 1.0 / 3);
  ASSERT_EQ(read.history.size(), 1u);
  EXPECT_EQ(read.history[0].node, "node 3 of thread.main");
  EXPECT_EQ(read.ring_records.at(1).first_contact_time, -1);
  EXPECT_FALSE(summary_from_json(summary_to_json(small_summary()), "text").angular_momentum_drift);
}

TEST(Results, SummaryHasTheFieldsOfTheManual) {
  const std::string text = summary_to_json(small_summary());
  for (const char* field :
       {"\"status\": \"done\"", "\"case\": \"small\"", "\"steps\": 5000000000", "\"ring_count\": 2",
        "\"state_hash\": \"0x0123456789abcdef\"", "\"angular_drift\": null", "\"share\": 0.75",
        "\"first_contact_time\": null", "\"kind\": \"separation\"", "\"minutes_per_simulated_second\"",
        "\"relative_residual\"", "\"stable_step_limited_by\": \"thread.closing\"",
        "\"max_penetration\": 0.0001"}) {
    EXPECT_NE(text.find(field), std::string::npos) << field << "\n" << text;
  }
}

TEST(Results, SummaryOfARunThatBlewUp) {
  Summary summary = small_summary();
  summary.energy.kinetic = std::numeric_limits<double>::quiet_NaN();
  summary.max_penetration = std::numeric_limits<double>::infinity();
  summary.message = "bad byte \xff";
  const Summary read = summary_from_json(summary_to_json(summary), "text");
  EXPECT_TRUE(std::isnan(read.energy.kinetic));
  EXPECT_TRUE(std::isnan(read.max_penetration));
  EXPECT_THROW(summary_from_json("{\"status\": \"done\"", "text"), FileError);
  EXPECT_THROW(summary_from_json("{}", "text"), FileError);
}

TEST(Results, SummaryIsInTheResultFileToo) {
  const Scratch scratch;
  record(scratch.path, small_model(4), 1);
  EXPECT_EQ(read_summary(scratch.path / "summary.json").state_hash, 0x0123456789abcdefULL);
  fs::remove(scratch.path / "summary.json");
  const Result result(scratch.path / "run.vtkhdf");
  ASSERT_TRUE(result.summary());
  EXPECT_EQ(result.summary()->events.size(), 2u);
}

TEST(Results, OldRunIsReplacedAndOtherFilesStay) {
  const Scratch scratch;
  record(scratch.path, small_model(4), 3);
  std::ofstream(scratch.path / "notes.txt") << "mine";
  const ResultModel model = small_model(3);
  Recorder recorder(scratch.path, model, {});
  EXPECT_FALSE(fs::exists(scratch.path / "summary.json"));
  for (const char* old : {"run.xdmf", "rings.xdmf", "ways.xdmf", "balls.xdmf"})
    EXPECT_FALSE(fs::exists(scratch.path / old)) << old;
  EXPECT_TRUE(fs::exists(scratch.path / "notes.txt"));
  recorder.frame(small_frame(model, 0));
  const Result result(scratch.path);  // while the recorder is still at work
  EXPECT_EQ(result.frames(), 1);
  EXPECT_FALSE(result.summary());
}

TEST(Results, AnEarlierResultWithoutItsJointsIsRefused) {
  const Scratch scratch;
  ResultModel model = small_model(4);
  model.joints.clear();
  record(scratch.path / "old", model, 1);
  const Result old(scratch.path / "old");
  const std::string error = test::file_error_of([&] {
    Recorder(scratch.path / "new", small_model(4), Recorder::Options{}, {old, 1, 0});
  });
  EXPECT_NE(error.find("holds 0 sliding joints, the case has 2"), std::string::npos) << error;
  EXPECT_FALSE(fs::exists(scratch.path / "new"));
}

TEST(Results, FrameOfTheWrongSizeIsADefect) {
  const Scratch scratch;
  const ResultModel model = small_model(4);
  Recorder recorder(scratch.path, model, {});
  Frame frame = small_frame(model, 0);
  frame.strain.pop_back();
  EXPECT_THROW(recorder.frame(frame), Error);
  for (const auto& drop :
       {+[](Frame& f) { f.joint_element.pop_back(); }, +[](Frame& f) { f.joint_waypoint.pop_back(); }}) {
    frame = small_frame(model, 0);
    drop(frame);
    EXPECT_THROW(recorder.frame(frame), Error);
  }
  EXPECT_THROW(recorder.probes(0, std::vector<double>{1}), Error);
  recorder.frame(small_frame(model, 0));
  EXPECT_EQ(Result(scratch.path).frames(), 1);
}

// ---------------------------------------------------------------------------------------------------------------
// A writer that dies

[[noreturn]] void write_until_killed(const fs::path& directory, const ResultModel& model, double patience) {
  try {
    Recorder recorder(directory, model, {.patience = patience});
    for (int k = 0;; ++k) {
      recorder.probes(k, probe_row(k));
      recorder.frame(small_frame(model, k));
    }
  } catch (...) {
    _exit(1);
  }
}

/// Starts a writer, lets it work for `delay` after its first frame (run.xdmf comes after it), and kills it.
void kill_a_writer(const fs::path& directory, const ResultModel& model, std::chrono::microseconds delay,
                   double patience) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) write_until_killed(directory, model, patience);
  for (int waits = 0; waits < 20'000 && !fs::exists(directory / "run.xdmf"); ++waits) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "the writer ended by itself";
  }
  std::this_thread::sleep_for(delay);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
}

TEST(Results, KilledWriterLeavesWholeFrames) {
  std::mt19937 random(20240607);
  std::uniform_int_distribution<int> delay_us(0, 60'000);
  const ResultModel model = small_model(40);
  int most = 0;
  for (int repetition = 0; repetition < 12; ++repetition) {
    const Scratch scratch;
    const double patience = repetition % 2 == 0 ? 0 : 0.002;  // s
    kill_a_writer(scratch.path, model, std::chrono::microseconds(delay_us(random)), patience);
    if (HasFatalFailure()) return;

    const Result result(scratch.path);
    ASSERT_GE(result.frames(), 1);
    EXPECT_FALSE(result.summary());
    for (int k = 0; k < result.frames(); ++k) {
      ASSERT_TRUE(same_bits(result.frame(k), small_frame(model, k)))
          << "frame " << k << " of " << result.frames();
    }
    const auto height = result.probe("height");
    ASSERT_GE(static_cast<int>(height.size()) + 1,
              result.frames());  // two counters: one may have come through
    for (std::size_t row = 0; row < height.size(); ++row) {
      ASSERT_EQ(height[row], probe_row(static_cast<int>(row))[1]);
    }
    most = std::max(most, result.frames());
  }
  EXPECT_GT(most, 10);  // else every writer died before the interesting part
}

/// Writes until the file may grow no further. Exit status 4: it said so; then the process ends in the normal
/// way.
[[noreturn]] void write_until_full(const fs::path& directory, const ResultModel& model) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{4'000'000, 4'000'000};
  setrlimit(RLIMIT_FSIZE, &limit);
  int status = 1;
  try {
    Recorder recorder(directory, model, {});
    for (int k = 0; k < 5000; ++k) recorder.frame(small_frame(model, k));
  } catch (const FileError& error) {
    status = std::string(error.what()).find("File too large") != std::string::npos ? 4 : 2;
  }
  if (Result(directory).frames() == 0) status = 3;  // a report would read it in the same process
  exit(status);
}

TEST(Results, FullDiskKeepsWhatWasWritten) {
  const Scratch scratch;
  const ResultModel model = small_model(100);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) write_until_full(scratch.path, model);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 4);
  const Result result(scratch.path);
  EXPECT_GT(result.frames(), 10);
  for (int k = 0; k < result.frames(); ++k) {
    ASSERT_TRUE(same_bits(result.frame(k), small_frame(model, k)))
        << "frame " << k << " of " << result.frames();
  }
}

// ---------------------------------------------------------------------------------------------------------------
// What VTK and ParaView see

/// Reads with the HDF5 API alone, so that an error in our own reading cannot hide one in our writing.
struct Hdf5 {
  hid_t file;
  explicit Hdf5(const fs::path& path, unsigned access = H5F_ACC_RDONLY)
      : file(H5Fopen(path.c_str(), access, H5P_DEFAULT)) {}
  ~Hdf5() { H5Fclose(file); }
  template <class T>
  std::vector<T> dataset(const char* name, hid_t type) const {
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Sclose(space);
    H5Dclose(set);
    return values;
  }
  std::vector<std::int64_t> integers(const char* name) const {
    return dataset<std::int64_t>(name, H5T_NATIVE_INT64);
  }
  std::vector<hsize_t> shape(const char* name) const {
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<hsize_t> dims(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, dims.data(), nullptr);
    H5Sclose(space);
    H5Dclose(set);
    return dims;
  }
};

// A writer that was killed may have left less of an array than its counter says.
TEST(Results, FramesAreThoseThatEveryArrayHas) {
  for (const char* name : {layout::kPoints, layout::kTension, layout::kRingForce, layout::kJointElement,
                           layout::kJointWaypoint, "/cinch/energy/kinetic"}) {
    SCOPED_TRACE(name);
    const Scratch scratch;
    record(scratch.path, small_model(5), 3);
    {
      const Hdf5 file(scratch.path / "run.vtkhdf", H5F_ACC_RDWR);
      std::vector<hsize_t> shape = file.shape(name);
      shape[0] -= 1;  // of the last frame
      const hid_t set = H5Dopen2(file.file, name, H5P_DEFAULT);
      EXPECT_GE(H5Dset_extent(set, shape.data()), 0);
      H5Dclose(set);
    }
    EXPECT_EQ(Result(scratch.path).frames(), 2);
  }
}

// A kill while HDF5 splits a full node of an index could hide earlier frames: none is ever full.
TEST(Results, OneIndexNodeHoldsAllChunks) {
  const Scratch scratch;
  const ResultModel model = small_model(300);
  constexpr int frames = 3000;
  {
    Recorder recorder(scratch.path, model, {.frames = frames, .probe_rows = 3 * 100'000});
    for (int k = 0; k < frames; ++k) {
      for (int row = 0; row < 100; ++row) recorder.probes(k + 0.01 * row, probe_row(row));
      recorder.frame(small_frame(model, k));
    }
  }
  const Hdf5 file(scratch.path / "run.vtkhdf");
  for (const char* name :
       {"/VTKHDF/Points", "/VTKHDF/CellData/tension", "/VTKHDF/CellData/active", "/cinch/rings/center",
        "/cinch/joints/element", "/cinch/joints/waypoint", "/cinch/ways/points", "/cinch/ways/tension",
        "/cinch/step", "/cinch/energy/kinetic", "/cinch/probes/values"}) {
    const hid_t set = H5Dopen2(file.file, name, H5P_DEFAULT), space = H5Dget_space(set);
    hsize_t chunks = 0;
    EXPECT_GE(H5Dget_num_chunks(set, space, &chunks), 0) << name;
    H5Sclose(space);
    H5Dclose(set);
    EXPECT_GT(chunks, 0u) << name;
    EXPECT_LE(chunks, 64u) << name;
  }
}

TEST(Results, VtkAttributes) {
  const Scratch scratch;
  record(scratch.path, small_model(5), 3);
  const Hdf5 h5(scratch.path / "run.vtkhdf");
  std::int64_t version[2] = {}, steps = 0;
  hid_t attribute = H5Aopen_by_name(h5.file, "/VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(attribute, H5T_NATIVE_INT64, version);
  H5Aclose(attribute);
  EXPECT_EQ(version[0], 2);
  EXPECT_EQ(version[1], 0);
  attribute = H5Aopen_by_name(h5.file, "/VTKHDF/Steps", "NSteps", H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(attribute, H5T_NATIVE_INT64, &steps);
  H5Aclose(attribute);
  EXPECT_EQ(steps, 3);

  attribute = H5Aopen_by_name(h5.file, "/VTKHDF", "Type", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  char text[32] = {};
  ASSERT_EQ(H5Tget_size(type), std::strlen("UnstructuredGrid"));
  EXPECT_EQ(H5Tis_variable_str(type), 0);
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII);
  H5Aread(attribute, type, text);
  EXPECT_STREQ(text, "UnstructuredGrid");
  H5Tclose(type);
  H5Aclose(attribute);
}

TEST(Results, VtkArrays) {
  const Scratch scratch;
  record(scratch.path, small_model(5), 3);
  const Hdf5 h5(scratch.path / "run.vtkhdf");
  using Integers = std::vector<std::int64_t>;
  using Shape = std::vector<hsize_t>;
  EXPECT_EQ(h5.shape("/VTKHDF/Points"), (Shape{15, 3}));
  EXPECT_EQ(h5.shape("/VTKHDF/PointData/velocity"), (Shape{15, 3}));
  EXPECT_EQ(h5.shape("/VTKHDF/CellData/tension"), (Shape{12}));
  EXPECT_EQ(h5.shape("/VTKHDF/CellData/part"), (Shape{4}));
  EXPECT_EQ(h5.integers("/VTKHDF/Connectivity"), (Integers{1, 0, 2, 1, 3, 2, 4, 3}));
  EXPECT_EQ(h5.integers("/VTKHDF/Offsets"), (Integers{0, 2, 4, 6, 8}));
  EXPECT_EQ(h5.integers("/VTKHDF/Types"), (Integers{3, 3, 3, 3}));
  EXPECT_EQ(h5.integers("/VTKHDF/NumberOfPoints"), Integers{5});
  EXPECT_EQ(h5.integers("/VTKHDF/NumberOfCells"), Integers{4});
  EXPECT_EQ(h5.integers("/VTKHDF/NumberOfConnectivityIds"), Integers{8});
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/PartOffsets"), (Integers{0, 0, 0}));
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/NumberOfParts"), (Integers{1, 1, 1}));
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/PointOffsets"), (Integers{0, 5, 10}));
  EXPECT_EQ(h5.shape("/VTKHDF/Steps/CellOffsets"), (Shape{3, 1}));
  EXPECT_EQ(h5.shape("/VTKHDF/Steps/ConnectivityIdOffsets"), (Shape{3, 1}));
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/CellOffsets"), (Integers{0, 0, 0}));
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/PointDataOffsets/velocity"), (Integers{0, 5, 10}));
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/PointDataOffsets/contact_force"), (Integers{0, 5, 10}));
  for (const char* field : {"tension", "strain", "active"}) {
    const std::string name = std::string("/VTKHDF/Steps/CellDataOffsets/") + field;
    EXPECT_EQ(h5.integers(name.c_str()), (Integers{0, 4, 8})) << field;
  }
  EXPECT_EQ(h5.integers("/VTKHDF/Steps/CellDataOffsets/part"), (Integers{0, 0, 0}));
  EXPECT_EQ(h5.shape("/cinch/rings/center"), (Shape{3, 2, 3}));
}

/// Counts start and end tags, and checks that they nest.
int well_formed_tags(const std::string& xml) {
  std::vector<std::string> open;
  int tags = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    EXPECT_NE(end, std::string::npos);
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag[0] == '?' || tag[0] == '!') continue;
    ++tags;
    if (tag[0] == '/') {
      EXPECT_FALSE(open.empty());
      if (open.empty()) return tags;
      EXPECT_EQ(open.back(), tag.substr(1));
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  EXPECT_TRUE(open.empty());
  return tags;
}

TEST(Results, XdmfSelectsTheRightRows) {
  const Scratch scratch;
  ResultModel model = small_model(5);
  model.case_name = "a <b> & \"c\"";
  record(scratch.path, model, 3);
  const std::string net = read_text_file(scratch.path / "run.xdmf");
  EXPECT_GT(well_formed_tags(net), 30);
  EXPECT_NE(net.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
  EXPECT_NE(net.find("run.vtkhdf:/VTKHDF/Points|10 0:1 1:5 3:15 3<"), std::string::npos);
  EXPECT_NE(net.find("run.vtkhdf:/VTKHDF/PointData/velocity|5 0:1 1:5 3:15 3<"), std::string::npos);
  EXPECT_NE(net.find("run.vtkhdf:/VTKHDF/CellData/tension|8:1:4:12<"), std::string::npos);
  EXPECT_NE(net.find("CollectionType=\"Temporal\""), std::string::npos);
  EXPECT_NE(net.find("<Time Value=\"0.066666666666666666\"/>"), std::string::npos);
  EXPECT_EQ(net.find("HyperSlab"), std::string::npos);  // ParaView's default readers show nothing for it

  const std::string rings = read_text_file(scratch.path / "rings.xdmf");
  EXPECT_GT(well_formed_tags(rings), 20);
  EXPECT_NE(rings.find("run.vtkhdf:/cinch/rings/force|2 0 0:1 1 1:1 2 3:3 2 3<"), std::string::npos);
  EXPECT_GT(well_formed_tags(read_text_file(scratch.path / "balls.xdmf")), 5);

  const std::string ways = read_text_file(scratch.path / "ways.xdmf");
  EXPECT_GT(well_formed_tags(ways), 20);
  EXPECT_NE(ways.find("NumberOfElements=\"4\""), std::string::npos);
  EXPECT_NE(ways.find("run.vtkhdf:/cinch/ways/connectivity<"), std::string::npos);
  EXPECT_NE(ways.find("run.vtkhdf:/cinch/ways/points|10 0:1 1:5 3:15 3<"), std::string::npos);
  EXPECT_NE(ways.find("run.vtkhdf:/cinch/ways/tension|8:1:4:12<"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(scratch.path)) EXPECT_NE(entry.path().extension(), ".tmp");
}

// A thread of three elements between others, with two rings: both in one element, then one beyond it.
TEST(Results, WaysOfSlidingThreadsGoThroughTheirRings) {
  ResultModel model;
  model.elements = {{5, 6}, {0, 1}, {1, 2}, {2, 3}, {6, 7}};
  model.element_part = {0, 1, 1, 1, 2};
  model.joints = {{1, 0}, {1, 1}};
  const Ways ways(model);
  ASSERT_EQ(ways.points(), 6u);
  ASSERT_EQ(ways.segments(), 5u);
  EXPECT_EQ(ways.connectivity(), (std::vector<std::int64_t>{0, 1, 1, 2, 2, 3, 3, 4, 4, 5}));

  Frame frame;
  for (int i = 0; i < 8; ++i) frame.position.emplace_back(i, 0, 0);
  frame.tension = {9, 1, 2, 3, 9};
  frame.active = {0, 1, 1, 0, 0};
  frame.joint_waypoint = {{1.2, 7, 0}, {1.4, 8, 0}};
  frame.joint_element = {2, 2};
  const auto along = [&] {
    std::vector<double> x;
    for (const Vec3& point : ways.trace(frame).points) x.push_back(point.x());
    return x;
  };
  EXPECT_EQ(along(), (std::vector<double>{0, 1, 1.2, 1.4, 2, 3}));
  EXPECT_EQ(ways.trace(frame).tension, (std::vector<double>{1, 2, 2, 2, 3}));
  EXPECT_EQ(ways.trace(frame).active, (std::vector<std::uint8_t>{1, 1, 1, 1, 0}));
  frame.joint_element = {1, 3};
  EXPECT_EQ(along(), (std::vector<double>{0, 1.2, 1, 2, 1.4, 3}));
  EXPECT_EQ(ways.trace(frame).tension, (std::vector<double>{1, 1, 2, 3, 3}));
}

TEST(Results, WaysOfSeveralThreadsDoNotJoin) {
  ResultModel model;
  model.elements = {{0, 1}, {2, 3}};
  model.element_part = {0, 1};
  model.joints = {{0, 0}, {1, 0}};
  EXPECT_EQ(Ways(model).connectivity(), (std::vector<std::int64_t>{0, 1, 1, 2, 3, 4, 4, 5}));
}

// ---------------------------------------------------------------------------------------------------------------
// Comparing, describing, refusing

Comparison compared(const fs::path& a, const fs::path& b) { return compare_results(Result(a), Result(b)); }

TEST(Results, EqualRunsAreIdentical) {
  const Scratch scratch;
  ResultModel model = small_model(5);
  record(scratch.path / "a", model, 3);
  model.threads = 1;
  model.isa = "sse2";
  record(scratch.path / "b", model, 3, true);
  const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
  EXPECT_TRUE(comparison.identical);
  EXPECT_TRUE(comparison.fields.empty());
  EXPECT_TRUE(comparison.shape.empty());
  EXPECT_EQ(comparison.notes.size(), 2u);
  EXPECT_EQ(comparison.frames_compared, 3);
  std::ostringstream text;
  print_comparison(comparison, text);
  EXPECT_EQ(text.str().rfind("identical: 3 frames", 0), 0u) << text.str();
}

TEST(Results, CompareFindsOneUlp) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  record(scratch.path / "a", model, 4);
  record(scratch.path / "b", model, 4, false, [](Frame& frame) {
    if (frame.step == 2007) frame.velocity[3].y() = std::nextafter(frame.velocity[3].y(), 1);
  });
  const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
  EXPECT_FALSE(comparison.identical);
  ASSERT_EQ(comparison.fields.size(), 1u);
  const FieldDifference& field = comparison.fields[0];
  EXPECT_EQ(field.field, "velocity");
  EXPECT_EQ(field.unit, "m/s");
  EXPECT_EQ(field.values, 1u);
  EXPECT_EQ(field.first_frame, 2);
  EXPECT_EQ(field.first_time, 2 / 30.0);
  EXPECT_EQ(field.first_index, 3u);
  EXPECT_EQ(field.absolute, -1.0 - std::nextafter(-1.0, -2) - 1.11022302462515654e-16);
  EXPECT_GT(field.relative, 0);
  std::ostringstream text;
  print_comparison(comparison, text);
  EXPECT_NE(text.str().find("frame 2"), std::string::npos) << text.str();
}

TEST(Results, CompareSeesSignOfZeroAndNan) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  record(scratch.path / "a", model, 2);
  record(scratch.path / "b", model, 2, false, [](Frame& frame) { frame.contact_force[0].x() = 0.0; });
  record(scratch.path / "c", model, 2, false,
         [](Frame& frame) { frame.tension[1] = std::numeric_limits<double>::quiet_NaN(); });
  const Comparison zero = compared(scratch.path / "a", scratch.path / "b");
  EXPECT_FALSE(zero.identical);
  ASSERT_EQ(zero.fields.size(), 1u);
  EXPECT_EQ(zero.fields[0].absolute, 0);
  const Comparison nan = compared(scratch.path / "a", scratch.path / "c");
  ASSERT_EQ(nan.fields.size(), 1u);
  EXPECT_TRUE(std::isinf(nan.fields[0].absolute));
  EXPECT_TRUE(compared(scratch.path / "c", scratch.path / "c").identical);
}

TEST(Results, CompareSeesEveryFieldOfAFrame) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  record(scratch.path / "a", model, 2);
  const std::vector<std::function<void(Frame&)>> changes{[](Frame& f) { f.time += 1e-9; },
                                                         [](Frame& f) { ++f.step; },
                                                         [](Frame& f) { f.position[4].z() += 1; },
                                                         [](Frame& f) { f.velocity[0].x() += 1; },
                                                         [](Frame& f) { f.contact_force[4].z() += 1; },
                                                         [](Frame& f) { f.tension[3] += 1; },
                                                         [](Frame& f) { f.strain[0] += 1; },
                                                         [](Frame& f) { f.active[2] ^= 1; },
                                                         [](Frame& f) { f.ring_center[1].z() += 1; },
                                                         [](Frame& f) { f.ring_normal[1].z() += 1; },
                                                         [](Frame& f) { f.ring_force[1].z() += 1; },
                                                         [](Frame& f) { f.joint_element[1] = 3; },
                                                         [](Frame& f) { f.joint_waypoint[1].y() += 1; },
                                                         [](Frame& f) { f.energy.residual += 1; }};
  for (const auto& change : changes) {
    record(scratch.path / "b", model, 2, false, change);
    const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
    EXPECT_FALSE(comparison.identical);
    EXPECT_GE(comparison.fields.size(), 1u) << &change - changes.data();
  }
}

TEST(Results, CompareSaysWhichShapesDiffer) {
  const Scratch scratch;
  record(scratch.path / "a", small_model(5), 3);
  record(scratch.path / "b", small_model(6), 2);
  const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
  EXPECT_FALSE(comparison.identical);
  std::ostringstream text;
  print_comparison(comparison, text);
  for (const char* sentence :
       {"nodes: 5 in A, 6 in B", "elements: 4 in A, 5 in B", "frames: 3 in A, 2 in B"}) {
    EXPECT_NE(text.str().find(sentence), std::string::npos) << sentence << "\n" << text.str();
  }
}

// Frames of A at 0, 1/30, 2/30 s; of B at other times but for the first and last.
TEST(Results, CompareTakesFramesOfTheSameTime) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  record(scratch.path / "a", model, 3);
  record(scratch.path / "b", model, 3, false, [](Frame& frame) {
    if (frame.step == 1007) frame.time = 0.05, frame.position[0].x() += 5;
  });
  const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
  EXPECT_FALSE(comparison.identical);
  EXPECT_EQ(comparison.frames_compared, 2);
  EXPECT_TRUE(comparison.fields.empty()) << comparison.fields.front().field;
  std::ostringstream text;
  print_comparison(comparison, text);
  EXPECT_NE(text.str().find("frames without partner of the same time: 1 in A, 1 in B"), std::string::npos)
      << text.str();
}

// A finer run: its middle frames have no partner, the others are found all the same.
TEST(Results, CompareFindsPartnersInAFinerRun) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  record(scratch.path / "a", model, 3);
  record(scratch.path / "b", model, 5, false, [](Frame& frame) { frame.time /= 2; });
  const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
  EXPECT_EQ(comparison.frames_compared, 3);
  std::ostringstream text;
  print_comparison(comparison, text);
  EXPECT_NE(text.str().find("frames without partner of the same time: 0 in A, 2 in B"), std::string::npos)
      << text.str();
}

TEST(Results, CompareOfOtherMeshesLeavesNodesOut) {
  const Scratch scratch;
  ResultModel model = small_model(5);
  record(scratch.path / "a", model, 2);
  model = small_model(6);
  std::swap(model.rings[0], model.rings[1]);  // found by name
  record(scratch.path / "b", model, 2, false, [](Frame& frame) {
    std::swap(frame.ring_center[0], frame.ring_center[1]);
    std::swap(frame.ring_normal[0], frame.ring_normal[1]);
    std::swap(frame.ring_force[0], frame.ring_force[1]);
    frame.energy.kinetic += 1;
  });
  const Comparison comparison = compared(scratch.path / "a", scratch.path / "b");
  std::vector<std::string> fields;
  for (const FieldDifference& field : comparison.fields) fields.push_back(field.field);
  EXPECT_EQ(fields, std::vector<std::string>{"energy kinetic"});
  std::ostringstream text;
  print_comparison(comparison, text);
  EXPECT_NE(text.str().find("note: the meshes differ: fields of nodes and elements cannot be compared"),
            std::string::npos)
      << text.str();
}

TEST(Results, CompareKeepsItsColumns) {
  const Scratch scratch;
  ResultModel model = small_model(5);
  model.probes[0].name = std::string(60, 'n');
  for (const char* name : {"a", "b"}) {
    Recorder recorder(scratch.path / name, model, {});
    Frame frame = small_frame(model, 0);
    std::vector<double> row = probe_row(0);
    if (*name == 'b') frame.position[0].x() += 1, row[0] += 1;
    recorder.probes(0, row);
    recorder.frame(frame);
  }
  std::ostringstream text;
  print_comparison(compared(scratch.path / "a", scratch.path / "b"), text);
  std::istringstream lines(text.str());
  std::set<std::size_t> columns;
  for (std::string line; std::getline(lines, line);)
    for (const char* last : {" first differs", " frame 0 (t", " row 0 (t"})
      if (const auto place = line.find(last); place != std::string::npos) columns.insert(place);
  EXPECT_EQ(columns.size(), 1u) << text.str();
}

TEST(Results, CompareSeesOtherEndsOfElements) {
  const Scratch scratch;
  ResultModel model = small_model(5);
  record(scratch.path / "a", model, 1);
  std::swap(model.elements[2][0], model.elements[2][1]);
  record(scratch.path / "b", model, 1);
  std::ostringstream text;
  print_comparison(compared(scratch.path / "a", scratch.path / "b"), text);
  EXPECT_NE(text.str().find("the elements join different nodes"), std::string::npos) << text.str();
}

TEST(Results, CompareSeesHowRunsWentAndEnded) {
  const Scratch scratch;
  const ResultModel model = small_model(3);
  for (const char* name : {"a", "b"}) {
    Recorder recorder(scratch.path / name, model, {});
    recorder.frame(small_frame(model, 0));
    Summary summary = small_summary();
    summary.events = {{0.1, "ring_contact", "r1"},
                      {0.2, *name == 'a' ? "ring_contact" : "mouth_closed", "r2"}};
    if (*name == 'b') summary.status = "failed";
    recorder.finish(summary);
  }
  std::ostringstream text;
  print_comparison(compared(scratch.path / "a", scratch.path / "b"), text);
  for (const char* words :
       {"status: done in A, failed in B", "event 1: ring_contact r2 in A, mouth_closed r2 in B"})
    EXPECT_NE(text.str().find(words), std::string::npos) << words << "\n" << text.str();
}

TEST(Results, CompareSeesTheStateHashAndAMissingEnd) {
  const Scratch scratch;
  const ResultModel model = small_model(3);
  for (const char* name : {"a", "b", "c"}) {
    Recorder recorder(scratch.path / name, model, {});
    recorder.frame(small_frame(model, 0));
    Summary summary = small_summary();
    summary.state_hash += *name == 'b';
    if (*name != 'c') recorder.finish(summary);
  }
  EXPECT_FALSE(compared(scratch.path / "a", scratch.path / "b").identical);
  EXPECT_FALSE(compared(scratch.path / "a", scratch.path / "c").identical);
  EXPECT_TRUE(compared(scratch.path / "c", scratch.path / "c").identical);
}

TEST(Results, InfoNamesWhatIsThere) {
  const Scratch scratch;
  record(scratch.path, small_model(5), 3);
  std::ostringstream text;
  print_info(Result(scratch.path), text);
  for (const char* part : {"small", "0.1.0", "3, t = 0 .. 0.0666666667 s",
                           "5 nodes, 4 elements, 2 rings, 1 balls", "thread.closing", "tension_1", "6 rows",
                           "elements", "75.0 %", "done", "0x0123456789abcdef", "r2: never touched"}) {
    EXPECT_NE(text.str().find(part), std::string::npos) << part << "\n" << text.str();
  }
}

TEST(Results, InfoReadsWell) {
  const Scratch scratch;
  ResultModel model = small_model(5);
  model.probes = {{"all", "energy", "", "J"}};
  Recorder recorder(scratch.path, model, {});
  Summary summary = small_summary();
  summary.status = "failed";
  summary.message = "error: at t = 1 s something broke";
  recorder.finish(summary);
  std::ostringstream text;
  print_info(Result(scratch.path), text);
  for (const char* part :
       {"all: energy, J\n", "sliding joints  forces hold", "failed: at t = 1 s something broke\n"})
    EXPECT_NE(text.str().find(part), std::string::npos) << part << "\n" << text.str();
}

// Nothing tells why there is no end.
// No lock tells of a run there.
TEST(Results, InfoOfARunWithoutItsEnd) {
  const Scratch scratch;
  const ResultModel model = small_model(5);
  Recorder recorder(scratch.path, model, {});
  recorder.frame(small_frame(model, 0));
  std::ostringstream text;
  print_info(Result(scratch.path), text);
  EXPECT_NE(text.str().find("not finished: stopped before its end, as no run on this machine writes to it"),
            std::string::npos)
      << text.str();
}

TEST(Results, KeepsTheIdOfItsRun) {
  const Scratch scratch;
  const ResultModel model = small_model(4);
  {
    Recorder recorder(scratch.path / "a", model, {.run_id = "one"});
    recorder.frame(small_frame(model, 0));
  }
  EXPECT_EQ(Result(scratch.path / "a").run_id(), "one");
  record(scratch.path / "old", model, 1);
  EXPECT_EQ(Result(scratch.path / "old").run_id(), "");
}

TEST(Results, InfoOfARunWithoutFramesAndLedger) {
  const Scratch scratch;
  Recorder recorder(scratch.path, small_model(5), {});
  Summary summary = small_summary();
  summary.relative_residual = std::nan("");
  recorder.finish(summary);
  std::ostringstream text;
  print_info(Result(scratch.path), text);
  EXPECT_TRUE(std::regex_search(text.str(), std::regex("frames +none"))) << text.str();
  EXPECT_NE(text.str().find("no ledger kept"), std::string::npos) << text.str();
}

TEST(Results, ASummaryBesideTheFileStandsInForOneInIt) {
  const Scratch scratch;
  record(scratch.path, small_model(5), 1);
  const hid_t file = H5Fopen((scratch.path / layout::kResultFile).c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, layout::kSummary, H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_EQ(Result(scratch.path).summary()->state_hash, small_summary().state_hash);
}

std::string refusal(const fs::path& path) {
  return test::file_error_of([&] { const Result result(path); });
}

TEST(Results, FilesThatAreNotOursAreRefused) {
  const Scratch scratch;
  EXPECT_NE(refusal(scratch.path / "none").find("no such file"), std::string::npos);
  EXPECT_NE(refusal(scratch.path).find("no run.vtkhdf"), std::string::npos);
  std::ofstream(scratch.path / "text.vtkhdf") << "hello";
  EXPECT_NE(refusal(scratch.path / "text.vtkhdf").find("cannot open it as an HDF5 file"), std::string::npos);
  const fs::path other = scratch.path / "other.vtkhdf";
  H5Fclose(H5Fcreate(other.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_NE(refusal(other).find("not a Cinch result"), std::string::npos) << refusal(other);
  for (const char* name : {"none", "text.vtkhdf", "other.vtkhdf"}) {
    EXPECT_NE(refusal(scratch.path / name).find(name), std::string::npos);
  }
}

template <class T>
void set_first(hid_t file, const char* name, hid_t type, T value) {
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
  std::vector<T> all(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  all.at(0) = value;
  H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data());
  H5Sclose(space);
  H5Dclose(set);
}

// Puts one data set in another's place.
void put(hid_t file, const char* other, const char* name) {
  H5Ldelete(file, name, H5P_DEFAULT);
  H5Lcreate_hard(file, other, file, name, H5P_DEFAULT, H5P_DEFAULT);
}

void set_format_version(hid_t file, int version) {
  const hid_t group = H5Gopen2(file, layout::kCinch, H5P_DEFAULT), space = H5Screate(H5S_SCALAR);
  H5Adelete(group, "format_version");
  const hid_t attribute = H5Acreate2(group, "format_version", H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_INT, &version);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Gclose(group);
}

TEST(Results, WhatDoesNotFitTogetherIsRefused) {
  using Damage = std::function<void(hid_t)>;
  const std::vector<std::pair<std::string, Damage>> damages{
      {"no such node",
       [](hid_t f) { set_first<std::int64_t>(f, layout::kConnectivity, H5T_NATIVE_INT64, -1); }},
      {"no such node",
       [](hid_t f) { set_first<std::int64_t>(f, layout::kConnectivity, H5T_NATIVE_INT64, 5); }},
      {"no such part", [](hid_t f) { set_first<std::int32_t>(f, layout::kPart, H5T_NATIVE_INT32, 2); }},
      {"/cinch/elements/rest_length (unexpected length)",
       [](hid_t f) { put(f, "/cinch/nodes/mass", "/cinch/elements/rest_length"); }},
      {"/cinch/parts/kind (unexpected length)",
       [](hid_t f) { put(f, "/cinch/balls/name", "/cinch/parts/kind"); }},
      {"/cinch/rings/radius", [](hid_t f) { H5Ldelete(f, "/cinch/rings/radius", H5P_DEFAULT); }},
      {"use its joints (no such thread or ring)",
       [](hid_t f) { set_first<std::int32_t>(f, "/cinch/joints/ring", H5T_NATIVE_INT32, 2); }},
      {"use its joints (no such thread or ring)",
       [](hid_t f) { set_first<std::int32_t>(f, "/cinch/joints/part", H5T_NATIVE_INT32, -1); }},
      {"result format 9; this program reads format 1", [](hid_t f) { set_format_version(f, 9); }},
  };
  for (const auto& [words, damage] : damages) {
    SCOPED_TRACE(words);
    const Scratch scratch;
    record(scratch.path, small_model(5), 1);
    ASSERT_EQ(refusal(scratch.path), "");
    const fs::path path = scratch.path / layout::kResultFile;
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    damage(file);
    H5Fclose(file);
    const std::string said = refusal(path);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_EQ(said.find(path.string()), 0u) << said;
  }
}

TEST(Results, AProbeThatIsNotThereIsNamedWithThoseThatAre) {
  const Scratch scratch;
  record(scratch.path, small_model(5), 1);
  try {
    Result(scratch.path).probe("speed");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("no probe column 'speed' (there are: tension_1, height)"),
              std::string::npos)
        << error.what();
  }
}

TEST(Results, ARecorderIsFinishedOnce) {
  const Scratch scratch;
  const ResultModel model = small_model(3);
  Recorder recorder(scratch.path, model, {});
  recorder.frame(small_frame(model, 0));
  recorder.finish(small_summary());
  EXPECT_THROW(recorder.frame(small_frame(model, 1)), Error);
  EXPECT_THROW(recorder.finish(small_summary()), Error);
  EXPECT_EQ(Result(scratch.path).frames(), 1);
}

TEST(Results, TextFilesTellWhyNot) {
  const Scratch scratch;
  const fs::path nowhere = scratch.path / "none" / "page.html";
  EXPECT_EQ(test::file_error_of([&] { read_text_file(nowhere); }),
            nowhere.string() + ": cannot read it: No such file or directory");
  EXPECT_EQ(test::file_error_of([&] { replace_text_file(nowhere, "x"); }),
            nowhere.string() + ".tmp: cannot write it: No such file or directory");
  fs::create_directories(scratch.path / "folder" / "inside");
  EXPECT_NE(test::file_error_of([&] {
              replace_text_file(scratch.path / "folder", "x");
            }).find("cannot replace it: "),
            std::string::npos);
}

TEST(Results, PlaceThatCannotBeWrittenIsNamed) {
  const Scratch scratch;
  std::ofstream(scratch.path / "file") << "in the way";
  try {
    Recorder recorder(scratch.path / "file" / "run", small_model(3), {});
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("file/run"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cinch
