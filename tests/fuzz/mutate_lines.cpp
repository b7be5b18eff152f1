// What a user may do to a case by mistake, or on purpose, with whole lines and values: bytes changed at
// random seldom leave a case that parses.
#include "mutate_lines.hpp"

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using Random = std::minstd_rand;

constexpr std::size_t most_sound_cases = 256;
constexpr std::size_t kept = 16;  // the first of them, the seeds, stay: the others drift away

std::vector<std::string>& sound_cases() {
  static std::vector<std::string> cases;
  return cases;
}

const std::vector<std::string> values = {
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "1e-300",
    "1e-200",
    "1e-20",
    "1e-12",
    "1e6",
    "1e12",
    "1e308",
    "nan",
    "inf",
    "100000000",
    "9223372036854775807",
    "0.5",
    "true",
    "false",
    "[]",
    "{}",
    "\"\"",
    "\"auto\"",
    "\"all\"",
    "1979-05-27",
    "[0, 0, 0]",
    "[1, 0, 0]",
    "[1e-200, 0, 0]",
    "[[0, 0, 0], [1, 0, 0]]",
    "[[0, 0, 0], [0, 0, 1e-9], [1, 0, 0]]",
    "[1]",
    "\"thread.a.start\"",
    "\"thread.a.end\"",
    "\"thread.b.end\"",
    "\"thread.b.node.1\"",
    "\"net.main.knot.0.1\"",
    "\"net.main.top_left\"",
    "\"mechanism.m1.a\"",
    "\"mechanism.m1.launcher\"",
    "\"ring.p\"",
    "\"ring.q\"",
    "\"\\u00e4\\u0007\"",
    "[\"a\", \"b\"]",
    "[\"net.main.left\", \"net.main.top\"]",
    "\"sliding\"",
    "\"contact\"",
    "\"paper\"",
    "\"guided\"",
    "\"fixed\"",
    "{ on = \"thread.a.end\" }",
    "{ mass_kg = 1e-300, radius_m = 1 }",
};

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text)
    if (c == '\n') lines.emplace_back();
    else lines.back() += c;
  return lines;
}

template <class T>
T& one_of(std::vector<T>& list, Random& random) {
  return list[random() % list.size()];
}

const std::string& sound_case(Random& random) {
  const std::vector<std::string>& cases = sound_cases();
  const std::size_t among = random() % 2 == 0 ? kept : cases.size();
  return cases[random() % std::min(among, cases.size())];
}

std::string value_of(const std::string& line) {
  const std::size_t equals = line.find("= ");
  return equals == std::string::npos ? "1" : line.substr(equals + 2);
}

void set_value(std::string& line, const std::string& value) {
  const std::size_t equals = line.find("= ");
  if (equals != std::string::npos) line = line.substr(0, equals + 2) + value;
}

void change(std::vector<std::string>& lines, Random& random) {
  std::string& line = one_of(lines, random);
  const std::string other = one_of(lines, random);
  switch (random() % 6) {
    case 0:
    case 1:
      return set_value(line, values[random() % values.size()]);
    case 2:
      return set_value(line, value_of(other));
    case 3:
      return void(lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(random() % lines.size()), other));
    case 4:
      return void(lines.erase(lines.begin() + (&line - lines.data())));
    default:
      return std::swap(line, one_of(lines, random));
  }
}

}  // namespace

void remember_sound_case(std::string_view text) {
  static std::size_t count = 0;
  std::vector<std::string>& cases = sound_cases();
  if (cases.size() < most_sound_cases) cases.emplace_back(text);
  else cases[kept + count++ % (most_sound_cases - kept)] = text;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  Random random(seed + 1);
  if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, max_size);
  std::string_view begin(reinterpret_cast<const char*>(data), size);
  if (!sound_cases().empty() && random() % 4 != 0) begin = sound_case(random);
  std::vector<std::string> lines = lines_of(begin);
  for (std::size_t k = 0; k <= random() % 3; ++k)
    if (!lines.empty()) change(lines, random);
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  text.resize(std::min(text.size(), max_size));
  std::copy(text.begin(), text.end(), data);
  return text.size();
}
