#include "input/section_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>

#include "input/nearest_key.hpp"

namespace cinch {

namespace {

using Type = TomlValue::Type;

bool is_number(const TomlValue& found) { return found.type == Type::number || found.type == Type::integer; }

bool in_range(const Range& range, double number) {
  return std::isfinite(number) && number <= range.high &&
         (range.low_included ? number >= range.low : number > range.low);
}

// One number or one component of an array; remembers the place of the first bad one.
bool check_number(const KeyInfo& key, const TomlValue& found, Place& place) {
  if (is_number(found) && in_range(key.range, found.number)) return true;
  place = found.place;
  return false;
}

bool check_numbers(const KeyInfo& key, const TomlValue& found, std::size_t size, Vec3& vector, Place& place) {
  if (found.type != Type::array || found.items.size() != size) return false;
  for (std::size_t i = 0; i < size; ++i) {
    if (!check_number(key, found.items[i], place)) return false;
    vector[static_cast<Eigen::Index>(i)] = found.items[i].number;
  }
  return !key.nonzero || vector.norm() > 1e-12;
}

bool check_points(const KeyInfo& key, const TomlValue& found, Value& value, Place& place) {
  if (found.type != Type::array || found.items.size() < 2) return false;
  for (const TomlValue& item : found.items) {
    Vec3 point = Vec3::Zero();
    place = item.place;
    if (!check_numbers(key, item, 3, point, place)) return false;
    value.points.push_back(point);
  }
  return true;
}

bool check_names(const KeyInfo& key, const TomlValue& found, Value& value, Place& place) {
  if (found.type != Type::array) return false;
  std::set<std::string> seen;
  for (const TomlValue& item : found.items) {
    place = item.place;
    const bool known =
        key.words.empty() || std::find(key.words.begin(), key.words.end(), item.text) != key.words.end();
    if (item.type != Type::string || item.text.empty() || !known || !seen.insert(item.text).second)
      return false;
    value.names.push_back(item.text);
  }
  return true;
}

bool check_wholes(const KeyInfo& key, const TomlValue& found, Value& value, Place& place) {
  if (found.type != Type::array || found.items.empty()) return false;
  std::set<int> seen;
  for (const TomlValue& item : found.items) {
    place = item.place;
    if (item.type != Type::integer || !in_range(key.range, item.number)) return false;
    const int number = static_cast<int>(item.integer);
    if (!seen.insert(number).second) return false;
    value.wholes.push_back(number);
  }
  return true;
}

bool check_word(const KeyInfo& key, const TomlValue& found, Value& value) {
  const auto word = std::find(key.words.begin(), key.words.end(), found.text);
  if (found.type != Type::string || word == key.words.end()) return false;
  value.choice = static_cast<std::size_t>(word - key.words.begin());
  value.is_word = true;
  return true;
}

bool accept(const KeyInfo& key, const TomlValue& found, Value& value, Place& place) {
  const bool word_instead =
      key.type == KeyType::number || key.type == KeyType::whole || key.type == KeyType::wholes;
  if (word_instead && check_word(key, found, value)) return true;
  switch (key.type) {
    case KeyType::text:
      return found.type == Type::string;
    case KeyType::name:
      return found.type == Type::string && !found.text.empty();
    case KeyType::names:
      return check_names(key, found, value, place);
    case KeyType::number:
      value.number = found.number;
      return check_number(key, found, place);
    case KeyType::whole:
      if (found.type != Type::integer || !check_number(key, found, place)) return false;
      value.whole = static_cast<int>(found.integer);
      return true;
    case KeyType::wholes:
      return check_wholes(key, found, value, place);
    case KeyType::flag:
      return found.type == Type::boolean;
    case KeyType::choice:
      return check_word(key, found, value);
    case KeyType::pair:
      return check_numbers(key, found, 2, value.vector, place);
    case KeyType::vector:
      return check_numbers(key, found, 3, value.vector, place);
    case KeyType::points:
      return check_points(key, found, value, place);
    case KeyType::node:
    case KeyType::nodes:
      return found.type == Type::table;
  }
  return false;
}

// As it is to be written: the bounds of whole numbers in digits.
std::string bound_text(const KeyInfo& key, double bound) {
  const bool whole = key.type == KeyType::whole || key.type == KeyType::wholes;
  return whole ? std::to_string(static_cast<std::int64_t>(bound)) : toml_text(bound);
}

std::string range_text(const KeyInfo& key) {
  const Range& range = key.range;
  return (key.unit.empty() ? "" : " in " + key.unit) + std::string(range.low_included ? ", >= " : ", > ") +
         bound_text(key, range.low) + " and <= " + bound_text(key, range.high);
}

// Whether a number is whole but written like 10.0 or 1e8, which TOML does not take for one.
bool whole_with_point(const TomlValue& found) {
  return (found.type == Type::number && std::isfinite(found.number) &&
          std::trunc(found.number) == found.number) ||
         std::any_of(found.items.begin(), found.items.end(), whole_with_point);
}

std::string quoted_words(const KeyInfo& key, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < key.words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == key.words.size() ? last : ", ") + toml_text(key.words[i]);
  return text;
}

bool is_table(const KeyInfo& key) { return key.type == KeyType::node || key.type == KeyType::nodes; }

// A section while it is read.
class Reading {
 public:
  Reading(SectionValues& values, const TomlValue& table, const std::string& method, Diagnostics& diagnostics)
      : values_(values), info_(*values.info), table_(table), method_(method), diagnostics_(diagnostics) {}

  void run() {
    for (const KeyInfo& key : info_.keys) known_.push_back(key.name);
    for (const TomlMember& member : table_.members) refuse_unknown(member);
    for (std::size_t i = 0; i < info_.keys.size(); ++i) read(info_.keys[i], i);
  }

 private:
  void refuse_unknown(const TomlMember& member) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) return;
    meant_.insert(nearest_key(member.key, known_));
    fail(member.key_place,
         "unknown key '" + values_.path + "." + toml_key(member.key) + "'" + did_you_mean(member.key, known_),
         "allowed " + section_text() + ": " + list_of(known_));
  }

  void read(const KeyInfo& key, std::size_t row) {
    const TomlMember* member = table_.find(key.name);
    const bool applies = (key.only_with.empty() || table_.find(key.only_with)) &&
                         (key.not_with.empty() || !table_.find(key.not_with));
    if (member && !applies) {
      refuse_company(key, *member);
    } else if (member) {
      if (!is_table(key)) check(key, row, *member);
      else if (member->value.type != Type::table)
        fail(member->value.place, full_name(key) + ": found " + describe(member->value) +
                                      ", allowed: a table of the keys of a node");
    } else if (applies && key.required) {
      if (!meant_.contains(key.name)) refuse_missing(key);  // a slip of the pen is one mistake
    } else if (applies && !key.fallback.empty()) {
      fill_in(key, row);
    }
  }

  std::string section_text() const {
    if (info_.name == "node") return "for a node";
    return "in [" + info_.name + (info_.named ? ".NAME" : "") + "]";
  }

  std::string full_name(const KeyInfo& key) const { return values_.path + "." + key.name; }

  void check(const KeyInfo& key, std::size_t row, const TomlMember& member) {
    Entry entry{&key, row, {}, true, member.key_place};
    Place place = member.value.place;
    std::string problem;
    if (check_value(key, member.value, entry.value, problem, place)) values_.entries.push_back(entry);
    else fail(place, full_name(key) + ": " + problem);
  }

  void fill_in(const KeyInfo& key, std::size_t row) {
    Entry entry{&key, row, {}, false, values_.place};
    std::string problem;
    Place place = values_.place;
    const auto of_method = key.by_method.find(method_);
    const std::string& fallback = of_method != key.by_method.end() ? of_method->second : key.fallback;
    if (check_value(key, parse_toml_value(fallback, place), entry.value, problem, place))
      values_.entries.push_back(entry);
    else fail(place, "default of " + full_name(key) + ": " + problem);
  }

  void refuse_company(const KeyInfo& key, const TomlMember& member) {
    const TomlMember* other = key.not_with.empty() ? nullptr : table_.find(key.not_with);
    if (other)
      fail(member.key_place, "'" + full_name(key) + "' cannot stand beside '" + key.not_with + "' (" +
                                 diagnostics_.where(other->key_place) + "): give one of them");
    else fail(member.key_place, "'" + full_name(key) + "' has a meaning only beside '" + key.only_with + "'");
  }

  void refuse_missing(const KeyInfo& key) {
    const std::string other = key.not_with.empty() ? "" : " (or '" + key.not_with + "')";
    fail(values_.place, "missing key '" + full_name(key) + "'" + other, "allowed: " + allowed_text(key));
  }

  void fail(Place place, const std::string& message, const std::string& help = "") {
    diagnostics_.error(place, message, help);
    values_.sound = false;
  }

  SectionValues& values_;
  const SectionInfo& info_;
  const TomlValue& table_;
  const std::string& method_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;
  std::set<std::string> meant_;  // by keys that are unknown
};

}  // namespace

std::string allowed_text(const KeyInfo& key) {
  const std::string or_word = key.words.empty() ? "" : ", or " + quoted_words(key, ", or ");
  switch (key.type) {
    case KeyType::text:
      return "string";
    case KeyType::name:
      return "name of a part (string)";
    case KeyType::names:
      return key.words.empty() ? "array of names, none twice"
                               : "array of " + quoted_words(key, ", ") + ", none twice";
    case KeyType::number:
      return "number" + range_text(key) + or_word;
    case KeyType::whole:
      return "whole number" + range_text(key) + or_word;
    case KeyType::wholes:
      return "array of whole numbers" + range_text(key) + ", none twice" + or_word;
    case KeyType::flag:
      return "true or false";
    case KeyType::choice:
      return quoted_words(key, " or ");
    case KeyType::pair:
      return "[a, b]: two numbers" + range_text(key);
    case KeyType::vector:
      return key.nonzero ? "[x, y, z]: a direction, not zero" : "[x, y, z]: three numbers" + range_text(key);
    case KeyType::points:
      return "[[x, y, z], ...]: two points or more" + range_text(key);
    case KeyType::node:
      return "table of the keys of a node";
    case KeyType::nodes:
      return "tables of the keys of a node";
  }
  return "";
}

bool check_value(const KeyInfo& key, const TomlValue& found, Value& value, std::string& problem,
                 Place& place) {
  if (accept(key, found, value, place)) {
    value.toml = found;
    return true;
  }
  problem = "found " + describe(found);
  if (found.type == Type::string) problem += did_you_mean(found.text, key.words);
  problem += ", allowed: " + allowed_text(key);
  if ((key.type == KeyType::whole || key.type == KeyType::wholes) && whole_with_point(found))
    problem += ", written without point and exponent";
  return false;
}

SectionValues read_section(const SectionInfo& info, const std::string& path, Place place,
                           const TomlValue& table, const std::string& method, Diagnostics& diagnostics) {
  SectionValues values{path, &info, place, {}, true};
  Reading(values, table, method, diagnostics).run();
  return values;
}

const Entry* SectionValues::find(const std::string& key) const {
  for (const Entry& entry : entries)
    if (entry.key->name == key) return &entry;
  return nullptr;
}

bool SectionValues::given(const std::string& key) const {
  const Entry* entry = find(key);
  return entry && entry->given;
}

Place SectionValues::place_of(const std::string& key) const {
  const Entry* entry = find(key);
  return entry && entry->given ? entry->value.toml.place : place;
}

void SectionValues::set_default(const std::string& key, const std::string& toml) {
  for (std::size_t i = 0; i < info->keys.size(); ++i) {
    if (info->keys[i].name != key) continue;
    Entry entry{&info->keys[i], i, {}, false, place};
    entry.value.toml = parse_toml_value(toml, place);
    const auto behind =
        std::find_if(entries.begin(), entries.end(), [i](const Entry& e) { return e.row > i; });
    entries.insert(behind, entry);
    return;
  }
}

std::string resolved_toml(const std::deque<SectionValues>& sections) {
  std::string text = "schema = 1\n";
  for (const SectionValues& section : sections) {
    text += "\n[" + section.path + "]\n";
    for (const Entry& entry : section.entries)
      text += entry.key->name + " = " + toml_text(entry.value.toml) + "\n";
  }
  return text;
}

}  // namespace cinch
