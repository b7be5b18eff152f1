// Case files that are meant to break the reader: too large, too deep, of the wrong type, of the wrong bytes.
// Each is refused by an error that names the place, or read to the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "input/key_table.hpp"
#include "plan/preparation.hpp"
#include "scene/extent.hpp"

namespace cinch {
namespace {

namespace fs = std::filesystem;

const std::string head =
    "schema = 1\n[time]\nend_s = 1\n[material.m]\nyoungs_modulus_Pa = 1e9\ndensity_kg_m3 = 970\n";
const std::string thread = "[thread.t]\nmaterial = \"m\"\ndiameter_m = 0.002\n";
const std::string straight = "points_m = [[0, 0, 0], [1, 0, 0]]\n";
const std::string net = "[net.n]\nmaterial = \"m\"\ndiameter_m = 0.002\n";
const std::string ring_body =
    "diameter_m = 0.02\nwire_diameter_m = 0.004\nmass_kg = 0.01\nyoungs_modulus_Pa = 70e9\n";
const std::string minimal = head + thread + "elements = 10\n" + straight;

// What is said of a text, by the reader or on the way to its step; "" for a case that can be run.
std::string error_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    prepare(parse_case(text, "h.toml", overrides));
  } catch (const CaseError& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// Refused with all pieces in the error. What hangs ends by the time limit that ctest gives each test.
void expect_refused(const std::string& text, const std::vector<std::string>& pieces) {
  const std::string error = error_of(text);
  EXPECT_LT(error.size(), 50000u);
  for (const std::string& piece : pieces)
    EXPECT_TRUE(has(error, piece)) << "missing: " << piece << "\nin: " << error;
}

std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  text.reserve(piece.size() * count);
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

// ----------------------------------------------------------------------------------------------------
// Too many

TEST(HostileCases, ATrillionNodes) {
  expect_refused(
      head + net + "size_m = [1e5, 1e5]\nmesh_m = 0.1\n",
      {"h.toml:11:10: error: net.n.mesh_m: found 0.1, which makes 1e+12 meshes, allowed: <= 1e+08"});
  expect_refused(head + net + "size_m = [1e5, 1e5]\nmesh_m = 5e-324\n",
                 {"h.toml:11:10: error: net.n.mesh_m"});
  expect_refused(head + net + "size_m = [60000, 60000]\nmesh_m = 1\n", {"makes 3.6e+09 meshes"});
  expect_refused(
      head + net + "size_m = [1000, 1000]\nmesh_m = 1\nelements_per_side = 10000\n",
      {"h.toml:11:10: error: net.n.mesh_m: found 1, which makes 1e+06 meshes", "over elements_per_side"});
  expect_refused(head + net + "size_m = [60000, 60000]\nmesh_m = 1\nelements_per_side = 60000\n",
                 {"h.toml:12:21: error: net.n.elements_per_side: found 60000", "<= 10000"});
  expect_refused(head + thread + "elements = 1000000000000\n" + straight,
                 {"h.toml:10:12: error: thread.t.elements: found 1000000000000", "<= 100000000"});
  expect_refused(
      minimal + net + "size_m = [1, 1]\nmesh_m = 1\n[mechanism.m]\ntowing_elements = 1000000000000\n",
      {"towing_elements: found 1000000000000"});
}

TEST(HostileCases, ManyLargePartsTogether) {
  std::string text = head;
  for (const char* name : {"a", "b", "c"})
    text += "[thread." + std::string(name) +
            "]\nmaterial = \"m\"\ndiameter_m = 1e-3\nelements = 100000000\n" + straight;
  expect_refused(text, {"h.toml:7:9: error: the case has 300000000 elements", "allowed: <= 2e+08"});
}

TEST(HostileCases, TooLargeForTheMachineIsRefusedBeforeItIsMade) {
  const Scene scene = parse_case(
      head + net + "size_m = [5000, 5000]\nmesh_m = 1\n" + thread + "elements = 7\n" + straight, "h.toml");
  const Extent extent = extent_of(scene);
  EXPECT_EQ(extent.elements, 2 * 5000 * 5001 + 7);
  EXPECT_EQ(extent.nodes, 5001 * 5001 + 8);
  EXPECT_EQ(extent.largest.text, "h.toml:7:6");
  EXPECT_NO_THROW(require_room(extent, std::size_t{64} << 30));
  try {
    require_room(extent, std::size_t{4} << 30);
    ADD_FAILURE() << "75 million nodes and elements in 4 GiB";
  } catch (const CaseError& error) {
    EXPECT_STREQ(
        error.what(),
        "h.toml:7:6: error: the scene has 25010009 nodes and 50010007 elements, allowed: 35791394 in all, as "
        "this machine has 4.29 GB of memory (this part has most of them)");
  }
}

TEST(HostileCases, NodesOfANetAreCountedAsTheyAreMade) {
  for (const char* meshes :
       {"size_m = [3, 2]\nmesh_m = 1\n", "size_m = [3, 2]\nmesh_m = 1\nelements_per_side = 4\n"}) {
    const Scene scene = parse_case(head + net + meshes, "h.toml");
    const Assembly made = assemble(scene);
    EXPECT_EQ(extent_of(scene).nodes, static_cast<std::int64_t>(made.nodes.size()));
    EXPECT_EQ(extent_of(scene).elements, static_cast<std::int64_t>(made.elements.size()));
  }
}

TEST(HostileCases, TooManyRings) {
  const std::string wide = head + net + "size_m = [1e5, 1]\nmesh_m = 1\n[rings.r]\nnet = \"n\"\n" + ring_body;
  expect_refused(
      wide, {"h.toml:12:8: error: rings.r.cells: with them the case has 200002 rings, allowed: <= 100000"});
  expect_refused(wide + "cells = [100000000]\n",
                 {"rings.r.cells: found 100000000, allowed: 1 to 100000 on net.n.top"});
  expect_refused(head + net +
                     "size_m = [1, 1]\nmesh_m = 1\nelements_per_side = 10000\n[rings.r]\nnet = \"n\"\n" +
                     "cells = [100000000]\n" + ring_body,
                 {"rings.r.cells: found 100000000, allowed: 1 to 1 on net.n.top"});
}

TEST(HostileCases, TooManyParts) {
  std::string parts = head;
  for (int i = 0; i < 30000; ++i) parts += "[thread.t" + std::to_string(i) + "]\n";
  expect_refused(parts, {"h.toml:20007:9: error: the case has 30000 [thread.NAME], allowed: <= 20000"});
  std::string nodes = head + thread + "elements = 1000000\n" + straight + "[thread.t.node]\n";
  for (int i = 1; i <= 110000; ++i) nodes += std::to_string(i) + " = {}\n";
  const std::string error = error_of(nodes);
  EXPECT_TRUE(has(error, "the case has more than 100000 parts and nodes")) << error;
}

TEST(HostileCases, AThousandErrorsAreEnough) {
  std::string keys = minimal;
  for (int i = 0; i < 100000; ++i) keys += "k" + std::to_string(i) + " = 1\n";
  expect_refused(keys, {"h.toml:12:1: error: unknown key 'thread.t.k0'",
                        "h.toml: error: 980 more or many more: reading stopped there"});
}

// ----------------------------------------------------------------------------------------------------
// Numbers beyond sense

TEST(HostileCases, NumbersThatAreNone) {
  for (const std::string number : {"1e308", "-1e308", "nan", "inf", "-inf", "9223372036854775807"}) {
    SCOPED_TRACE(number);
    expect_refused("schema = 1\n[time]\nend_s = " + number + "\n", {"h.toml:3:9: error: "});
    expect_refused(head + net + "size_m = [" + number + ", 1]\nmesh_m = 1\n", {"h.toml:10:11: error: "});
    expect_refused(head + thread + "elements = 1\npoints_m = [[0, 0, 0], [0, " + number + ", 0]]\n",
                   {"h.toml:11:28: error: "});
  }
  for (const char* number :
       {"1e999", "99999999999999999999", "0x", "1_", "1.", ".5", "01", "1e", "--1", "+", "0b2"}) {
    SCOPED_TRACE(number);
    expect_refused("schema = 1\n[time]\nend_s = " + std::string(number) + "\n", {"h.toml:3:"});
  }
}

TEST(HostileCases, ConstantsThatVanishOrOverflow) {
  const std::string material = "schema = 1\n[time]\nend_s = 1\n[material.m]\n";
  const std::string soft = "youngs_modulus_Pa = 1e-300\ndensity_kg_m3 = 970\n",
                    none = "damping_rule = \"stiffness\"\n";
  const std::string rest = thread + "elements = 1\n" + straight;
  expect_refused(material + soft + rest,
                 {"h.toml:7:9: error: elements of length 1 m", "allowed: 1e-60 to 1e60 each"});
  expect_refused(material + "youngs_modulus_Pa = 1\ndensity_kg_m3 = 1e-300\n" + rest,
                 {"h.toml:7:9: error: "});
  expect_refused(material + "youngs_modulus_Pa = 1\ndensity_kg_m3 = 1\n" + none +
                     "damping_frequency_rad_s = 1e-300\n" + rest,
                 {"h.toml:9:9: error: ", "damping"});
  expect_refused(minimal + "length_m = 1e-305\n", {"h.toml:7:9: error: elements of length 1e-306 m"});
  expect_refused(head + "[thread.t]\nmaterial = \"m\"\ndiameter_m = 1e-200\nelements = 1\n" + straight,
                 {"h.toml:7:9: error: ", "stiffness 0 N/m"});
  expect_refused(minimal + "[ring.r]\ncenter_m = [0, 0, 9]\nnormal = [0, 0, 1]\n" + "diameter_m = 0.02\n" +
                     "wire_diameter_m = 0.004\nmass_kg = 1e-320\nyoungs_modulus_Pa = 70e9\n",
                 {"h.toml:17:11: error: ring.r.mass_kg", ">= 1e-12"});
}

TEST(HostileCases, PointsTooCloseToTellApart) {
  const std::string lone = head + thread + "elements = 2\n";
  expect_refused(lone + "points_m = [[0, 0, 0], [1e-200, 0, 0], [1, 0, 0]]\n",
                 {"h.toml:11:24: error: ", "points that differ"});
  expect_refused(lone + "points_m = [[0, 0, 0], [1e6, 0, 0], [1e6, 1e-20, 0]]\n",
                 {"h.toml:7:9: error: thread 't': points 2 and 3 of points_m are too close to each other"});
}

TEST(HostileCases, StepsBeyondCounting) {
  expect_refused(head + "damping_rule = \"stiffness\"\ndamping_frequency_rad_s = 1e-12\n" + thread +
                     "elements = 1\n" + straight,
                 {"h.toml:2:2: error: the stable step is ", "limited by element 0 of thread.t",
                  "allowed: at most 1e+12"});
}

// ----------------------------------------------------------------------------------------------------
// Wrong types

// The least that a section must hold for its keys to be looked at, by its name.
std::string section_header(const SectionInfo& section) {
  if (section.name == "node") return "[thread.t.start]\n";
  return "[" + section.name + (section.named ? ".x" : "") + "]\n";
}

// Values of every type; a key is asked for those that its own type is not.
const std::vector<std::pair<std::string, std::vector<KeyType>>>& values_and_takers() {
  using enum KeyType;
  static const std::vector<std::pair<std::string, std::vector<KeyType>>> rows = {
      {"\"some text\"", {text, name}},
      {"7", {number, whole}},
      {"7.5", {number}},
      {"true", {flag}},
      {"1979-05-27", {}},
      {"07:32:00", {}},
      {"[]", {names}},
      {"[1, 2]", {pair, wholes}},
      {"[1, 2, 3]", {vector, wholes}},
      {"[[1, 2, 3], [4, 5, 6]]", {points}},
      {"[[1, 2], [4, 5]]", {}},
      {"[true]", {}},
      {"[\"a\", 1]", {}},
      {"[{ a = 1 }]", {}},
      {"{ a = 1 }", {node, nodes}},
      {"[[[[1]]]]", {}},
      {"nan", {}},
  };
  return rows;
}

TEST(HostileCases, EveryKeyRefusesEveryWrongType) {
  int tried = 0;
  for (const SectionInfo* section : all_sections())
    for (const KeyInfo& key : section->keys) {
      // keys that need company get it, whatever its value
      const std::string company = key.only_with.empty() ? "" : key.only_with + " = 1\n";
      for (const auto& [value, takers] : values_and_takers()) {
        if (std::find(takers.begin(), takers.end(), key.type) != takers.end()) continue;
        const std::string text = (section->name == "node" ? minimal : "schema = 1\n") +
                                 section_header(*section) + company + key.name + " = " + value + "\n";
        const std::string error = error_of(text),
                          place =
                              "h.toml:" + std::to_string(std::count(text.begin(), text.end(), '\n')) + ":";
        ++tried;
        EXPECT_TRUE(has(error, place) && has(error, "." + key.name + ": found ") && has(error, "allowed: "))
            << text << "\n"
            << error;
      }
    }
  EXPECT_GT(tried, 1000);
}

TEST(HostileCases, EverySectionRefusesWhatIsNoTable) {
  for (const SectionInfo* section : all_sections()) {
    if (section->name == "node") continue;
    for (const char* value : {"1", "\"a\"", "[]", "[[1]]", "true", "nan", "1979-05-27"}) {
      expect_refused("schema = 1\n" + section->name + " = " + value + "\n",
                     {"h.toml:2:", "error: '" + section->name + "': found ", "allowed: a section ["});
      if (section->named)
        expect_refused("schema = 1\n" + section->name + ".x = " + value + "\n",
                       {"h.toml:2:", "error: '" + section->name + ".x': found "});
    }
  }
}

// ----------------------------------------------------------------------------------------------------
// Wrong bytes, wrong structure

TEST(HostileCases, DeepNesting) {
  expect_refused("schema = 1\nx = " + std::string(100000, '[') + std::string(100000, ']') + "\n",
                 {"h.toml:2:"});
  expect_refused("schema = 1\nx = " + repeated("{a=", 100000) + "1" + std::string(100000, '}') + "\n",
                 {"h.toml:2:"});
  expect_refused("schema = 1\n[a" + repeated(".a", 100000) + "]\n", {"h.toml:2:", "more than 32 parts"});
  expect_refused("schema = 1\na" + repeated(" . a", 100000) + " = 1\n", {"h.toml:2:", "more than 32 parts"});
  // as deep as both bounds together allow
  const std::string dotted = "{a" + repeated(".a", 31) + "=";
  expect_refused("schema = 1\nx = " + repeated(dotted, 255) + "1" + std::string(255, '}') + "\n",
                 {"h.toml:2:"});
  expect_refused("schema = 1\n[a" + repeated(".a", 31) + "]\nx = " + repeated(dotted, 250) + "1" +
                     std::string(250, '}') + "\n",
                 {"h.toml:2:"});
}

TEST(HostileCases, BytesThatAreNoText) {
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  expect_refused(all, {"h.toml:1:1: error: the file contains a NUL byte"});
  expect_refused(std::string("\x7f"
                             "ELF\x02\x01\x01\0\0\0",
                             10),
                 {"h.toml:1:"});
  expect_refused(std::string(1000, '\0'), {"h.toml:1:1: error: "});
  expect_refused(minimal + "# \0 in a comment" + std::string(1, '\0'), {"h.toml:12:", "NUL"});
  for (const char* bytes :
       {"\xff\xfe", "\xc3\x28", "\xe2\x82", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80", "\xc0\xaf"}) {
    expect_refused("schema = 1\n[case]\ntitle = \"" + std::string(bytes) + "\"\n",
                   {"h.toml:3:10: error: only ASCII characters are allowed outside of comments"});
    EXPECT_EQ(error_of(minimal + "# " + bytes + "\n"), "") << "any byte may stand in a comment";
  }
  expect_refused("\xff\xfes\0c\0h\0", {"h.toml:1:1: error: "});  // UTF-16
  for (const char* code : {"\\uD800", "\\uDFFF", "\\U00110000", "\\uZZZZ", "\\x41", "\\u12"})
    expect_refused("schema = 1\n[case]\ntitle = \"" + std::string(code) + "\"\n", {"h.toml:3:"});
}

TEST(HostileCases, ErrorsShowNoControlCharacters) {
  const std::string error =
      error_of(head + "[thread.t]\nmaterial = \"\\u001b[2Jm\\n\\u0000\\u007f\"\nx = 1 \x1b[31m\n");
  EXPECT_TRUE(has(error, "error: ")) << error;
  const std::string name =
      error_of(minimal + "[ring.r]\nthreads = [\"\\u001b[2J\\nh.toml:1:1: error: \"]\n" + ring_body);
  EXPECT_TRUE(has(name, "unknown thread '?[2J?h.toml")) << name;
  for (const std::string& text : {error, name})
    for (const char c : text) EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f));
}

// Of what is quoted, too: bytes beyond ASCII that are no text, and control characters there.
TEST(HostileCases, QuotedLinesShowTextAlone) {
  const auto quoted = [](const std::string& bytes) {
    const std::string error = error_of("x = 1 # <" + bytes + ">\n" + minimal);
    const std::size_t begin = error.find('<');
    return error.substr(begin, error.find('>') - begin + 1);
  };
  for (const char* text : {"\xc3\xa4", "\xe2\x82\xac", "\xf0\x9f\x90\x9f", "\xc2\xa0"})
    EXPECT_EQ(quoted(text), "<" + std::string(text) + ">");
  for (const char* two : {"\xff\xfe", "\xc2\x9b", "\xe2\x82", "\xc0\xaf", "\x9b\x80", "\x1b\x9d"})
    EXPECT_EQ(quoted(two), "<?\?>") << two;
  EXPECT_EQ(quoted("\xc3("), "<?(>");
  EXPECT_EQ(quoted("\xe0\x82\x9b"), "<?\?\?>");  // U+009B in three bytes
}

TEST(HostileCases, LineEndsAndByteOrderMark) {
  std::string crlf;
  for (const char c : minimal) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(error_of(crlf), "");
  EXPECT_EQ(error_of("\xEF\xBB\xBF" + crlf), "");
  expect_refused(crlf + "x = 1\r\n", {"h.toml:12:1: error: unknown key 'thread.t.x'", "    x = 1\n    ^"});
  expect_refused("schema = 1\r[time]\rend_s = 1\r", {"h.toml:1:"});
  expect_refused("", {"h.toml:1:1: error: missing key 'schema'"});
  expect_refused("\xEF\xBB\xBF", {"h.toml:1:1: error: missing key 'schema'"});
  expect_refused(" \n\t\n#", {"h.toml:1:1: error: missing key 'schema'"});
}

TEST(HostileCases, StringsThatDoNotEnd) {
  for (const char* start : {"\"", "'", "\"\"\"", "'''", "\"\\", "\"\"\"a\n\nb\"\""})
    expect_refused("schema = 1\n[case]\ntitle = " + std::string(start), {"error: Error while parsing"});
  for (const char* start : {"[", "[1,", "{", "{ a = ", "{ a = 1,"})
    expect_refused("schema = 1\n[case]\ntitle = " + std::string(start), {"error: Error while parsing"});
}

TEST(HostileCases, SaidTwice) {
  expect_refused(minimal + "elements = 10\n", {"h.toml:12:", "error: "});
  expect_refused(minimal + "[thread.t]\n", {"h.toml:12:", "error: "});
  expect_refused(minimal + "[time]\n", {"h.toml:12:", "error: "});
  expect_refused(minimal + "[[thread.t]]\n", {"h.toml:12:", "error: "});
  expect_refused(minimal + "start = {}\n[thread.t.start]\n", {"h.toml:13:", "error: "});
  expect_refused(minimal + "points_m.x = 1\n", {"h.toml:12:", "error: "});
  expect_refused("schema = 1\nschema = 1\n", {"h.toml:2:", "error: "});
}

TEST(HostileCases, LongLinesAndNames) {
  const std::string name(1000000, 'n');
  expect_refused(head + "[thread." + name + "]\nx = 1\n",
                 {"h.toml:7:", "a key or name of more than 100 characters"});
  expect_refused(minimal + name + " = 1\n",
                 {"h.toml:12:1: error: a key or name of more than 100 characters"});
  expect_refused(minimal + "\"" + name + "\" = 1\n", {"h.toml:12:1: error: "});
  expect_refused(minimal + "[ring.r]\nthreads = [\"" + name + "\"]\n" + ring_body, {"h.toml:13:12: error: "});
  expect_refused(minimal + "velocity_m_s = [" + std::string(1000000, ' ') + "1, 2]\n",
                 {"h.toml:12:16: error: "});
  EXPECT_EQ(error_of(minimal + "[case]\ntitle = \"" + name + "\"\n"), "") << "text may be long";
  EXPECT_EQ(error_of(minimal + "#" + name + "\n"), "");
  expect_refused(minimal + "velocity_m_s = [" + repeated("1, ", 100000) + "]\n",
                 {"h.toml:12:16: error: ", "(array of 100000)"});
}

TEST(HostileCases, FilesThatAreNone) {
  const fs::path folder = fs::temp_directory_path() / "cinch_hostile";
  fs::create_directories(folder);
  const auto error_in = [](const fs::path& file) -> std::string {
    try {
      read_case(file);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_in(folder), folder.string() + ": error: is a directory");
  EXPECT_TRUE(has(error_in(folder / "none.toml"), "none.toml: error: the case file cannot be opened"));
  std::ofstream(folder / "empty.toml");
  EXPECT_TRUE(has(error_in(folder / "empty.toml"), "empty.toml:1:1: error: missing key 'schema'"));
  std::ofstream(folder / "large.toml");
  fs::resize_file(folder / "large.toml", 100000000);
  EXPECT_TRUE(has(error_in(folder / "large.toml"), "large.toml: error: the file is larger than 4 MiB"));
  EXPECT_TRUE(has(error_in("/dev/zero"), "/dev/zero: error: the file is larger than 4 MiB"));
  fs::remove_all(folder);
}

// ----------------------------------------------------------------------------------------------------
// What the fuzz target asks of cases that parse

TEST(HostileCases, EscapedCharactersSurviveResolving) {
  const Scene scene = parse_case(
      minimal + "[case]\ntitle = \"\\u00b5 \\u20AC \\U0001F600 \\u0000\\u001b\\\\ \\\"\"\n", "h.toml");
  EXPECT_TRUE(has(scene.resolved_toml, "title = \"\\u00B5 \\u20AC \\U0001F600 \\u0000\\u001B\\\\ \\\"\""))
      << scene.resolved_toml;
  const Scene again = parse_case(scene.resolved_toml, "h.toml");
  EXPECT_EQ(again.title, scene.title);
  EXPECT_EQ(again.resolved_toml, scene.resolved_toml);
}

TEST(HostileCases, AThreadThatHangsOnItself) {
  for (const char* on : {"start", "end", "node.0", "node.5"})
    expect_refused(minimal + "start = { on = \"thread.t." + std::string(on) + "\" }\n",
                   {"h.toml:12:1: error: ", "there is no node 'thread.t." + std::string(on) + "'"});
}

TEST(HostileCases, AClosingTimeThatNeverComes) {
  const Preparation p =
      prepare(parse_case("schema = 1\n[time]\nend_s = 1e-11\nstep_s = 1e-20\n[closing]\ntime_s = 1e6\n" +
                             head.substr(head.find("[material")) + net + "size_m = [1, 1]\nmesh_m = 1\n" +
                             thread + "elements = 2\nalong = [\"net.n.top\"]\n",
                         "h.toml"));
  EXPECT_EQ(p.end_step, 1000000000);
  EXPECT_GT(p.closing_step, p.end_step);
}

}  // namespace
}  // namespace cinch
