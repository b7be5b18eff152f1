#include "scene/assembly.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "base/error.hpp"
#include "base/machine.hpp"
#include "scene/closing_loads.hpp"
#include "scene/extent.hpp"
#include "scene/fault.hpp"
#include "scene/net_pattern.hpp"
#include "scene/spring.hpp"
#include "scene/thread_path.hpp"
#include "scene/threading.hpp"

namespace cinch {
namespace {

// "kind.name.place" -> {kind, name, place}; the place may hold further dots.
struct Reference {
  std::string kind, name, place;
  explicit Reference(const std::string& text) {
    const auto first = text.find('.');
    kind = text.substr(0, first);
    if (first == std::string::npos) return;
    const auto second = text.find('.', first + 1);
    name = text.substr(first + 1, second == std::string::npos ? second : second - first - 1);
    if (second != std::string::npos) place = text.substr(second + 1);
  }
};

// Builds an Assembly part by part, in the order of the numbering.
class Assembler {
 public:
  explicit Assembler(const Scene& scene) : scene_(scene) {}

  Assembly build() {
    reserve();
    for (const Net& net : scene_.nets) add_net(net);
    for (const Mechanism& mechanism : scene_.mechanisms) add_towing(mechanism);
    for (const Thread& thread : scene_.threads)
      if (!thread.closing()) add_thread(thread);
    for (const Ring& ring : scene_.rings)
      if (ring.host == RingHost::node) ring_node(ring);
    out_.nodes_before = node_count();
    out_.elements_before = element_count();
    // split masses on which a closing thread hangs are numbered with it, as its ends
    for (const Thread& thread : scene_.threads)
      if (thread.closing()) add_closing_thread(thread);
    for (const Mechanism& mechanism : scene_.mechanisms)
      for (const char side : {'a', 'b'}) split_mass(mechanism, side);
    for (const Ring& ring : scene_.rings) add_ring(ring);
    thread_rings(scene_, carriers_, out_);
    for (const BallTarget& ball : scene_.targets) add_ball(ball);
    superpose_closing_masses(carriers_, out_);
    balance_separations();
    return std::move(out_);
  }

 private:
  Index node_count() const { return static_cast<Index>(out_.nodes.size()); }
  Index element_count() const { return static_cast<Index>(out_.elements.size()); }
  AssemblyNode& node(Index i) { return out_.nodes[static_cast<std::size_t>(i)]; }

  // Room for all, so that nothing is moved while it grows. No thread shares so many nodes that it matters.
  void reserve() {
    const Extent extent = extent_of(scene_);
    require_room(extent, machine_memory());
    out_.nodes.reserve(static_cast<std::size_t>(extent.nodes));
    out_.elements.reserve(static_cast<std::size_t>(extent.elements));
  }

  Index add_node(const Vec3& position, const Vec3& velocity) {
    AssemblyNode fresh;
    fresh.position = position;
    fresh.velocity = velocity;
    out_.nodes.push_back(fresh);
    return node_count() - 1;
  }

  Index begin_part(PartKind kind, const std::string& name, bool closing = false) {
    Part part{kind, name, element_count(), 0, {}, closing};
    out_.parts.push_back(part);
    return static_cast<Index>(out_.parts.size()) - 1;
  }

  Part* find_part(PartKind kind, const std::string& name) {
    for (Part& part : out_.parts)
      if (part.kind == kind && part.name == name) return &part;
    return nullptr;
  }

  const Material& material(const std::string& name, const SourceRef& source) const {
    const auto found = scene_.materials.find(name);
    if (found == scene_.materials.end()) fail(source, "unknown material '" + name + "'");
    return found->second;
  }

  // Half of an element's mass goes to each end (eq. (2)).
  void add_element(Index a, Index b, const Spring& spring) {
    AssemblyElement& e = out_.elements.emplace_back(spring.element);
    e.a = a;
    e.b = b;
    out_.parts[static_cast<std::size_t>(e.part)].elements += 1;
    node(a).mass += spring.mass / 2;
    node(b).mass += spring.mass / 2;
  }

  void add_sphere(const Sphere& sphere, Index at, const std::string& name, Index part) {
    if (!(sphere.radius > 0)) return;
    AssemblySphere s{name, at, sphere.radius, std::nullopt, part};
    if (sphere.youngs_modulus > 0) s.compliance = compliance(sphere.youngs_modulus, sphere.poissons_ratio);
    out_.spheres.push_back(std::move(s));
  }

  void apply(const NodeSpec& spec, Index at, const std::string& name, Index part) {
    AssemblyNode& n = node(at);
    n.mass += spec.mass;
    if (spec.support != Support::free) {
      n.support = spec.support;
      n.axis = spec.axis.normalized();
    }
    if (spec.velocity) n.velocity = *spec.velocity;
    if (n.support == Support::fixed) n.velocity.setZero();
    if (n.support == Support::guided) n.velocity = n.axis.dot(n.velocity) * n.axis;
    if (spec.mass > 0) out_.named.push_back({name, at, spec.mass});
    add_sphere(spec.sphere, at, name, part);
  }

  void add_net(const Net& net) {
    const NetPattern pattern(net);
    out_.net_shapes[net.name] = net;
    const Index part = begin_part(PartKind::net, net.name);
    const Index first = node_count();
    pattern.for_each_node([&](double x, double y) {
      add_node(net.center + net.stowed_factor * (x * net.x_axis + y * net.y_axis), net.velocity);
    });
    out_.parts.back().nodes.resize(static_cast<std::size_t>(pattern.nodes()));
    std::iota(out_.parts.back().nodes.begin(), out_.parts.back().nodes.end(), first);
    const Spring element = spring_of(net.mesh / net.elements_per_side, net.diameter,
                                     material(net.material, net.source), part, net.source);
    pattern.for_each_element([&](Index a, Index b) { add_element(first + a, first + b, element); });
    for (const auto& [place, spec] : net.nodes) {
      const Index at = pattern.place(place);
      if (at < 0) fail(spec.source, "net '" + net.name + "' has no node '" + place + "'");
      apply(spec, first + at, "net." + net.name + "." + place, part);
    }
  }

  // Towing thread (paper Sec. 2): outwards along the corner's diagonal, launcher at its end.
  void add_towing(const Mechanism& mechanism) {
    const Index corner = node_of(mechanism.corner, mechanism.source);
    const Net& net = net_named(Reference(mechanism.corner).name, mechanism.source);
    const Vec3 from_center = node(corner).position - net.center;
    const Vec3 outward = from_center.normalized();
    const Index part = begin_part(PartKind::mechanism, mechanism.name);
    const double rest = mechanism.towing_length / mechanism.towing_elements;
    const Spring element =
        spring_of(rest, mechanism.towing_diameter, material(mechanism.towing_material, mechanism.source),
                  part, mechanism.source);
    std::vector<Index> nodes{corner};
    for (int k = 1; k <= mechanism.towing_elements; ++k) {
      const Vec3 at = node(corner).position + k * rest * mechanism.initial_stretch * outward;
      nodes.push_back(add_node(at, net.velocity));
      add_element(nodes[nodes.size() - 2], nodes.back(), element);
    }
    node(nodes.back()).velocity = mechanism.launch_velocity;
    node(nodes.back()).mass += mechanism.launcher_mass;
    out_.parts.back().nodes = nodes;
    const std::string launcher = "mechanism." + mechanism.name + ".launcher";
    out_.named.push_back({launcher, nodes.back(), mechanism.launcher_mass});
    add_sphere(mechanism.launcher_sphere, nodes.back(), launcher, part);
  }

  const Net& net_named(const std::string& name, const SourceRef& source) const {
    for (const Net& net : scene_.nets)
      if (net.name == name) return net;
    fail(source, "a closing mechanism hangs on the corner of a net; there is no net '" + name + "'");
  }

  const NodeSpec* spec_of(const Thread& thread, int k) const {
    if (k == 0) return &thread.start;
    if (k == thread.elements) return &thread.end;
    const auto found = thread.nodes.find(k);
    return found == thread.nodes.end() ? nullptr : &found->second;
  }

  static std::string node_name(const Thread& thread, int k) {
    const std::string prefix = "thread." + thread.name + ".";
    if (k == 0) return prefix + "start";
    if (k == thread.elements) return prefix + "end";
    return prefix + "node." + std::to_string(k);
  }

  // Nodes, masses and elements of a thread whose nodes add(k) adds, k = 0 .. elements. Returns an element's
  // mass.
  template <class Add>
  double add_thread_nodes(const Thread& thread, double rest, Add add) {
    const Index part = begin_part(PartKind::thread, thread.name, thread.closing());
    std::vector<Index> nodes;
    for (int k = 0; k <= thread.elements; ++k) {
      const NodeSpec* spec = spec_of(thread, k);
      const bool shared = spec != nullptr && !spec->on.empty();
      nodes.push_back(shared ? node_of(spec->on, spec->source) : add(k));
    }
    const Spring element =
        spring_of(rest, thread.diameter, material(thread.material, thread.source), part, thread.source);
    for (int k = 0; k < thread.elements; ++k) {
      const Index a = nodes[static_cast<std::size_t>(k)], b = nodes[static_cast<std::size_t>(k) + 1];
      if (a == b)
        fail(thread.source, "thread '" + thread.name + "' has an element with one and the same node");
      add_element(a, b, element);
    }
    for (int k = 0; k <= thread.elements; ++k)
      if (const NodeSpec* spec = spec_of(thread, k))
        apply(*spec, nodes[static_cast<std::size_t>(k)], node_name(thread, k), part);
    out_.parts[static_cast<std::size_t>(part)].nodes = std::move(nodes);
    return element.mass;
  }

  void add_thread(const Thread& thread) {
    const ThreadPath path(thread);
    const double length = thread.length > 0 ? thread.length : path.length();
    add_thread_nodes(thread, length / thread.elements,
                     [&](int k) { return add_node(path.node(k), thread.velocity); });
  }

  // The node that carries a ring; made when first asked for, which may be by a thread that hangs on it.
  Index ring_node(const Ring& ring) {
    if (const Part* part = find_part(PartKind::ring, ring.name)) return part->nodes.front();
    const Index part = begin_part(PartKind::ring, ring.name);
    const Index at = add_node(ring.center, ring.velocity);
    out_.parts.back().nodes = {at};
    NodeSpec spec;
    spec.mass = ring.mass;
    spec.support = ring.support;
    spec.axis = ring.axis;
    apply(spec, at, "ring." + ring.name, part);
    return at;
  }

  // Mass a or b, which sits on the launcher until the closing time; made when first asked for.
  Index split_mass(const Mechanism& mechanism, char side) {
    const std::string name = "mechanism." + mechanism.name + "." + side;
    if (const Index known = named_node(name); known >= 0) return known;
    const Part& towing = *find_part(PartKind::mechanism, mechanism.name);
    const Index launcher = towing.nodes.back(), part = static_cast<Index>(&towing - out_.parts.data());
    const Index at = add_node(node(launcher).position, node(launcher).velocity);
    node(at).mass = mechanism.split_mass;
    out_.lays.push_back({at, launcher, launcher, 0, Vec3::Zero(),
                         side == 'a' ? mechanism.separation_a : mechanism.separation_b});
    out_.named.push_back({name, at, mechanism.split_mass});
    add_sphere(mechanism.split_sphere, at, name, part);
    return at;
  }

  Index named_node(const std::string& name) const {
    for (const NamedNode& named : out_.named)
      if (named.name == name) return named.node;
    return -1;
  }

  std::vector<Index> polyline(const std::string& reference, const SourceRef& source) {
    const Reference at(reference);
    if (at.kind == "mechanism")
      if (const Part* part = find_part(PartKind::mechanism, at.name)) return part->nodes;
    if (at.kind == "thread")
      if (const Part* part = find_part(PartKind::thread, at.name); part && !part->closing) return part->nodes;
    if (at.kind == "net") {
      const Part* part = find_part(PartKind::net, at.name);
      if (part != nullptr) {
        std::vector<Index> nodes = NetPattern(net_named(at.name, source)).edge(at.place);
        for (Index& n : nodes) n += part->nodes.front();
        if (!nodes.empty()) return nodes;
      }
    }
    fail(source, "'" + reference + "' is no mechanism, thread or net edge that a thread can be laid along");
  }

  // The lists of incident elements grow when somebody asks: most scenes need them for few parts or none.
  void list_incident_elements() {
    latest_.resize(out_.nodes.size(), -1);
    for (Index half = static_cast<Index>(earlier_.size()); half < 2 * element_count(); ++half) {
      const AssemblyElement& e = out_.elements[static_cast<std::size_t>(half / 2)];
      Index& latest = latest_[static_cast<std::size_t>(half % 2 == 0 ? e.a : e.b)];
      earlier_.push_back(latest);
      latest = half;
    }
  }

  // The first element that joins a and b; walks those at a, the latest first.
  Index element_between(Index a, Index b) {
    list_incident_elements();
    Index found = -1;
    for (Index half = latest_[static_cast<std::size_t>(a)]; half >= 0;
         half = earlier_[static_cast<std::size_t>(half)]) {
      const AssemblyElement& item = out_.elements[static_cast<std::size_t>(half / 2)];
      if (item.a == b || item.b == b) found = half / 2;
    }
    return found;
  }

  Carrier carrier_of(const Thread& thread) {
    Carrier chain;
    for (std::size_t i = 0; i < thread.along.size(); ++i) {
      std::vector<Index> next = polyline(thread.along[i], thread.source);
      if (i == 0 && thread.along.size() > 1) {  // turn the first part so that its end meets the second one
        const std::vector<Index> second = polyline(thread.along[1], thread.source);
        if (next.front() == second.front() || next.front() == second.back())
          std::reverse(next.begin(), next.end());
      }
      if (!chain.nodes.empty()) {
        if (next.back() == chain.nodes.back()) std::reverse(next.begin(), next.end());
        if (next.front() != chain.nodes.back())
          fail(thread.source, "thread '" + thread.name + "': '" + thread.along[i] +
                                  "' does not begin where '" + thread.along[i - 1] + "' ends");
        next.erase(next.begin());
      }
      chain.nodes.insert(chain.nodes.end(), next.begin(), next.end());
    }
    chain.reach.push_back(0);
    for (std::size_t n = 1; n < chain.nodes.size(); ++n) {
      const Index e = element_between(chain.nodes[n - 1], chain.nodes[n]);
      chain.reach.push_back(chain.reach.back() + out_.elements[static_cast<std::size_t>(e)].rest_length);
    }
    return chain;
  }

  // Place of the point at distance s (from the start of the overhang) on the carrier.
  Lay lay_at(const Carrier& carrier, const Thread& thread, double s) {
    Lay lay;
    const double total = carrier.reach.back();
    const double reach = s - thread.overhang_start;
    const auto away = [&](Index end, Index inner) {
      return (node(end).position - node(inner).position).normalized();
    };
    const std::size_t last = carrier.nodes.size() - 1;
    if (reach <= 0) {
      lay.a = lay.b = carrier.nodes.front();
      lay.offset = -reach * away(carrier.nodes[0], carrier.nodes[1]);
    } else if (reach >= total) {
      lay.a = lay.b = carrier.nodes.back();
      lay.offset = (reach - total) * away(carrier.nodes[last], carrier.nodes[last - 1]);
    } else {
      std::size_t n = 1;
      while (n < last && carrier.reach[n] < reach) ++n;
      lay.a = carrier.nodes[n - 1];
      lay.b = carrier.nodes[n];
      lay.s = (reach - carrier.reach[n - 1]) / (carrier.reach[n] - carrier.reach[n - 1]);
    }
    return lay;
  }

  // Paper Sec. 5.3: before the closing time the thread coincides with its carrier.
  void add_closing_thread(const Thread& thread) {
    const Carrier carrier = carrier_of(thread);
    const double laid = thread.overhang_start + carrier.reach.back() + thread.overhang_end;
    const double length = thread.length > 0 ? thread.length : laid;
    const auto part = static_cast<Index>(out_.parts.size());
    carriers_[part] = {carrier, thread.overhang_start, laid};
    const double element_mass = add_thread_nodes(thread, length / thread.elements, [&](int k) {
      Lay lay = lay_at(carrier, thread, laid * k / thread.elements);
      const AssemblyNode &a = node(lay.a), &b = node(lay.b);
      lay.node = add_node((1 - lay.s) * a.position + lay.s * b.position + lay.offset,
                          (1 - lay.s) * a.velocity + lay.s * b.velocity);
      out_.lays.push_back(lay);
      return lay.node;
    });
    out_.laid.push_back({part, length, laid, thread.elements * element_mass});
    for (int k = 0; k <= thread.elements; ++k)
      if (const NodeSpec* spec = spec_of(thread, k); spec != nullptr && !spec->on.empty())
        out_.laid.back().elsewhere[k] = lay_at(carrier, thread, laid * k / thread.elements);
  }

  Index host_element(const Ring& ring) {
    const std::vector<Index> nodes = polyline(ring.element_of, ring.source);
    const Index last = static_cast<Index>(nodes.size()) - 2;
    if (ring.element < 0 || ring.element > last)
      fail(ring.source, "ring '" + ring.name + "': '" + ring.element_of + "' has elements 0 to " +
                            std::to_string(last) + ", found element " + std::to_string(ring.element));
    const auto k = static_cast<std::size_t>(ring.element);
    return element_between(nodes[k], nodes[k + 1]);
  }

  void add_ring(const Ring& ring) {
    AssemblyRing r;
    r.name = ring.name;
    r.radius = ring.diameter / 2;
    r.wire_radius = ring.wire_diameter / 2;
    r.compliance = compliance(ring.youngs_modulus, ring.poissons_ratio);
    r.normal = ring.normal.normalized();
    std::string host_thread;
    if (ring.host == RingHost::element) {
      r.element = host_element(ring);
      const AssemblyElement& host = out_.elements[static_cast<std::size_t>(r.element)];
      node(host.a).mass += ring.mass / 2;  // eq. (2): n_r m_r / 2
      node(host.b).mass += ring.mass / 2;
      r.host_a = host.a;
      r.host_b = host.b;
      if (const Reference at(ring.element_of); at.kind == "thread") host_thread = at.name;
    } else {
      r.node = r.host_a = r.host_b = find_part(PartKind::ring, ring.name)->nodes.front();
    }
    const auto listed = [&](const std::string& name) {
      return ring.threads.empty() || std::count(ring.threads.begin(), ring.threads.end(), name) > 0 ||
             std::count(ring.threads.begin(), ring.threads.end(), "thread." + name) > 0;
    };
    // a thread that carries the ring, or hangs on it, lies inside its wire for good
    const auto holds = [&](const Part& part) {
      return part.name == host_thread || std::count(part.nodes.begin(), part.nodes.end(), r.node) > 0;
    };
    for (std::size_t p = 0; p < out_.parts.size(); ++p) {
      const Part& part = out_.parts[p];
      if (part.kind == PartKind::thread && !holds(part) && listed(part.name))
        r.parts.push_back(static_cast<Index>(p));
    }
    out_.rings.push_back(std::move(r));
  }

  void add_ball(const BallTarget& ball) {
    AssemblyBall b;
    b.name = ball.name;
    b.center = ball.center;
    b.radius = ball.radius;
    b.compliance = compliance(ball.youngs_modulus, ball.poissons_ratio);
    for (std::size_t p = 0; p < out_.parts.size(); ++p) {
      const Part& part = out_.parts[p];
      const std::string name = part.reference();
      if (ball.touches.empty() || std::count(ball.touches.begin(), ball.touches.end(), name) > 0)
        b.parts.push_back(static_cast<Index>(p));
    }
    for (std::size_t s = 0; s < out_.spheres.size(); ++s)
      if (std::count(b.parts.begin(), b.parts.end(), out_.spheres[s].part) > 0)
        b.spheres.push_back(static_cast<Index>(s));
    out_.balls.push_back(std::move(b));
  }

  Index node_of(const std::string& reference, const SourceRef& source) {
    try {
      return node_by_reference(reference);
    } catch (const CaseError& error) {
      fail(source, error.what());
    }
  }

  Index node_by_reference(const std::string& reference) {
    const Reference at(reference);
    if (at.kind == "net") {
      const Part* part = find_part(PartKind::net, at.name);
      const Index place = part ? NetPattern(net_named(at.name, {})).place(at.place) : -1;
      if (place >= 0) return part->nodes.front() + place;
    } else if (at.kind == "mechanism" && (at.place == "a" || at.place == "b")) {
      for (const Mechanism& mechanism : scene_.mechanisms)
        if (mechanism.name == at.name && out_.nodes_before > 0) return split_mass(mechanism, at.place[0]);
    } else if (at.kind == "mechanism" && at.place == "launcher") {
      if (const Index known = named_node(reference); known >= 0) return known;
    } else if (at.kind == "ring") {
      for (const Ring& ring : scene_.rings)
        if (ring.name == at.name && ring.host == RingHost::node) return ring_node(ring);
    } else if (at.kind == "thread") {
      // a thread that is just being laid has no nodes yet, not even for itself
      if (const Part* part = find_part(PartKind::thread, at.name); part && !part->nodes.empty()) {
        if (at.place == "start") return part->nodes.front();
        if (at.place == "end") return part->nodes.back();
        for (std::size_t k = 0; k < part->nodes.size(); ++k)
          if (at.place == "node." + std::to_string(k)) return part->nodes[k];
      }
    }
    throw CaseError("there is no node '" + reference + "' (or it comes later in the case file)");
  }

  // Unequal split masses push the launcher; with equal ones it keeps its velocity (paper Sec. 2).
  void balance_separations() {
    for (const Mechanism& mechanism : scene_.mechanisms) {
      const Index launcher = find_part(PartKind::mechanism, mechanism.name)->nodes.back();
      Vec3 impulse = Vec3::Zero();
      for (const Lay& lay : out_.lays)
        if (lay.a == launcher && lay.b == launcher) impulse += node(lay.node).mass * lay.jump;
      if (impulse != Vec3::Zero()) out_.recoils.push_back({launcher, -impulse / node(launcher).mass});
    }
  }

  const Scene& scene_;
  Assembly out_;
  // incident elements as linked lists: half 2 e or 2 e + 1 of element e, and the half before it at the same
  // node
  std::vector<Index> latest_, earlier_;
  std::map<Index, LaidAlong> carriers_;  // part of a closing thread
};

}  // namespace

const char* kind_name(PartKind kind) {
  static constexpr const char* names[] = {"net", "mechanism", "thread", "ring"};
  return names[static_cast<std::size_t>(kind)];
}

std::string Part::reference() const { return std::string(kind_name(kind)) + "." + name; }

Index Assembly::node_in_net(const Part& part, const std::string& place) const {
  const auto shape = net_shapes.find(part.name);
  if (shape == net_shapes.end()) return -1;
  const Index at = NetPattern(shape->second).place(place);
  return at < 0 ? -1 : part.nodes.front() + at;
}

std::vector<Index> Assembly::laid_nodes(const LaidThread& thread) const {
  const std::vector<Index>& all = parts[static_cast<std::size_t>(thread.part)].nodes;
  std::vector<Index> found;
  std::copy_if(all.begin() + 1, all.end() - 1, std::back_inserter(found),
               [&](Index node) { return node >= nodes_before; });
  return found;
}

const Part& Assembly::part_of(Index element) const {
  return *std::find_if(parts.begin(), parts.end(), [&](const Part& part) {
    return element >= part.first_element && element < part.first_element + part.elements;
  });
}

void Assembly::forget_start() {
  nodes = decltype(nodes)();  // = {} would keep the room
  elements = decltype(elements)();
}

Assembly assemble(const Scene& scene) { return Assembler(scene).build(); }

Index Assembly::node_of(const std::string& reference) const {
  for (const NamedNode& item : named)
    if (item.name == reference) return item.node;
  const Reference at(reference);
  for (const Part& part : parts) {
    if (part.name != at.name) continue;
    if (part.kind == PartKind::ring && at.kind == "ring") return part.nodes.front();
    if (part.kind == PartKind::net && at.kind == "net" && node_in_net(part, at.place) >= 0)
      return node_in_net(part, at.place);
    if (part.kind != PartKind::thread || at.kind != "thread") continue;
    if (at.place == "start") return part.nodes.front();
    if (at.place == "end") return part.nodes.back();
    for (std::size_t k = 0; k < part.nodes.size(); ++k)
      if (at.place == "node." + std::to_string(k)) return part.nodes[k];
  }
  throw CaseError("error: there is no node '" + reference + "'");
}

Index Assembly::ring_of(const std::string& reference) const {
  const std::string name = reference.starts_with("ring.") ? reference.substr(5) : reference;
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (rings[r].name == name) return static_cast<Index>(r);
  throw CaseError("error: there is no ring '" + name + "'");
}

}  // namespace cinch
