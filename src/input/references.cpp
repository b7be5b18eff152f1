#include "input/references.hpp"

#include <algorithm>
#include <array>

#include "input/nearest_key.hpp"

namespace cinch {

namespace {

// Every form but the plain names: the kind before the first dot, the places behind the second, and the forms
// in words.
struct FormRow {
  Form form;
  const char* kind;
  std::vector<std::string> places;  // empty: none; "" stands for a whole part
  const char* text;
};

const std::vector<FormRow>& form_rows() {
  static const std::vector<FormRow> rows = {
      {a_net, "net", {""}, "net.NAME"},
      {a_thread, "thread", {""}, "thread.NAME"},
      {a_mechanism, "mechanism", {""}, "mechanism.NAME"},
      {a_net_edge, "net", {"top", "right", "bottom", "left"}, "net.NAME.top|right|bottom|left"},
      {a_net_corner,
       "net",
       {"top_left", "top_right", "bottom_right", "bottom_left"},
       "net.NAME.top_left|top_right|bottom_right|bottom_left"},
      {a_net_knot, "net", {"knot.I.J"}, "net.NAME.knot.I.J"},
      {a_thread_node, "thread", {"start", "end", "node.K"}, "thread.NAME.start|end|node.K"},
      {a_mechanism_mass, "mechanism", {"launcher", "a", "b"}, "mechanism.NAME.launcher|a|b"},
      {a_ring, "ring", {""}, "ring.NAME"},
  };
  return rows;
}

std::optional<int> thread_node_of(const std::string& place) {
  return place.compare(0, 5, "node.") == 0 ? digits(place.substr(5)) : std::nullopt;
}

bool matches(const std::string& pattern, const std::string& place) {
  if (pattern == "knot.I.J") return knot_of(place).has_value();
  if (pattern == "node.K") return thread_node_of(place).has_value();
  return pattern == place;
}

std::string forms_text(unsigned forms) {
  std::string text;
  for (const FormRow& row : form_rows())
    if (forms & row.form) text += (text.empty() ? "" : ", ") + std::string(row.text);
  return "allowed: " + text;
}

template <class Part>
const Part* by_name(const std::vector<Part>& parts, const std::string& name) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

}  // namespace

std::optional<int> digits(const std::string& text) {
  if (text.empty() || text.size() > 9) return std::nullopt;
  int number = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    number = 10 * number + (c - '0');
  }
  return number;
}

std::optional<std::pair<int, int>> knot_of(const std::string& place) {
  if (place.compare(0, 5, "knot.") != 0) return std::nullopt;
  const std::size_t dot = place.find('.', 5);
  if (dot == std::string::npos) return std::nullopt;
  const auto column = digits(place.substr(5, dot - 5)), row = digits(place.substr(dot + 1));
  if (!column || !row) return std::nullopt;
  return std::pair(*column, *row);
}

Reference::Reference(const std::string& text) {
  const std::size_t first = std::min(text.find('.'), text.size());
  const std::size_t second = std::min(text.find('.', first + 1), text.size());
  kind = text.substr(0, first);
  if (first < text.size()) name = text.substr(first + 1, second - first - 1);
  if (second < text.size()) place = text.substr(second + 1);
}

const std::vector<std::string>& References::names(const std::string& kind) const {
  static const std::vector<std::string> none;
  const auto found = names_.find(kind);
  return found == names_.end() ? none : found->second;
}

const Net* References::net(const std::string& name) const { return by_name(scene_.nets, name); }
const Thread* References::thread(const std::string& name) const { return by_name(scene_.threads, name); }

int References::elements_along(const Reference& reference) const {
  if (reference.kind == "thread") {
    const Thread* found = thread(reference.name);
    return found ? found->elements : -1;
  }
  const Net* found = net(reference.name);
  if (!found) return -1;
  const bool across = reference.place == "top" || reference.place == "bottom";
  return (across ? found->columns() : found->rows()) * found->elements_per_side;
}

std::optional<ReferenceProblem> References::check_name(const std::string& kind,
                                                       const std::string& name) const {
  const auto& known = names(kind);
  const auto found = known_.find(kind);
  if (incomplete_.count(kind) || (found != known_.end() && found->second.count(name))) return std::nullopt;
  return ReferenceProblem{
      "unknown " + kind + " '" + name + "'" + did_you_mean(name, known),
      known.empty() ? "the case has no [" + kind + ".NAME]" : kind + "s of this case: " + list_of(known)};
}

std::optional<ReferenceProblem> References::check_place(const Reference& reference, unsigned forms) const {
  std::vector<std::string> allowed;
  for (const FormRow& row : form_rows()) {
    if (!(forms & row.form) || row.kind != reference.kind) continue;
    for (const std::string& pattern : row.places) {
      if (matches(pattern, reference.place)) return std::nullopt;
      if (!pattern.empty()) allowed.push_back(pattern);
    }
  }
  const std::string part = reference.kind + "." + reference.name;
  const std::string message = reference.place.empty()
                                  ? "'" + part + "' lacks its last part, the place"
                                  : "no place '" + reference.place + "' of '" + part + "' can be used here" +
                                        did_you_mean(reference.place, allowed);
  return ReferenceProblem{message, forms_text(forms)};
}

std::optional<ReferenceProblem> References::check_number(const Reference& reference) const {
  if (const auto node = thread_node_of(reference.place); node && reference.kind == "thread") {
    const Thread* found = thread(reference.name);
    if (found && *node > found->elements)
      return ReferenceProblem{"thread '" + reference.name + "' has no node " + std::to_string(*node),
                              "allowed: 0 to " + std::to_string(found->elements)};
  }
  if (const auto knot = knot_of(reference.place); knot && reference.kind == "net") {
    const Net* found = net(reference.name);
    if (found && (knot->first > found->columns() || knot->second > found->rows()))
      return ReferenceProblem{"net '" + reference.name + "' has no '" + reference.place + "'",
                              "allowed: knot.0.0 to knot." + std::to_string(found->columns()) + "." +
                                  std::to_string(found->rows())};
  }
  return std::nullopt;
}

std::optional<ReferenceProblem> References::check(const std::string& text, unsigned forms) const {
  if (forms & a_material_name) return check_name("material", text);
  if (forms & a_net_name) return check_name("net", text);
  if (forms & a_thread_name) return check_name("thread", text);
  const Reference reference(text);
  std::vector<std::string> kinds;
  for (const FormRow& row : form_rows())
    if (forms & row.form) kinds.push_back(row.kind);
  if (std::find(kinds.begin(), kinds.end(), reference.kind) == kinds.end())
    return ReferenceProblem{"'" + text + "' cannot be used here" + did_you_mean(reference.kind, kinds),
                            forms_text(forms)};
  if (auto problem = check_name(reference.kind, reference.name)) return problem;
  if (auto problem = check_place(reference, forms)) return problem;
  return check_number(reference);
}

}  // namespace cinch
