// Fuzz target of the case reader: a text, with --set lines in its comments, becomes a scene or one clear
// error. What parses must resolve to itself and, where it is small, get a step; see tests/fuzz/run.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "input/case_reader.hpp"
#include "mutate_lines.hpp"
#include "plan/preparation.hpp"
#include "scene/net_pattern.hpp"

namespace {

using namespace cinch;

const std::string file = "fuzzed.toml";

void require(bool holds, const char* what, const std::string& text) {
  if (holds) return;
  std::fprintf(stderr, "%s:\n%s\n", what, text.c_str());
  std::abort();
}

// A user must see where to look: in the file, or at an override.
void require_clear(const CaseError& error) {
  const std::string text = error.what();
  require(text.find("error: ") != std::string::npos, "an error that says nothing", text);
  require(text.find(file) != std::string::npos || text.find("--set ") != std::string::npos,
          "an error without a place", text);
}

// The lines "#--set key=value", so that one input holds a case and its overrides.
std::vector<Override> overrides_in(std::string_view text) {
  constexpr std::string_view mark = "#--set ";
  std::vector<Override> overrides;
  for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + 1)) {
    const std::string_view rest = text.substr(at + mark.size());
    const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && overrides.size() < 16)
      overrides.push_back({std::string(line.substr(0, equals)), std::string(line.substr(equals + 1))});
  }
  return overrides;
}

// Large scenes are left alone: what is looked for is found in small ones.
bool is_small(const Scene& scene) {
  std::int64_t elements = 0;
  for (const Net& net : scene.nets) elements += NetPattern::elements(net);
  for (const Mechanism& mechanism : scene.mechanisms) elements += mechanism.towing_elements;
  for (const Thread& thread : scene.threads) elements += thread.elements;
  return elements <= 3000 && scene.rings.size() <= 100;
}

void require_sound(const Preparation& p) {
  const double before = p.timeline.before(), after = p.timeline.after();
  bool finite =
      std::isfinite(before + after) && before > 0 && after > 0 && p.stable_step > 0 && p.end_step >= 0;
  for (const AssemblyNode& node : p.assembly.nodes)
    finite = finite && node.position.allFinite() && node.velocity.allFinite() && std::isfinite(node.mass);
  for (const AssemblyElement& e : p.assembly.elements)
    finite = finite && std::isfinite(e.stiffness) && std::isfinite(e.damping) && e.rest_length > 0;
  require(finite, "a scene of values that are no numbers",
          std::to_string(before) + ", " + std::to_string(after));
}

void require_same_again(const std::string& resolved) {
  try {
    const std::string again = parse_case(resolved, file).resolved_toml;
    require(again == resolved, "not the same when resolved again", again);
  } catch (const CaseError& error) {
    require(false, "a resolved case that is refused", error.what());
  }
}

void read(std::string_view text) {
  const Scene scene = parse_case(text, file, overrides_in(text));
  require_same_again(scene.resolved_toml);
  if (!is_small(scene)) return;
  if (text.size() < 3000) remember_sound_case(text);
  require_sound(prepare(scene));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    read({reinterpret_cast<const char*>(data), size});
  } catch (const CaseError& error) {
    require_clear(error);
  }
  return 0;
}
