#include "input/case_builder.hpp"

#include <algorithm>
#include <cmath>

#include "input/nearest_key.hpp"
#include "scene/extent.hpp"

namespace cinch {

namespace {

using Type = TomlValue::Type;

constexpr double max_frames = 1e6, max_samples = 1e7, max_checkpoints = 1e6,
                 max_steps = 1e12;  // a run beyond them is a slip of the pen
constexpr double max_elements = 2e8;
constexpr std::size_t max_parts = 20000;  // of a kind: they are found by name, one after the other

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const SectionInfo* section : all_sections())
    if (section->name != "node") names.push_back(section->name);
  return names;
}

// "end_s (number in s, > 0 and <= 1e+06)"
std::string required_keys(const SectionInfo& section) {
  std::string text;
  for (const KeyInfo& key : section.keys)
    if (key.required) text += (text.empty() ? "" : ", ") + key.name + " (" + allowed_text(key) + ")";
  return text;
}

bool is_part_name(const std::string& name) { return !name.empty() && toml_key(name) == name; }

}  // namespace

Scene CaseBuilder::build() {
  if (!check_schema()) return scene_;
  check_top_level();
  read_run();
  collect_names();
  for (const Named& part : parts_of({"material"})) read_material(*part.member);
  for (const Named& part : parts_of({"net"})) read_net(*part.member);
  for (const Named& part : parts_of({"mechanism"})) read_mechanism(*part.member);
  for (const Named& part : parts_of({"thread"})) read_thread(*part.member);
  for (const Named& part : parts_of({"ring", "rings"}))
    part.kind == "ring" ? read_ring(*part.member) : read_rings(*part.member);
  for (const Named& part : parts_of({"target"})) read_target(*part.member);
  for (const Named& part : parts_of({"probe"})) read_probe(*part.member);
  check_references();
  check_run();
  check_size();
  if (diagnostics_.empty()) scene_.resolved_toml = resolved_toml(sections_);
  return scene_;
}

void CaseBuilder::fail(Place place, const std::string& message, const std::string& help) {
  diagnostics_.error(place, message, help);
}

bool CaseBuilder::check_schema() {
  const TomlMember* schema = document_.find("schema");
  if (!schema) {
    fail({1, 1}, "missing key 'schema'", "write as the first line: schema = 1");
    return false;
  }
  const TomlValue& found = schema->value;
  if (found.type == Type::integer && found.integer == 1) return true;
  const bool newer = found.type == Type::integer && found.integer > 1;
  fail(found.place, "schema: found " + describe(found) + ", allowed: 1",
       newer ? "the case was written for a newer program" : "this program reads case files with: schema = 1");
  return false;
}

void CaseBuilder::check_top_level() {
  const std::vector<std::string> known = section_names();
  for (const TomlMember& member : document_.members) {
    if (member.key == "schema") continue;
    const auto info = std::find_if(
        all_sections().begin(), all_sections().end(),
        [&](const SectionInfo* section) { return section->name == member.key && section->name != "node"; });
    const bool table = member.value.type == Type::table;
    if (info == all_sections().end()) {
      meant_sections_.insert(nearest_key(member.key, known));
      fail(member.key_place,
           std::string(table ? "unknown section '" : "unknown key '") + toml_key(member.key) + "'" +
               did_you_mean(member.key, known),
           "allowed: schema, " + list_of(known));
    } else if (!table) {
      const std::string form = "[" + member.key + ((*info)->named ? ".NAME]" : "]");
      fail(member.value.place,
           "'" + member.key + "': found " + describe(member.value) + ", allowed: a section " + form);
    } else if ((*info)->named && member.value.members.size() > max_parts) {
      fail(member.value.members[max_parts].key_place,
           "the case has " + std::to_string(member.value.members.size()) + " [" + member.key +
               ".NAME], allowed: <= " + std::to_string(max_parts));
      diagnostics_.throw_all();
    } else if ((*info)->named) {
      for (const TomlMember& part : member.value.members) {
        const std::string path = member.key + "." + toml_key(part.key);
        if (part.value.type != Type::table)
          fail(part.value.place, "'" + path + "': found " + describe(part.value) + ", allowed: a section [" +
                                     member.key + ".NAME] (parts have names)");
        else if (!is_part_name(part.key))
          fail(part.key_place, "'" + path + "' is no name of a part", "allowed: letters, digits, _ and -");
      }
    }
  }
}

// Names come before the parts, so that a reference to a faulty part is no second error.
void CaseBuilder::collect_names() {
  for (const SectionInfo* section : all_sections())
    if (section->named)
      for (const Named& part : parts_of({section->name})) references_.add(section->name, part.member->key);
}

std::vector<CaseBuilder::Named> CaseBuilder::parts_of(const std::vector<std::string>& kinds) const {
  std::vector<Named> parts;
  for (const std::string& kind : kinds) {
    const TomlMember* section = document_.find(kind);
    if (!section || section->value.type != Type::table) continue;
    for (const TomlMember& member : section->value.members)
      if (member.value.type == Type::table && is_part_name(member.key)) parts.push_back({kind, &member});
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Named& a, const Named& b) {
    const Place p = a.member->key_place, q = b.member->key_place;
    return p.line != q.line ? p.line < q.line : p.column < q.column;
  });
  return parts;
}

template <class Part>
const SectionValues* CaseBuilder::read_single(const Section<Part>& section, Part& part) {
  static const TomlValue absent;
  const TomlMember* member = document_.find(section.name);
  if (member && member->value.type != Type::table) return nullptr;  // told already
  if (!member && section.optional_feature) return nullptr;
  if (!member && section.required) {
    if (!meant_sections_.contains(section.name))  // a slip of the pen is one mistake
      fail({1, 1}, "missing section [" + section.name + "]", "required in it: " + required_keys(section));
    return nullptr;
  }
  const Place place = member ? member->key_place : Place{};
  sections_.push_back(cinch::read_section(section, section.name, place, member ? member->value : absent,
                                          method_, diagnostics_, part));
  return &sections_.back();
}

void CaseBuilder::read_run() {
  if (const SectionValues* words = read_single(case_section(), scene_))
    if (const Entry* method = words->find("method")) method_ = method->value.toml.text;
  if (const SectionValues* time = read_single(time_section(), scene_.time)) {
    scene_.time.source.text = diagnostics_.where(time->place_of("step_s"));
    scene_.time.joint_steps_source.text = diagnostics_.where(time->place_of("joint_steps"));
    scene_.time.end_when_source.text = diagnostics_.where(time->place_of("end_when"));
  }
  read_single(output_section(), scene_.output);
  read_single(gravity_section(), scene_);
  if (const SectionValues* start = read_single(start_section(), scene_))
    scene_.equilibrium_source.text = diagnostics_.where(start->place_of("equilibrium"));
  if (const SectionValues* closing = read_single(closing_section(), scene_.closing)) {
    scene_.closing.source.text = diagnostics_.where(closing->place_of("time_s"));
    scene_.closing.step_source.text = diagnostics_.where(closing->place_of("step_s"));
  }
  read_single(contact_section(), scene_.contact);
}

Place CaseBuilder::first_closing_thread() const {
  for (const SectionValues& section : sections_)
    if (section.given("along")) return section.place_of("along");
  return {};
}

// What concerns several sections at once.
void CaseBuilder::check_run() {
  const auto place = [this](const char* path, const char* key) {
    for (const SectionValues& section : sections_)
      if (section.path == path) return section.place_of(key);
    return Place{};
  };
  const TimeSpec& time = scene_.time;
  const OutputSpec& output = scene_.output;
  if (!(time.end > 0)) return;  // refused already
  const std::string end = "time.end_s = " + toml_text(time.end);
  if (time.end / output.frame_interval > max_frames)
    fail(place("output", "frame_interval_s"),
         "output.frame_interval_s: found " + toml_text(output.frame_interval) + " with " + end +
             ", allowed: >= " + toml_text(time.end / max_frames) + " s, at most 1e6 frames a run");
  if (output.probe_interval > 0 && time.end / output.probe_interval > max_samples)
    fail(place("output", "probe_interval_s"),
         "output.probe_interval_s: found " + toml_text(output.probe_interval) + " with " + end +
             ", allowed: >= " + toml_text(time.end / max_samples) + " s, at most 1e7 samples a run");
  if (output.checkpoint_interval > 0 && time.end / output.checkpoint_interval > max_checkpoints)
    fail(place("output", "checkpoint_interval_s"),
         "output.checkpoint_interval_s: found " + toml_text(output.checkpoint_interval) + " with " + end +
             ", allowed: 0, or >= " + toml_text(time.end / max_checkpoints) +
             " s, at most 1e6 checkpoints a run");
  const auto check_step = [&](const char* section, double step) {
    const std::string found = std::string(section) + ".step_s: found " + toml_text(step) + " with " + end;
    if (step > 0 && time.end / step > max_steps)
      fail(place(section, "step_s"), found + ", allowed: >= " + toml_text(time.end / max_steps) + " s");
    if (step > time.end) fail(place(section, "step_s"), found + ", allowed: a step below the end");
  };
  check_step("time", time.step);
  check_step("closing", scene_.closing.step.value_or(0));
  if (scene_.equilibrium && !scene_.gravity)
    fail(place("start", "equilibrium"), "start.equilibrium: found true in a case without [gravity]",
         "allowed: false, or a section [gravity] with acceleration_m_s2");
  const Place along = first_closing_thread();
  if (along.line + along.override_number > 0 && !scene_.closing.time && !document_.find("closing"))
    fail(along, "a thread laid 'along' other parts needs a closing time",
         "add a section [closing] with time_s (>= 0)");
}

// References stand in rows: whatever key may name a part is checked here, with the place of the name.
void CaseBuilder::check_references() {
  for (const SectionValues& section : sections_) {
    for (const Entry& entry : section.entries) {
      if (entry.key->refers == 0 || !entry.given) continue;
      const TomlValue& toml = entry.value.toml;
      const bool list = toml.type == Type::array;
      for (std::size_t i = 0; i < (list ? toml.items.size() : 1); ++i) {
        const TomlValue& item = list ? toml.items[i] : toml;
        if (const auto problem = references_.check(item.text, entry.key->refers))
          fail(item.place, section.path + "." + entry.key->name + ": " + problem->message, problem->help);
      }
    }
  }
}

void CaseBuilder::check_size() {
  if (!diagnostics_.empty()) return;
  if (scene_.nets.empty() && scene_.threads.empty())
    fail({}, "the case has neither a [net.NAME] nor a [thread.NAME]");
  const Extent extent = extent_of(scene_);
  if (static_cast<double>(extent.elements) <= max_elements) return;
  Place place;  // of the part with most of them
  for (const SectionValues& section : sections_)
    if (diagnostics_.where(section.place) == extent.largest.text) place = section.place;
  fail(place, "the case has " + std::to_string(extent.elements) +
                  " elements, allowed: <= " + toml_text(max_elements) + " (this part has most of them)");
}

}  // namespace cinch
