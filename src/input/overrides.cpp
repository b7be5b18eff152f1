#include "input/overrides.hpp"

#include "input/key_table.hpp"
#include "input/nearest_key.hpp"

namespace cinch {

namespace {

// Cuts net.main.node."knot.3.4".mass_kg at the dots outside of quotes; empty when the path is malformed.
std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts(1);
  char quote = 0;
  for (const char c : path) {
    if (quote != 0 ? c == quote : c == '"' || c == '\'') quote = quote != 0 ? '\0' : c;
    else if (c == '.' && quote == 0) parts.emplace_back();
    else parts.back() += c;
  }
  for (const std::string& part : parts)
    if (part.empty()) return {};
  return quote != 0 || parts.size() > 8 ? std::vector<std::string>() : parts;
}

const SectionInfo* section_of(const std::string& name) {
  for (const SectionInfo* section : all_sections())
    if (section->name == name && name != "node") return section;
  return nullptr;
}

// Whether the table a path goes through may be made by an override: sections without names and tables inside
// parts.
bool may_create(const std::vector<std::string>& path, std::size_t depth, Place place, const TomlValue& table,
                Diagnostics& diagnostics) {
  const SectionInfo* section = section_of(path[0]);
  if (depth == 0 && section && !section->named) return true;
  if (depth > 1) return true;
  std::vector<std::string> known;
  if (depth == 0) {
    for (const SectionInfo* candidate : all_sections())
      if (candidate->name != "node") known.push_back(candidate->name);
    if (section) diagnostics.error(place, "the case has no [" + path[0] + ".NAME]");
    else
      diagnostics.error(place, "unknown section '" + path[0] + "'" + did_you_mean(path[0], known),
                        "allowed: " + list_of(known));
    return false;
  }
  if (!section || !section->named) return true;  // an unknown key of a section, told when the section is read
  for (const TomlMember& member : table.members) known.push_back(member.key);
  diagnostics.error(place, "the case has no " + path[0] + " '" + path[1] + "'" + did_you_mean(path[1], known),
                    path[0] + "s of this case: " + list_of(known));
  return false;
}

TomlMember& member_of(TomlValue& table, const std::string& key, Place place) {
  if (TomlMember* member = table.find(key)) return *member;
  TomlValue value;
  value.place = place;
  table.members.push_back({key, place, value});
  return table.members.back();
}

void put(TomlValue& document, const std::vector<std::string>& path, const std::string& value, Place place,
         Diagnostics& diagnostics) {
  TomlValue* table = &document;
  for (std::size_t depth = 0; depth < path.size(); ++depth) {
    if (table->type != TomlValue::Type::table) {
      diagnostics.error(place, "'" + path[depth - 1] + "' is a value and has no key '" + path[depth] + "'");
      return;
    }
    const bool last = depth + 1 == path.size();
    const bool schema = depth == 0 && path[0] == "schema";
    if (!table->find(path[depth]) && !schema && !may_create(path, depth, place, *table, diagnostics)) return;
    TomlMember& member = member_of(*table, path[depth], place);
    if (last) member.value = parse_toml_value(value, place);
    table = &member.value;
  }
}

// Names of all parts that thread.* means, in the file's order.
std::vector<std::string> names_of_all(const TomlValue& document, const std::string& section) {
  std::vector<std::string> names;
  for (const TomlMember& member : document.members)
    if (member.key == section)
      for (const TomlMember& part : member.value.members) names.push_back(part.key);
  return names;
}

void apply(TomlValue& document, const Override& set, Place place, Diagnostics& diagnostics) {
  std::vector<std::string> path = split_path(set.key);
  if (path.empty()) {
    diagnostics.error(place, "'" + set.key + "' is no key path", "example: --set time.end_s=0.5");
    return;
  }
  const SectionInfo* section = section_of(path[0]);
  if (path.size() < 3 || path[1] != "*" || !section || !section->named)
    return put(document, path, set.value, place, diagnostics);
  const std::vector<std::string> names = names_of_all(document, path[0]);
  if (names.empty()) diagnostics.error(place, "the case has no [" + path[0] + ".NAME]");
  for (const std::string& name : names) {
    path[1] = name;
    put(document, path, set.value, place, diagnostics);
  }
}

}  // namespace

void apply_overrides(TomlValue& document, const std::vector<Override>& overrides, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const Place place = {0, 0, static_cast<int>(i) + 1};
    try {
      apply(document, overrides[i], place, diagnostics);
    } catch (const TomlError& error) {
      diagnostics.error(place, error.what);
    }
  }
}

}  // namespace cinch
