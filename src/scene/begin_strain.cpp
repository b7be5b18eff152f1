#include "scene/begin_strain.hpp"

#include <algorithm>

#include "scene/thread_path.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Where nodes lie when a part begins: what is stowed counts as unstretched where the part is laid along it
// later on.
class Places {
 public:
  Places(const Scene& scene, const Assembly& assembly, bool later) : scene_(scene), assembly_(assembly) {
    if (!later) return;
    // the parts that may be stowed come first, nets before mechanisms
    const std::size_t stowed = scene.nets.size() + scene.mechanisms.size();
    for (std::size_t p = 0; p < stowed; ++p) {
      const std::vector<Index>& nodes = assembly.parts[p].nodes;
      first_.push_back(p < scene.nets.size() ? nodes.front() : nodes[1]);
    }
  }

  Vec3 of(Index node) const {
    if (node >= assembly_.nodes_before) return of(assembly_.lays[at(node - assembly_.nodes_before)]);
    const Vec3& place = assembly_.nodes[at(node)].position;
    const auto next = std::upper_bound(first_.begin(), first_.end(), node);
    if (next == first_.begin()) return place;
    const auto p = static_cast<std::size_t>(next - first_.begin()) - 1;
    const std::vector<Index>& nodes = assembly_.parts[p].nodes;
    if (node > nodes.back()) return place;  // of what is never stowed
    if (p < scene_.nets.size()) {
      const Net& net = scene_.nets[p];
      return net.center + (place - net.center) / net.stowed_factor;
    }
    const Vec3& corner = assembly_.nodes[at(nodes.front())].position;
    return of(nodes.front()) + (place - corner) / scene_.mechanisms[p - scene_.nets.size()].initial_stretch;
  }
  Vec3 of(const Lay& lay) const { return (1 - lay.s) * of(lay.a) + lay.s * of(lay.b) + lay.offset; }

 private:
  const Scene& scene_;
  const Assembly& assembly_;
  std::vector<Index> first_;  // nodes of their own of parts that may be stowed
};

BeginStrain greatest_strain(const Assembly& assembly, Index number, const Places& places) {
  const Part& part = assembly.parts[at(number)];
  constexpr double alike = 1e-9;  // what differs by less does so by rounding
  BeginStrain most{number, part.first_element, -1, "", 0};
  for (Index e = part.first_element; e < part.first_element + part.elements; ++e) {
    const AssemblyElement& element = assembly.elements[at(e)];
    const double strain = (places.of(element.a) - places.of(element.b)).norm() / element.rest_length - 1;
    if (strain > most.strain + alike * (1 + most.strain)) most.strain = strain, most.element = e;
  }
  return most;
}

const NodeSpec* spec_of(const Thread& thread, int k) {
  if (k == 0) return &thread.start;
  if (k == thread.elements) return &thread.end;
  const auto found = thread.nodes.find(k);
  return found == thread.nodes.end() ? nullptr : &found->second;
}

const LaidThread* laid_as(const Assembly& assembly, Index part) {
  const auto found = std::find_if(assembly.laid.begin(), assembly.laid.end(),
                                  [&](const LaidThread& laid) { return laid.part == part; });
  return found == assembly.laid.end() ? nullptr : &*found;
}

// The wider gap at the ends of the element, as far as it tells.
void find_gap(const Thread& thread, const Assembly& assembly, const Places& places, BeginStrain& begin) {
  const Part& part = assembly.parts[at(begin.part)];
  const double least = great_laid_strain * assembly.elements[at(begin.element)].rest_length;
  const int k = begin.element - part.first_element;
  for (const int end : {k, k + 1}) {
    const NodeSpec* spec = spec_of(thread, end);
    if (spec == nullptr || spec->on.empty()) continue;
    const Vec3 own = thread.closing() ? places.of(laid_as(assembly, begin.part)->elsewhere.at(end))
                                      : ThreadPath(thread).node(end);
    const double gap = (own - places.of(part.nodes[at(end)])).norm();
    if (gap > std::max(begin.gap, least)) begin.gap = gap, begin.on = spec->on;
  }
}

}  // namespace

std::vector<BeginStrain> great_begin_strains(const Scene& scene, const Assembly& assembly) {
  const Places at_start(scene, assembly, false), later(scene, assembly, true);
  const bool closes_later = scene.closing.time.value_or(0) > 0;
  std::map<std::string, const Thread*> threads;
  for (const Thread& thread : scene.threads) threads[thread.name] = &thread;
  std::vector<BeginStrain> great;
  for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
    const Part& part = assembly.parts[p];
    const auto number = static_cast<Index>(p);
    if (part.closing && laid_as(assembly, number)->strain() > great_laid_strain) continue;
    const Places& places = part.closing && closes_later ? later : at_start;
    BeginStrain begin = greatest_strain(assembly, number, places);
    if (!(begin.strain > great_laid_strain * (1 + 1e-9))) continue;
    if (part.kind == PartKind::thread) find_gap(*threads.at(part.name), assembly, places, begin);
    great.push_back(std::move(begin));
  }
  return great;
}

}  // namespace cinch
