// Turns a parsed document into a scene: sections in order, what rows cannot express, references, sums.
#pragma once
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "input/section_reader.hpp"

namespace cinch {

class CaseBuilder {
 public:
  CaseBuilder(const TomlValue& document, Diagnostics& diagnostics)
      : document_(document), diagnostics_(diagnostics), references_(scene_) {}

  /// The scene; errors go to the diagnostics.
  Scene build();

 private:
  // a named part of the document
  struct Named {
    std::string kind;
    const TomlMember* member;
  };

  // the document (case_builder.cpp)
  bool check_schema();
  void check_top_level();
  void collect_names();
  std::vector<Named> parts_of(const std::vector<std::string>& kinds) const;
  template <class Part>
  const SectionValues* read_single(const Section<Part>& section, Part& part);
  template <class Part>
  SectionValues& read_part(const Section<Part>& section, const TomlMember& member, Part& part);
  void read_run();
  void check_run();
  void check_references();
  void check_size();
  Place first_closing_thread() const;

  // the parts (part_builder.cpp)
  void read_material(const TomlMember& member);
  void read_net(const TomlMember& member);
  void read_mechanism(const TomlMember& member);
  void read_thread(const TomlMember& member);
  void read_ring(const TomlMember& member);
  void read_rings(const TomlMember& member);
  void read_target(const TomlMember& member);
  void read_probe(const TomlMember& member);
  NodeSpec read_node(const std::string& path, const TomlMember& member);
  bool check_meshes(const Net& net, SectionValues& values);
  void complete_launch(Mechanism& mechanism, SectionValues& values, const Net& net);
  void add_ring(const Ring& ring, Place place);
  void check_ring_element(const Ring& ring, const SectionValues& values);
  void check_guide(const SectionValues& values, Support support);
  void fail(Place place, const std::string& message, const std::string& help = "");

  const TomlValue& document_;
  Diagnostics& diagnostics_;
  Scene scene_;
  References references_;
  std::deque<SectionValues> sections_;  // in the order of the resolved case; references to them stay valid
  std::set<std::string> ring_names_, meant_sections_;  // meant: by names that are unknown
  std::string method_;                                 // on which defaults depend
};

template <class Part>
SectionValues& CaseBuilder::read_part(const Section<Part>& section, const TomlMember& member, Part& part) {
  part.name = member.key;
  part.source.text = diagnostics_.where(member.key_place);
  sections_.push_back(cinch::read_section(section, section.name + "." + toml_key(member.key),
                                          member.key_place, member.value, method_, diagnostics_, part));
  return sections_.back();
}

}  // namespace cinch
