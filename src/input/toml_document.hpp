// A TOML text as a plain tree with the place of every key and value, members in file order.
// The only door to toml++: nothing else in the project includes it.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cinch {

/// Where something was said: line and column of the case file (from 1), or the number of an override.
struct Place {
  int line = 0, column = 0;
  int override_number = 0;  ///< 1 for the first --set, ...; 0: the case file
};

struct TomlMember;

/// One value of any TOML type.
struct TomlValue {
  enum class Type { string, integer, number, boolean, array, table, date };
  Type type = Type::table;
  std::string text;                 ///< string
  std::int64_t integer = 0;         ///< integer
  double number = 0;                ///< integer or number
  bool flag = false;                ///< boolean
  std::vector<TomlValue> items;     ///< array
  std::vector<TomlMember> members;  ///< table, in file order
  Place place;

  const TomlMember* find(std::string_view key) const;
  TomlMember* find(std::string_view key);
};

struct TomlMember {
  std::string key;
  Place key_place;
  TomlValue value;
};

/// A text that is no valid TOML.
struct TomlError {
  Place place;
  std::string what;
};

/// Bytes of a case file: a hundred thousand points of a thread. A value takes about a hundred times the
/// memory of its text, so this bounds what a broken file can cost.
constexpr std::size_t max_case_size = 4u << 20;
/// Bytes of a case with every default written out, as checkpoints hold it.
constexpr std::size_t max_resolved_size = 16 * max_case_size;

/// Parses a document. Only ASCII is accepted outside of comments; throws TomlError.
TomlValue parse_toml(std::string_view text);

/// Parses one value; a text that is no TOML value counts as a string. Throws TomlError for non-ASCII text.
TomlValue parse_toml_value(std::string_view text, Place place);

/// A value as TOML text on one line; after `enough` characters the rest of a list may be left out.
std::string toml_text(const TomlValue& value, std::size_t enough = std::string::npos);
std::string toml_text(double number);
std::string toml_text(const std::string& string);

/// A key as TOML text: bare where possible, else quoted.
std::string toml_key(const std::string& key);

/// A value as an error message shows it: shortened, with its type.
std::string describe(const TomlValue& value);

}  // namespace cinch
