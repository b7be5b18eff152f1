// The reference of all keys, written from the rows that the reader itself uses.
#include "input/case_reader.hpp"
#include "input/section_reader.hpp"

namespace cinch {

const std::vector<const SectionInfo*>& all_sections() {
  static const std::vector<const SectionInfo*> sections = {
      &case_section(),  &time_section(),      &output_section(),  &gravity_section(),
      &start_section(), &closing_section(),   &contact_section(), &material_section(),
      &net_section(),   &mechanism_section(), &thread_section(),  &node_section(),
      &ring_section(),  &rings_section(),     &target_section(),  &probe_section(),
  };
  return sections;
}

namespace {

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string heading(const SectionInfo& section) {
  const std::string need = section.required ? " (required)" : section.optional_feature ? " (optional)" : "";
  if (section.name == "node") return "### Nodes: `start`, `end`, `node.PLACE`";
  return "### `[" + section.name + (section.named ? ".NAME" : "") + "]`" + need;
}

std::string default_text(const KeyInfo& key) {
  if (key.required && !key.not_with.empty()) return "required without `" + key.not_with + "`";
  if (key.required && !key.only_with.empty()) return "required with `" + key.only_with + "`";
  if (key.required) return "**required**";
  if (!key.fallback.empty()) {
    std::string text = "`" + key.fallback + "`";
    for (const auto& [method, fallback] : key.by_method) text += ", with `" + method + "` `" + fallback + "`";
    return text;
  }
  return key.fallback_note.empty() ? "none" : key.fallback_note;
}

std::string meaning_text(const KeyInfo& key) {
  std::string text = key.meaning;
  if (!key.only_with.empty() && !key.required) text += " Only with `" + key.only_with + "`.";
  if (!key.not_with.empty() && !key.required) text += " Not with `" + key.not_with + "`.";
  return text;
}

}  // namespace

std::string case_reference() {
  std::string text;
  for (const SectionInfo* section : all_sections()) {
    text += heading(*section) + "\n\n" + section->about + "\n\n";
    text += "| key | meaning | allowed | default | why this default |\n|---|---|---|---|---|\n";
    for (const KeyInfo& key : section->keys)
      text += "| `" + key.name + "` | " + cell(meaning_text(key)) + " | " + cell(allowed_text(key)) + " | " +
              cell(default_text(key)) + " | " + cell(key.source) + " |\n";
    text += "\n";
  }
  text.pop_back();  // no empty line at the end
  return text;
}

}  // namespace cinch
