// References between parts: "net.main.top", "mechanism.m1.a", ... and plain names such as that of a material.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cinch {

/// What a reference may stand for.
enum Form : unsigned {
  a_material_name = 1u << 0,    ///< "aramid"
  a_net_name = 1u << 1,         ///< "main"
  a_thread_name = 1u << 2,      ///< "main"
  a_net = 1u << 3,              ///< "net.main"
  a_thread = 1u << 4,           ///< "thread.main"
  a_mechanism = 1u << 5,        ///< "mechanism.m1": its towing thread
  a_net_edge = 1u << 6,         ///< "net.main.top"
  a_net_corner = 1u << 7,       ///< "net.main.top_left"
  a_net_knot = 1u << 8,         ///< "net.main.knot.3.4"
  a_thread_node = 1u << 9,      ///< "thread.main.start", "thread.main.node.7"
  a_mechanism_mass = 1u << 10,  ///< "mechanism.m1.launcher"
  a_ring = 1u << 11,            ///< "ring.r1"
  any_node = a_net_corner | a_net_knot | a_thread_node | a_mechanism_mass | a_ring,
};

/// A reference cut at its dots: kind.name.place.
struct Reference {
  std::string kind, name, place;
  explicit Reference(const std::string& text);
};

/// What is wrong with a reference, and what would be right.
struct ReferenceProblem {
  std::string message, help;
};

/// Knows the names of a case and what its parts consist of.
class References {
 public:
  explicit References(const Scene& scene) : scene_(scene) {}
  /// Makes a name known; names of faulty parts too, so that one mistake is told once.
  void add(const std::string& kind, const std::string& name) {
    if (known_[kind].insert(name).second) names_[kind].push_back(name);
  }
  /// Some names of a kind are missing because of another error: unknown ones are not told again.
  void set_incomplete(const std::string& kind) { incomplete_.insert(kind); }
  /// Nothing, or what is wrong.
  std::optional<ReferenceProblem> check(const std::string& text, unsigned forms) const;
  /// Elements along "net.main.top" or "thread.main"; -1 when that part is unknown or faulty.
  int elements_along(const Reference& reference) const;
  const Net* net(const std::string& name) const;
  const Thread* thread(const std::string& name) const;
  const std::vector<std::string>& names(const std::string& kind) const;

 private:
  std::optional<ReferenceProblem> check_name(const std::string& kind, const std::string& name) const;
  std::optional<ReferenceProblem> check_place(const Reference& reference, unsigned forms) const;
  std::optional<ReferenceProblem> check_number(const Reference& reference) const;

  const Scene& scene_;
  std::map<std::string, std::vector<std::string>> names_;  // in the order of the file
  std::map<std::string, std::set<std::string>> known_;     // the same, to be found fast
  std::set<std::string> incomplete_;
};

/// The numbers of "knot.I.J"; nothing when the text is no such place.
std::optional<std::pair<int, int>> knot_of(const std::string& place);
/// A whole number written in digits only.
std::optional<int> digits(const std::string& text);

}  // namespace cinch
