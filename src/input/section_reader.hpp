// Reads one table of a case file by the rows of its section: unknown and missing keys, types, ranges,
// defaults.
#pragma once
#include <deque>
#include <string>
#include <vector>

#include "input/diagnostics.hpp"
#include "input/key_table.hpp"

namespace cinch {

/// One key of a section that was read.
struct Entry {
  const KeyInfo* key = nullptr;
  std::size_t row = 0;  ///< number of the key in its section
  Value value;
  bool given = false;  ///< in the file or by an override; else the default
  Place key_place;
};

/// A section that was read: its checked values, defaults filled in.
struct SectionValues {
  std::string path;  ///< "thread.main"
  const SectionInfo* info = nullptr;
  Place place;
  std::vector<Entry> entries;
  bool sound = true;  ///< no error was found in it

  const Entry* find(const std::string& key) const;
  bool given(const std::string& key) const;
  /// Place of a key's value, else of the section.
  Place place_of(const std::string& key) const;
  /// Fills in a default that depends on other keys.
  void set_default(const std::string& key, const std::string& toml);
};

/// Checks one value; on failure returns what is wrong with it (found, allowed) and sets the place.
bool check_value(const KeyInfo& key, const TomlValue& found, Value& value, std::string& problem,
                 Place& place);

/// Checks a table against its section; `method`: that of the case, on which defaults may depend.
SectionValues read_section(const SectionInfo& info, const std::string& path, Place place,
                           const TomlValue& table, const std::string& method, Diagnostics& diagnostics);

/// The same, and fills `part`.
template <class Part>
SectionValues read_section(const Section<Part>& section, const std::string& path, Place place,
                           const TomlValue& table, const std::string& method, Diagnostics& diagnostics,
                           Part& part) {
  SectionValues values = read_section(section, path, place, table, method, diagnostics);
  for (const Entry& entry : values.entries)
    if (const auto& set = section.rows[entry.row].set) set(part, entry.value);
  return values;
}

/// The whole case in TOML, every default written out.
std::string resolved_toml(const std::deque<SectionValues>& sections);

}  // namespace cinch
