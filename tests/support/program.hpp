// The program itself, driven as a user drives it, in a folder of its own.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cinch::test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Json = nlohmann::json;

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// A thread with a ring beside it: quick, with contact from step 100 on.
inline const char* const tiny_case = R"(schema = 1
[case]
title = "Tiny"
[time]
end_s = 0.001
step_s = 1e-6
[output]
frame_interval_s = 1e-4
probe_interval_s = 5e-5
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.002
elements = 100
points_m = [[0, -0.1, 0], [0, 0.4, 0]]
velocity_m_s = [0, 0, -1]
start = { mass_kg = 0.1 }
end = { support = "fixed" }
[ring.r1]
joint = "contact"
diameter_m = 0.02
wire_diameter_m = 0.004
mass_kg = 0.1
youngs_modulus_Pa = 70e9
center_m = [0, 0, 0.0069]
normal = [0, 1, 0]
support = "guided"
axis = [0, 1, 0]
[probe.force]
quantity = "force"
of = "ring.r1"
)";

// Minutes of work, the ring out of the way.
inline const Words endless{"run",   "tiny.toml",
                           "--set", "time.end_s=100",
                           "--set", "output.frame_interval_s=0.01",
                           "--set", "ring.r1.center_m=[1, 0, 0]",
                           "--out", "r"};

class Program : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cinch_program_" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("tiny.toml", tiny_case);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

  // Starts the program in the test's folder; its output goes to the files "out" and "err" there.
  // `before`: what the shell does first.
  pid_t start(const Words& words, const std::string& before = "") const {
    Words all{"sh", "-c", before + "cd \"$0\" && exec \"$@\"", folder_.string(), CINCH_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> arguments;
    for (std::string& word : all) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, path("out").c_str(), flags, 0644);
    posix_spawn_file_actions_addopen(&files, 2, path("err").c_str(), flags, 0644);
    // the tests themselves may run in the background, with signals ignored
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaddset(&usual, signal);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t child = -1;
    EXPECT_EQ(posix_spawn(&child, "/bin/sh", &files, &attributes, arguments.data(), environ), 0);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return child;
  }

  static int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status); }
  static int wait_for(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return code_of(status);
  }

  int run(const Words& words, const std::string& before = "") const { return wait_for(start(words, before)); }
  std::string out() const { return text_of(path("out")); }
  std::string err() const { return text_of(path("err")); }
  Json summary(const std::string& name) const { return Json::parse(text_of(path(name) / "summary.json")); }

  // Changes one line of the tiny case.
  std::string with(const std::string& line, const std::string& other) const {
    std::string text = tiny_case;
    const auto found = text.find(line);
    EXPECT_NE(found, std::string::npos);
    return text.replace(found, line.size(), other);
  }

 private:
  fs::path folder_;
};

}  // namespace cinch::test
