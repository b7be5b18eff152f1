// Parts of a scene: what the rows of their sections cannot express.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/case_builder.hpp"

namespace cinch {

namespace {

constexpr double max_meshes = 1e8;          // of one net, times the elements of a mesh side
constexpr std::size_t max_rings = 100000;   // of a case: each is looked at by itself in every step
constexpr std::size_t max_tables = 100000;  // of a case: parts and nodes

std::string toml_vector(const Vec3& v) {
  return "[" + toml_text(v.x()) + ", " + toml_text(v.y()) + ", " + toml_text(v.z()) + "]";
}

bool is_whole(double number) { return std::abs(number - std::round(number)) < 1e-6; }

// A sub-table; one of another type was refused when its section was read.
const TomlMember* table_in(const TomlValue& section, const char* key) {
  const TomlMember* member = section.find(key);
  return member && member->value.type == TomlValue::Type::table ? member : nullptr;
}

// From the net's centre to a corner, in the net's plane.
Vec3 outward_diagonal(const Net& net, const std::string& corner) {
  const double x = corner.find("left") != std::string::npos ? -1 : 1;
  const double y = corner.find("bottom") != std::string::npos ? -1 : 1;
  return (x * net.width * net.x_axis + y * net.height * net.y_axis).normalized();
}

// What [net.NAME.node.knot.3.4] meant, whose dots make tables inside each other.
std::string first_knot(const TomlMember& knot) {
  const auto& columns = knot.value.members;
  if (columns.empty() || columns[0].value.members.empty()) return "knot.3.4";
  return "knot." + columns[0].key + "." + columns[0].value.members[0].key;
}

unsigned probe_forms(ProbeQuantity quantity) {
  switch (quantity) {
    case ProbeQuantity::tension:
      return a_net | a_thread | a_mechanism | any_node;
    case ProbeQuantity::material_coordinate:
      return a_ring;
    case ProbeQuantity::mouth_area:
    case ProbeQuantity::mouth_spread:
    case ProbeQuantity::energy:
      return 0;
    default:
      return any_node;
  }
}

}  // namespace

void CaseBuilder::read_material(const TomlMember& member) {
  Material material;
  const SectionValues& values = read_part(material_section(), member, material);
  const bool needed = material.damping_rule == DampingRule::stiffness;
  if (values.sound && needed != values.given("damping_frequency_rad_s"))
    fail(values.place_of(needed ? "damping_rule" : "damping_frequency_rad_s"),
         needed ? "missing key '" + values.path +
                      ".damping_frequency_rad_s', needed by damping_rule = \"stiffness\""
                : "'" + values.path +
                      ".damping_frequency_rad_s' has a meaning only with damping_rule = \"stiffness\"");
  scene_.materials[material.name] = material;
}

void CaseBuilder::check_guide(const SectionValues& values, Support support) {
  const bool guided = support == Support::guided;
  if (!values.sound || guided == values.given("axis")) return;
  fail(values.place_of(guided ? "support" : "axis"),
       guided ? "missing key '" + values.path + ".axis', needed by support = \"guided\""
              : "'" + values.path + ".axis' has a meaning only with support = \"guided\"");
}

NodeSpec CaseBuilder::read_node(const std::string& path, const TomlMember& member) {
  NodeSpec node;
  if (member.value.type != TomlValue::Type::table) {
    fail(member.value.place,
         path + ": found " + describe(member.value) + ", allowed: a table of the keys of a node");
    return node;
  }
  if (sections_.size() >= max_tables) {
    fail(member.key_place, "the case has more than " + std::to_string(max_tables) + " parts and nodes");
    diagnostics_.throw_all();
  }
  node.source.text = diagnostics_.where(member.key_place);
  sections_.push_back(
      cinch::read_section(node_section(), path, member.key_place, member.value, method_, diagnostics_, node));
  check_guide(sections_.back(), node.support);
  return node;
}

void CaseBuilder::read_thread(const TomlMember& member) {
  Thread thread;
  const SectionValues& values = read_part(thread_section(), member, thread);
  const std::string path = values.path;
  bool sound = values.sound;
  if (values.given("along") && thread.along.empty())
    fail(values.place_of("along"), path + ".along: found [], allowed: one part or more");
  for (std::size_t i = 1; i < thread.points.size(); ++i)
    if (!((thread.points[i] - thread.points[i - 1]).norm() > 0))  // which may be too small for its square
      fail(values.find("points_m")->value.toml.items[i].place,
           path + ".points_m: a point equal to the one before, allowed: points that differ");
  if (const TomlMember* start = table_in(member.value, "start"))
    thread.start = read_node(path + ".start", *start);
  if (const TomlMember* end = table_in(member.value, "end")) thread.end = read_node(path + ".end", *end);
  if (const TomlMember* nodes = member.value.find("node"))
    for (const TomlMember& node : nodes->value.members) {
      const auto number = digits(node.key);
      const std::string node_path = path + ".node." + toml_key(node.key);
      const bool end_node = number && ((*number == 0 && member.value.find("start")) ||
                                       (*number == thread.elements && member.value.find("end")));
      if (!number || (sound && *number > thread.elements) || std::to_string(*number) != node.key)
        fail(node.key_place, "'" + node_path + "': no such node",
             "allowed: 0 to " + std::to_string(thread.elements) + ", the thread's elements");
      else if (end_node) fail(node.key_place, "'" + node_path + "' is the node of 'start' or 'end' as well");
      else thread.nodes[*number] = read_node(node_path, node);
    }
  scene_.threads.push_back(thread);
}

bool CaseBuilder::check_meshes(const Net& net, SectionValues& values) {
  const double columns = net.width / net.mesh, rows = net.height / net.mesh;
  if (columns * rows * net.elements_per_side > max_meshes || std::max(columns, rows) > max_meshes) {
    fail(values.place_of("mesh_m"), values.path + ".mesh_m: found " + toml_text(net.mesh) + ", which makes " +
                                        toml_text(columns * rows) + " meshes, allowed: <= " +
                                        toml_text(max_meshes) + " over elements_per_side");
    return false;
  }
  if (is_whole(columns) && is_whole(rows) && std::min(columns, rows) > 0.5) return true;
  fail(values.place_of("mesh_m"), values.path + ".mesh_m: found " + toml_text(net.mesh) + " with size_m = [" +
                                      toml_text(net.width) + ", " + toml_text(net.height) +
                                      "], allowed: a whole number of meshes along each side (here " +
                                      toml_text(columns) + " and " + toml_text(rows) + ")");
  return false;
}

void CaseBuilder::read_net(const TomlMember& member) {
  Net net;
  SectionValues& values = read_part(net_section(), member, net);
  const std::string path = values.path;
  if (!values.sound || !check_meshes(net, values)) return;
  if (std::abs(net.x_axis.dot(net.y_axis)) > 1e-9)
    fail(values.place_of("y_axis"), path + ".y_axis: found " + toml_vector(net.y_axis) +
                                        " beside x_axis = " + toml_vector(net.x_axis) +
                                        ", allowed: a direction at right angles to x_axis");
  scene_.nets.push_back(net);
  const TomlMember* nodes = member.value.find("node");
  if (!nodes) return;
  std::map<std::string, NodeSpec> specs;
  for (const TomlMember& node : nodes->value.members) {
    const std::string node_path = path + ".node." + toml_key(node.key);
    const auto problem = references_.check("net." + net.name + "." + node.key, a_net_corner | a_net_knot);
    if (problem && node.key == "knot" && node.value.type == TomlValue::Type::table)
      fail(node.key_place, "'" + node_path + "': the name of a knot has dots, so it needs quotes",
           "example: [" + path + ".node.\"" + first_knot(node) + "\"]");
    else if (problem) fail(node.key_place, "'" + node_path + "': " + problem->message, problem->help);
    else specs[node.key] = read_node(node_path, node);
  }
  scene_.nets.back().nodes = specs;
}

// The launch velocity, and the defaults that depend on the net.
void CaseBuilder::complete_launch(Mechanism& mechanism, SectionValues& values, const Net& net) {
  if (!values.given("initial_stretch")) {
    mechanism.initial_stretch = net.stowed_factor;
    values.set_default("initial_stretch", toml_text(net.stowed_factor));
  }
  if (values.given("launch_velocity_m_s")) return;
  const Vec3 normal = net.x_axis.cross(net.y_axis);
  if (!values.given("launch_axis")) values.set_default("launch_axis", toml_vector(normal));
  const Vec3 axis =
      values.given("launch_axis") ? values.find("launch_axis")->value.vector.normalized() : normal;
  const double speed = values.find("launch_speed_m_s")->value.number;
  const double angle = values.find("launch_angle_deg")->value.number * std::numbers::pi / 180;
  mechanism.launch_velocity =
      speed *
      (std::cos(angle) * axis + std::sin(angle) * outward_diagonal(net, Reference(mechanism.corner).place));
}

void CaseBuilder::read_mechanism(const TomlMember& member) {
  Mechanism mechanism;
  SectionValues& values = read_part(mechanism_section(), member, mechanism);
  const auto same = std::find_if(scene_.mechanisms.begin(), scene_.mechanisms.end(),
                                 [&](const Mechanism& other) { return other.corner == mechanism.corner; });
  if (values.sound && same != scene_.mechanisms.end())
    fail(values.place_of("corner"), values.path + ".corner: found " + toml_text(mechanism.corner) +
                                        ", on which mechanism '" + same->name +
                                        "' hangs, allowed: a corner of its own for each");
  const Net* net = references_.net(Reference(mechanism.corner).name);
  if (values.sound && net) complete_launch(mechanism, values, *net);
  scene_.mechanisms.push_back(mechanism);
}

void CaseBuilder::add_ring(const Ring& ring, Place place) {
  if (!ring_names_.insert(ring.name).second)
    fail(place, "a second ring is called '" + ring.name + "'", "rename the [ring.NAME] or the [rings.NAME]");
  else scene_.rings.push_back(ring);
}

void CaseBuilder::check_ring_element(const Ring& ring, const SectionValues& values) {
  if (ring.diameter <= ring.wire_diameter)
    fail(values.place_of("wire_diameter_m"),
         values.path + ".wire_diameter_m: found " + toml_text(ring.wire_diameter) +
             ", allowed: below diameter_m = " + toml_text(ring.diameter) + " m");
  if (ring.host != RingHost::element) return;
  const int elements = references_.elements_along(Reference(ring.element_of));
  if (elements >= 0 && ring.element >= elements)
    fail(values.place_of("element"), values.path + ".element: found " + std::to_string(ring.element) +
                                         ", allowed: 0 to " + std::to_string(elements - 1) + " on " +
                                         ring.element_of);
}

void CaseBuilder::read_ring(const TomlMember& member) {
  Ring ring;
  const SectionValues& values = read_part(ring_section(), member, ring);
  ring.host = values.given("on") ? RingHost::element : RingHost::node;
  if (values.sound) check_ring_element(ring, values);
  if (ring.host == RingHost::node) check_guide(values, ring.support);
  add_ring(ring, member.key_place);
}

void CaseBuilder::read_rings(const TomlMember& member) {
  RingRow row;
  const SectionValues& values = read_part(rings_section(), member, row);
  const Net* net = references_.net(row.net);
  if (!values.sound || !net) return references_.set_incomplete("ring");
  check_ring_element(row.ring, values);
  const auto meshes_on = [net](const std::string& edge) {
    return edge == "top" || edge == "bottom" ? net->columns() : net->rows();
  };
  std::size_t rings = scene_.rings.size();
  for (const std::string& edge : row.edges)
    rings += row.cells.empty() ? static_cast<std::size_t>(meshes_on(edge)) : row.cells.size();
  if (rings > max_rings) {
    fail(values.place_of("cells"), values.path + ".cells: with them the case has " + std::to_string(rings) +
                                       " rings, allowed: <= " + std::to_string(max_rings));
    return references_.set_incomplete("ring");
  }
  int number = 0;
  for (const std::string& edge : row.edges) {
    const int meshes = meshes_on(edge);
    std::vector<int> cells = row.cells;
    if (cells.empty())
      for (int cell = 1; cell <= meshes; ++cell) cells.push_back(cell);
    for (const int cell : cells) {
      Ring ring = row.ring;
      ring.name = row.name + std::to_string(++number);
      ring.source = row.source;
      ring.host = RingHost::element;
      ring.element_of = "net." + net->name + "." + edge;
      if (cell > meshes)
        fail(values.place_of("cells"), values.path + ".cells: found " + std::to_string(cell) +
                                           ", allowed: 1 to " + std::to_string(meshes) + " on " +
                                           ring.element_of);
      else {
        ring.element = (cell - 1) * net->elements_per_side + net->elements_per_side / 2;
        add_ring(ring, member.key_place);
        references_.add("ring", ring.name);
      }
    }
  }
}

void CaseBuilder::read_target(const TomlMember& member) {
  BallTarget target;
  read_part(target_section(), member, target);
  scene_.targets.push_back(target);
}

void CaseBuilder::read_probe(const TomlMember& member) {
  Probe probe;
  const SectionValues& values = read_part(probe_section(), member, probe);
  if (!values.sound) return;
  const unsigned forms = probe_forms(probe.quantity);
  const std::string quantity = values.find("quantity")->value.text();
  if (forms == 0 && !probe.of.empty())
    fail(values.place_of("of"),
         "'" + values.path + ".of' has no meaning: " + quantity + " is of the whole scene");
  // rings may be missing because of another mistake
  const bool told = !diagnostics_.empty() && (document_.find("ring") || document_.find("rings"));
  if (forms == 0 && probe.quantity != ProbeQuantity::energy && scene_.rings.empty() && !told)
    fail(values.place_of("quantity"),
         values.path + ".quantity: found \"" + quantity + "\" in a case without rings");
  if (forms != 0 && probe.of.empty())
    fail(values.place, "missing key '" + values.path + ".of'", "example: of = \"thread.main.start\"");
  if (forms != 0 && !probe.of.empty())
    if (const auto problem = references_.check(probe.of, forms))
      fail(values.place_of("of"), values.path + ".of: " + problem->message, problem->help);
  scene_.probes.push_back(probe);
}

}  // namespace cinch
