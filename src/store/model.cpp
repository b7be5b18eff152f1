#include "store/model.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "store/topology.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void fill_nodes(Model& model, const Assembly& assembly, Stage stage) {
  const bool before = stage == Stage::before_closing && assembly.has_closing();
  model.nodes = before ? assembly.nodes_before : static_cast<Index>(assembly.nodes.size());
  model.mass.reserve(at(model.nodes));
  for (Index i = 0; i < model.nodes; ++i) {
    const AssemblyNode& node = assembly.nodes[at(i)];
    const double mass = before ? node.mass_before : node.mass;
    if (!(mass > 0)) throw CaseError("error: node " + std::to_string(i) + " has no mass");
    model.mass.push_back(mass);
    if (node.support == Support::fixed) model.constraints.push_back({i, 0, 0, 0, mass});
    if (node.support == Support::guided)
      model.constraints.push_back({i, node.axis.x(), node.axis.y(), node.axis.z(), mass});
  }
}

void fill_elements(Model& model, const Assembly& assembly, Stage stage) {
  const bool before = stage == Stage::before_closing && assembly.has_closing();
  model.elements = before ? assembly.elements_before : static_cast<Index>(assembly.elements.size());
  for (auto* field : {&model.stiffness, &model.damping, &model.rest_length, &model.radius, &model.compliance})
    field->reserve(at(model.elements));
  model.end_a.reserve(at(model.elements));
  model.end_b.reserve(at(model.elements));
  for (Index i = 0; i < model.elements; ++i) {
    const AssemblyElement& e = assembly.elements[at(i)];
    model.stiffness.push_back(e.stiffness);
    model.damping.push_back(e.damping);
    model.rest_length.push_back(e.rest_length);
    model.end_a.push_back(e.a);
    model.end_b.push_back(e.b);
    model.radius.push_back(e.radius);
    model.compliance.push_back(e.compliance);
    model.damped = model.damped || e.damping > 0;
  }
}

ContactSet make_set(const Model& model, const Assembly& assembly, const std::vector<Index>& parts,
                    bool count_once) {
  ContactSet set;
  set.parts = parts;
  std::vector<bool> wanted(assembly.parts.size());
  for (const Index p : parts) wanted[at(p)] = true;
  std::vector<Index> degree(at(model.nodes));
  for (Index e = 0; e < model.elements; ++e) {
    if (!wanted[at(assembly.elements[at(e)].part)]) continue;
    set.elements.push_back(e);
    set.thickest = std::max(set.thickest, model.radius[at(e)]);
    set.thinnest = std::min(set.thinnest, model.radius[at(e)]);
    ++degree[at(model.end_a[at(e)])];
    ++degree[at(model.end_b[at(e)])];
  }
  const auto fraction = [&](Index node) { return count_once ? 1.0 / degree[at(node)] : 0.0; };
  for (const Index e : set.elements) {
    set.fraction_a.push_back(fraction(model.end_a[at(e)]));
    set.fraction_b.push_back(fraction(model.end_b[at(e)]));
  }
  return set;
}

// Rings and balls that touch the same parts share one set.
Index set_for(Model& model, const Assembly& assembly, const std::vector<Index>& parts, bool count_once) {
  for (std::size_t s = 0; s < model.contact_sets.size(); ++s)
    if (model.contact_sets[s].parts == parts) return static_cast<Index>(s);
  model.contact_sets.push_back(make_set(model, assembly, parts, count_once));
  return static_cast<Index>(model.contact_sets.size()) - 1;
}

// The threads that a ring can touch in this phase; a ring on a closing thread is not there before it.
std::vector<Index> parts_now(const Model& model, const Assembly& assembly, const AssemblyRing& ring) {
  std::vector<Index> parts;
  if (ring.element >= model.elements) return parts;
  for (const Index p : ring.parts)
    if (assembly.parts[at(p)].first_element < model.elements) parts.push_back(p);
  return parts;
}

// How near the ends of a sliding ring's host come to each other. Far shorter ones turn their ring by any
// angle in a step. A folded net begins with nothing pressed.
double least_host(const Model& model, const Assembly& assembly, const AssemblyRing& ring) {
  const double begins =
      (assembly.nodes[at(ring.host_b)].position - assembly.nodes[at(ring.host_a)].position).norm();
  return std::min(0.02 * model.rest_length[at(ring.element)], 0.5 * begins);
}

kernel::Joint joint_of(const Model& model, const Assembly& assembly, const AssemblyRing& ring, Index number,
                       Index first_element) {
  kernel::Joint joint{number, ring.host_a, ring.host_b, {}, 0, 0, 0};
  if (ring.element >= 0) {
    joint.host_least = least_host(model, assembly, ring);
    joint.host_stiffness = model.stiffness[at(ring.element)] / static_cast<double>(ring.threadings.size());
  }
  for (int d = 0; d < 3; ++d) joint.normal[d] = ring.normal[d];
  joint.opening = ring.radius - ring.wire_radius - model.radius[at(first_element)];
  return joint;
}

// The joints of one thread, in their order along it.
void fill_joints(Model& model, const Assembly& assembly, Index number) {
  const Part& part = assembly.parts[at(number)];
  struct Place {
    double along;
    Index ring;
  };
  std::vector<Place> places;
  for (std::size_t r = 0; r < assembly.rings.size(); ++r)
    for (const Threading& threading : assembly.rings[r].threadings)
      if (threading.part == number && assembly.rings[r].element < model.elements)
        places.push_back({threading.along, static_cast<Index>(r)});
  if (places.empty()) return;
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& l, const Place& r) { return l.along < r.along; });
  const auto joint_begin = static_cast<Index>(model.joints.size());
  for (const Place& place : places) {
    model.joints.push_back(
        joint_of(model, assembly, assembly.rings[at(place.ring)], place.ring, part.first_element));
    model.joint_element.push_back(std::clamp(static_cast<Index>(place.along), 0, part.elements - 1));
  }
  const auto e = at(part.first_element);
  model.sliding_first.push_back(part.first_element);
  model.sliding_threads.push_back({static_cast<Index>(model.sliding_nodes.size()), part.elements, joint_begin,
                                   static_cast<Index>(model.joints.size()), model.stiffness[e],
                                   model.damping[e], model.rest_length[e], true});
  model.sliding_nodes.insert(model.sliding_nodes.end(), part.nodes.begin(), part.nodes.end());
}

void fill_sliding(Model& model, const Assembly& assembly) {
  for (std::size_t p = 0; p < assembly.parts.size(); ++p)
    if (assembly.parts[p].kind == PartKind::thread && assembly.parts[p].first_element < model.elements)
      fill_joints(model, assembly, static_cast<Index>(p));
}

// All rings of the scene, or none when no ring has anything to touch in this phase.
void fill_rings(Model& model, const Assembly& assembly, bool count_once) {
  std::size_t touching = 0;
  for (const AssemblyRing& ring : assembly.rings) touching += parts_now(model, assembly, ring).size();
  model.ring_contacts = touching > 0;
  if (touching == 0 && model.joints.empty()) return;
  for (const AssemblyRing& ring : assembly.rings) {
    kernel::RingGeometry geometry{};
    const std::vector<Index> parts = parts_now(model, assembly, ring);
    if (ring.element >= model.elements) {
      geometry.a = geometry.b = 0;  // touches nothing yet: never read
    } else if (ring.element >= 0) {
      geometry.a = assembly.elements[at(ring.element)].a;
      geometry.b = assembly.elements[at(ring.element)].b;
    } else {
      geometry.a = geometry.b = ring.node;
    }
    for (int d = 0; d < 3; ++d) geometry.normal[d] = ring.normal[d];
    geometry.radius = ring.radius;
    model.ring_set.push_back(set_for(model, assembly, parts, count_once));
    geometry.reach = ring.radius + ring.wire_radius + model.contact_sets[at(model.ring_set.back())].thickest;
    model.rings.push_back(geometry);
    model.ring_wire_radius.push_back(ring.wire_radius);
    model.ring_compliance.push_back(ring.compliance);
    model.ring_host_length.push_back(ring.element >= 0 ? assembly.elements[at(ring.element)].rest_length : 0);
    model.ring_slides.push_back(!ring.threadings.empty());
  }
}

void fill_balls(Model& model, const Assembly& assembly, bool count_once) {
  for (const AssemblyBall& ball : assembly.balls) {
    model.balls.push_back(
        {ball.center, ball.radius, ball.compliance, set_for(model, assembly, ball.parts, count_once), {}});
    for (const Index s : ball.spheres) {
      const AssemblySphere& sphere = assembly.spheres[at(s)];
      if (sphere.node < model.nodes)  // split masses come with the closing
        model.balls.back().spheres.push_back(
            {sphere.node, sphere.radius, sphere.compliance.value_or(ball.compliance)});
    }
  }
}

}  // namespace

Model build_model(const Assembly& assembly, const Scene& scene, Stage stage) {
  Model model;
  fill_nodes(model, assembly, stage);
  fill_elements(model, assembly, stage);
  model.topology = cut_runs(model.end_a, model.end_b);
  const bool count_once = scene.contact.shared_node == SharedNode::once;
  fill_sliding(model, assembly);
  fill_rings(model, assembly, count_once);
  fill_balls(model, assembly, count_once);
  if (scene.gravity) {
    model.gravity = *scene.gravity;
    model.has_gravity = model.gravity.norm() > 0;
  }
  return model;
}

double mobility(const Model& model, Index node) {
  const auto found = std::lower_bound(model.constraints.begin(), model.constraints.end(), node,
                                      [](const kernel::Constraint& c, Index n) { return c.node < n; });
  const bool fixed = found != model.constraints.end() && found->node == node && found->ax == 0 &&
                     found->ay == 0 && found->az == 0;
  return fixed ? 0.0 : 1 / model.mass[at(node)];
}

}  // namespace cinch
