// Includes follow the arrow base -> scene -> input / store -> plan -> study, output -> report -> app and never turn
// back; kernel files stay plain; every source file says what it is for and stays short.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source = fs::path(CINCH_SOURCE_DIR) / "src";

// What the files of a folder may include, besides system headers.
const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> table{
      {"base", {"base"}},
      {"kernels", {"base", "kernels"}},
      {"scene", {"base", "scene"}},
      {"input", {"base", "scene", "input"}},
      {"store", {"base", "kernels", "scene", "store"}},
      {"statics", {"base", "scene", "statics"}},
      {"plan", {"base", "kernels", "scene", "store", "statics", "plan"}},
      {"study", {"base", "scene", "plan", "store", "kernels", "study"}},
      {"output", {"base", "output"}},
      {"report", {"base", "scene", "input", "output", "report"}},
      {"app",
       {"base", "kernels", "scene", "input", "store", "statics", "plan", "study", "output", "report", "app"}},
  };
  return table;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_cpp(const fs::path& file) { return file.extension() == ".hpp" || file.extension() == ".cpp"; }

// All .hpp and .cpp files, by their path under src.
const std::vector<fs::path>& files() {
  static const std::vector<fs::path> list = [] {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(source))
      if (entry.is_regular_file() && is_cpp(entry.path()))
        found.push_back(fs::relative(entry.path(), source));
    std::sort(found.begin(), found.end());
    return found;
  }();
  return list;
}

struct Include {
  std::string path;
  bool system;
};

std::vector<Include> includes_of(const fs::path& file) {
  static const std::regex form(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");
  std::vector<Include> list;
  for (const std::string& line : lines_of(source / file))
    if (std::smatch found; std::regex_search(line, found, form)) list.push_back({found[2], found[1] == "<"});
  return list;
}

// Why `file` may not include `include`, or nothing.
std::string complaint(const fs::path& file, const Include& include) {
  if (include.system) return "";
  const std::string from = file.begin()->string(), to = fs::path(include.path).begin()->string();
  const std::string words = file.string() + " includes \"" + include.path + "\": ";
  if (!allowed().contains(from)) return words + "the folder src/" + from + " has no row in the table";
  if (!allowed().contains(to)) return words + "not by its folder";
  if (include.path == "output/result.hpp") return words + "plain results live in base/result.hpp";
  return allowed().at(from).contains(to) ? "" : words + from + " may not know " + to;
}

TEST(Layers, SourcesAreThere) { EXPECT_GT(files().size(), 80u) << source; }

TEST(Layers, IncludesNeverTurnBack) {
  for (const fs::path& file : files())
    for (const Include& include : includes_of(file)) EXPECT_EQ(complaint(file, include), "");
}

TEST(Layers, TheTableIsAnArrow) {  // every folder stands after those that it knows
  const std::vector<std::string> order{"base", "kernels", "scene",  "input",  "store", "statics",
                                       "plan", "study",   "output", "report", "app"};
  const auto rank = [&](const std::string& name) {
    return std::find(order.begin(), order.end(), name) - order.begin();
  };
  for (const auto& [from, folders] : allowed())
    for (const std::string& to : folders) EXPECT_LE(rank(to), rank(from)) << from << " -> " << to;
}

TEST(Layers, TheCheckSeesAStep) {
  EXPECT_NE(complaint("store/model.cpp", {"plan/stepper.hpp", false}), "");
  EXPECT_NE(complaint("plan/ledger.hpp", {"output/result.hpp", false}), "");
  EXPECT_NE(complaint("app/run.cpp", {"output/result.hpp", false}), "");
  EXPECT_NE(complaint("plan/ledger.hpp", {"ledger.hpp", false}), "");
  EXPECT_NE(complaint("report/page.cpp", {"plan/simulation.hpp", false}), "");
  EXPECT_NE(complaint("fresh/page.cpp", {"base/index.hpp", false}), "");
  EXPECT_EQ(complaint("plan/ledger.hpp", {"store/model.hpp", false}), "");
  EXPECT_EQ(complaint("plan/ledger.hpp", {"vector", true}), "");
}

TEST(Layers, KernelFilesArePlain) {
  const std::set<std::string> system_headers{"cmath", "cstddef", "immintrin.h"};
  for (const fs::path& file : files()) {
    // the table of function pointers chooses the instruction set once; it is no kernel
    if (*file.begin() != "kernels" || file == "kernels/kernel_table.cpp") continue;
    for (const Include& include : includes_of(file)) {
      const bool plain = include.system
                             ? system_headers.contains(include.path)
                             : include.path.starts_with("kernels/") || include.path == "base/index.hpp";
      EXPECT_TRUE(plain) << file << " includes " << include.path;
    }
    for (const std::string& line : lines_of(source / file)) {
      EXPECT_EQ(line.find("std::vector"), std::string::npos) << file << ": " << line;
      EXPECT_EQ(line.find("Eigen"), std::string::npos) << file << ": " << line;
      EXPECT_EQ(line.find("#pragma omp parallel"), std::string::npos) << file << ": " << line;
    }
  }
}

bool begins_with_comment(const fs::path& file) {
  const std::vector<std::string> lines = lines_of(file);
  return !lines.empty() && lines.front().starts_with("// ") && lines.front().size() > 20;
}

TEST(Layers, EveryFileStatesItsPurpose) {
  for (const fs::path& file : files()) {
    const fs::path full = source / file, header = fs::path(full).replace_extension(".hpp");
    EXPECT_TRUE(begins_with_comment(full) ||
                (full.extension() == ".cpp" && fs::exists(header) && begins_with_comment(header)))
        << file << " says nowhere what it is for";
  }
}

TEST(Layers, NoFileIsLong) {
  for (const fs::path& file : files()) EXPECT_LE(lines_of(source / file).size(), 600u) << file;
}

}  // namespace
