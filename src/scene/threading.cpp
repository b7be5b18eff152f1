#include "scene/threading.hpp"

#include <cmath>
#include <cstdio>
#include <optional>

#include "scene/fault.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double radius_of(const Assembly& assembly, const Part& thread) {
  return assembly.elements[at(thread.first_element)].radius;
}

double opening(const Assembly& assembly, const AssemblyRing& ring, const Part& thread) {
  return ring.radius - ring.wire_radius - radius_of(assembly, thread);
}

void check_opening(const Assembly& assembly, const AssemblyRing& ring, const Part& thread,
                   const SourceRef& source) {
  if (opening(assembly, ring, thread) > 0) return;
  char text[300];
  std::snprintf(text, sizeof text,
                "ring '%s': its opening of %.6g m leaves no room for thread '%s' of %.6g m, as joint = "
                "\"sliding\" needs",
                ring.name.c_str(), 2 * (ring.radius - ring.wire_radius), thread.name.c_str(),
                2 * radius_of(assembly, thread));
  fail(source, text);
}

Vec3 normal_of(const Assembly& assembly, const AssemblyRing& ring) {
  if (ring.element < 0) return ring.normal;
  return (assembly.nodes[at(ring.host_b)].position - assembly.nodes[at(ring.host_a)].position).normalized();
}

struct Crossing {
  double along;  // elements from the thread's start
  double out;    // from the ring's centre, m
};

// Where a thread crosses the ring's plane: from one side to the other. A thread that only comes to the plane
// does not pass.
std::vector<Crossing> crossings(const Assembly& assembly, const AssemblyRing& ring, const Part& thread) {
  const auto place = [&](Index node) { return assembly.nodes[at(node)].position; };
  const Vec3 center = 0.5 * (place(ring.host_a) + place(ring.host_b));
  const Vec3 normal = normal_of(assembly, ring);
  std::vector<Crossing> found;
  std::optional<std::size_t> last;  // node that is not in the plane
  for (std::size_t k = 0; k < thread.nodes.size(); ++k) {
    const Vec3 b = place(thread.nodes[k]) - center;
    const double axial_b = normal.dot(b);
    if (std::abs(axial_b) <= 1e-9 * ring.radius) continue;
    const std::size_t before = last.value_or(k);
    last = k;
    const double axial_a = normal.dot(place(thread.nodes[before]) - center);
    if ((axial_a < 0) == (axial_b < 0)) continue;
    // to the next node, which may lie in the plane
    const Vec3 a = place(thread.nodes[before]) - center, next = place(thread.nodes[before + 1]) - center;
    const double t = axial_a / (axial_a - normal.dot(next));
    found.push_back({static_cast<double>(before) + t, ((1 - t) * a + t * next).norm()});
  }
  return found;
}

Threading threading_of(const Assembly& assembly, const AssemblyRing& ring, Index number, double along) {
  const Part& thread = assembly.parts[at(number)];
  const std::size_t k = at(std::clamp(static_cast<Index>(along), 0, thread.elements - 1));
  const Vec3 way =
      assembly.nodes[at(thread.nodes[k + 1])].position - assembly.nodes[at(thread.nodes[k])].position;
  const double rest = assembly.elements[at(thread.first_element)].rest_length;
  return {number, along, rest * along, normal_of(assembly, ring).dot(way) < 0 ? -1.0 : 1.0};
}

// Where a thread passes through a ring, in elements from its start.
std::vector<double> places_in_ring(const Assembly& assembly, const std::map<Index, LaidAlong>& carriers,
                                   const AssemblyRing& ring, Index number) {
  const Part& thread = assembly.parts[at(number)];
  if (const auto laid = carriers.find(number); laid != carriers.end())
    if (const double reach = laid->second.carrier.middle_of(ring.host_a, ring.host_b); reach >= 0)
      return {(laid->second.overhang + reach) / laid->second.length * thread.elements};
  const double room = opening(assembly, ring, thread);
  const double reach = room > 0 ? room : ring.radius;  // what cannot fit is refused
  std::vector<double> places;
  for (const Crossing& crossing : crossings(assembly, ring, thread))
    if (crossing.out <= reach) places.push_back(crossing.along);
  return places;
}

// Nothing where one of the threads passes and none is too thick to.
std::optional<Miss> miss_of(const std::map<Index, LaidAlong>& carriers, const Assembly& assembly,
                            const AssemblyRing& ring) {
  Miss nearest;
  for (const Index number : ring.parts) {
    const Part& thread = assembly.parts[at(number)];
    const double room = opening(assembly, ring, thread);
    if (room <= 0 && !places_in_ring(assembly, carriers, ring, number).empty())
      return Miss{number, -room, 2 * radius_of(assembly, thread)};
  }
  for (const Index number : ring.parts) {
    if (!places_in_ring(assembly, carriers, ring, number).empty()) return std::nullopt;
    const Part& thread = assembly.parts[at(number)];
    for (const Crossing& crossing : crossings(assembly, ring, thread)) {
      const double distance = crossing.out - opening(assembly, ring, thread);
      if (nearest.part < 0 || distance < nearest.distance) nearest = {number, distance};
    }
  }
  return nearest;
}

void thread_ring(const Ring& spec, const std::map<Index, LaidAlong>& carriers, const Assembly& assembly,
                 AssemblyRing& ring) {
  for (const Index number : ring.parts) {
    const Part& thread = assembly.parts[at(number)];
    const std::vector<double> places = places_in_ring(assembly, carriers, ring, number);
    if (!places.empty()) check_opening(assembly, ring, thread, spec.source);
    const std::string words = "ring '" + ring.name + "': thread '" + thread.name + "' ";
    if (places.size() > 1)
      fail(spec.source, words + "passes through it " + std::to_string(places.size()) +
                            " times, allowed with joint = \"sliding\": once");
    if (places.empty() && !spec.threads.empty())
      fail(spec.source,
           words +
               "does not pass through it, as joint = \"sliding\" needs; allowed: threads that cross the "
               "ring's plane inside its opening");
    if (places.empty()) continue;
    ring.threadings.push_back(threading_of(assembly, ring, number, places.front()));
  }
  if (ring.threadings.empty())
    fail(spec.source,
         "ring '" + ring.name +
             "': no thread passes through it, as a sliding joint needs (joint or case.method = \"sliding\")");
  ring.parts.clear();
}

// Whether all of the threads that a ring names, or one of all threads, can slide through it.
bool can_slide(const Ring& spec, const std::map<Index, LaidAlong>& carriers, const Assembly& assembly,
               const AssemblyRing& ring) {
  bool any = false;
  for (const Index number : ring.parts) {
    const std::size_t places = places_in_ring(assembly, carriers, ring, number).size();
    const bool fits = opening(assembly, ring, assembly.parts[at(number)]) > 0;
    if (places > 1 || (places == 1 && !fits) || (places == 0 && !spec.threads.empty())) return false;
    any = any || places == 1;
  }
  return any;
}

}  // namespace

double Carrier::middle_of(Index a, Index b) const {
  for (std::size_t n = 1; n < nodes.size(); ++n)
    if ((nodes[n - 1] == a && nodes[n] == b) || (nodes[n - 1] == b && nodes[n] == a))
      return 0.5 * (reach[n - 1] + reach[n]);
  return -1;
}

void thread_rings(const Scene& scene, const std::map<Index, LaidAlong>& carriers, Assembly& assembly) {
  for (std::size_t r = 0; r < scene.rings.size(); ++r) {
    const Ring& spec = scene.rings[r];
    AssemblyRing& ring = assembly.rings[r];
    if (spec.joint == RingJoint::sliding ||
        (spec.joint == RingJoint::automatic && can_slide(spec, carriers, assembly, ring)))
      thread_ring(spec, carriers, assembly, ring);
    else if (spec.joint == RingJoint::automatic) ring.missed = miss_of(carriers, assembly, ring);
  }
}

}  // namespace cinch
