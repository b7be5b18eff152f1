// The keys of a case file as data: one row a key. The rows drive reading, checking, defaults, the resolved
// case and the reference (cases/README.md).
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "input/references.hpp"
#include "input/toml_document.hpp"
#include "scene/scene.hpp"

namespace cinch {

/// What a key holds.
enum class KeyType {
  text,    ///< a string
  name,    ///< a string that names another part
  names,   ///< an array of such strings
  number,  ///< a finite number (whole numbers included)
  whole,   ///< a whole number
  wholes,  ///< an array of whole numbers
  flag,    ///< true or false
  choice,  ///< one of some words
  pair,    ///< [a, b]
  vector,  ///< [x, y, z]
  points,  ///< [[x, y, z], [x, y, z], ...]
  node,    ///< a sub-table with the keys of a node
  nodes    ///< sub-tables NAME with the keys of a node
};

/// Allowed values of a number or of each component of an array.
struct Range {
  double low = -1e12, high = 1e12;
  bool low_included = true;
};
inline Range above(double low, double high = 1e12) { return {low, high, false}; }
inline Range from(double low, double high = 1e12) { return {low, high, true}; }

/// A checked value; which member counts follows from the key's type.
struct Value {
  TomlValue toml;  ///< as written, or the default
  double number = 0;
  int whole = 0;
  std::size_t choice = 0;      ///< number of the word in KeyInfo::words
  bool is_word = false;        ///< a word was given instead of a number or list ("auto", "all")
  Vec3 vector = Vec3::Zero();  ///< vector; pair in x and y
  std::vector<int> wholes;
  std::vector<Vec3> points;
  std::vector<std::string> names;
  const std::string& text() const { return toml.text; }
  bool flag() const { return toml.flag; }
};

/// What is known about a key apart from the place in the scene that it fills.
struct KeyInfo {
  std::string name;  ///< with its unit: "end_s"
  KeyType type = KeyType::number;
  std::string unit{};  ///< "" for numbers without a unit
  Range range{};
  bool nonzero = false;              ///< a vector that gives a direction
  std::vector<std::string> words{};  ///< of a choice; or the word allowed instead of a number or list
  unsigned refers = 0;               ///< what its names may refer to: Form values or'ed (references.hpp)
  bool required = false;
  std::string fallback{};                          ///< default in TOML syntax; "": none
  std::map<std::string, std::string> by_method{};  ///< default with that `case.method`, where it is another
  std::string fallback_note{};  ///< said in the reference where the default depends on other keys
  std::string only_with{};      ///< the key means something only beside this other key
  std::string not_with{};       ///< the key excludes this other key (and is not required beside it)
  std::string meaning{};
  std::string source{};  ///< where the default comes from
};

/// A key of a section that fills a `Part`; without `set` the section's own code uses the value.
template <class Part>
struct Key : KeyInfo {
  std::function<void(Part&, const Value&)> set{};
};

/// What is known about a section apart from its keys' targets.
struct SectionInfo {
  std::string name;    ///< "time", "thread"
  bool named = false;  ///< [thread.NAME] instead of [time]
  bool required = false;
  bool optional_feature = false;  ///< an absent section is a feature left out, not one with defaults
  std::string about;
  std::vector<KeyInfo> keys{};
};

template <class Part>
struct Section : SectionInfo {
  std::vector<Key<Part>> rows;
  Section(SectionInfo info, std::vector<Key<Part>> its_rows)
      : SectionInfo(std::move(info)), rows(std::move(its_rows)) {
    for (const Key<Part>& row : rows) keys.push_back(row);
  }
};

/// The setter that stores a value in a member of the scene; an enumeration takes the number of the word.
template <class Base, class Member>
auto into(Member Base::*member) {
  return [member](auto& part, const Value& value) {
    auto& target = part.*member;
    if constexpr (std::is_enum_v<Member>) target = static_cast<Member>(value.choice);
    else if constexpr (std::is_same_v<Member, bool>) target = value.flag();
    else if constexpr (std::is_same_v<Member, int>) target = value.whole;
    else if constexpr (std::is_same_v<Member, std::string>) target = value.text();
    else if constexpr (std::is_same_v<Member, Vec3> || std::is_same_v<Member, std::optional<Vec3>>)
      target = value.vector;
    else if constexpr (std::is_same_v<Member, std::vector<std::string>>) target = value.names;
    else if constexpr (std::is_same_v<Member, std::vector<Vec3>>) target = value.points;
    else if constexpr (std::is_same_v<Member, std::vector<int>>) target = value.wholes;
    else target = value.number;
  };
}

/// [rings.NAME]: rings on chosen cells of a net's edges.
struct RingRow {
  std::string name;  ///< before each ring's number
  Ring ring;         ///< what all of them share
  std::string net;
  std::vector<std::string> edges;
  std::vector<int> cells;  ///< from 1; empty: all
  SourceRef source;
};

// The sections of a case file.
const Section<Scene>& case_section();
const Section<TimeSpec>& time_section();
const Section<OutputSpec>& output_section();
const Section<Scene>& gravity_section();
const Section<Scene>& start_section();
const Section<Closing>& closing_section();
const Section<Contact>& contact_section();
const Section<Material>& material_section();
const Section<NodeSpec>& node_section();
const Section<Thread>& thread_section();
const Section<Net>& net_section();
const Section<Ring>& ring_section();
const Section<RingRow>& rings_section();
const Section<Mechanism>& mechanism_section();
const Section<BallTarget>& target_section();
const Section<Probe>& probe_section();

/// All of them in the order of the reference. The section "node" describes sub-tables of threads and nets.
const std::vector<const SectionInfo*>& all_sections();

/// What a key allows, in words: "number in s, > 0 and <= 1e+06".
std::string allowed_text(const KeyInfo& key);

}  // namespace cinch
