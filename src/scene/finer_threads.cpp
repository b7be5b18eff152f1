#include "scene/finer_threads.hpp"

#include <algorithm>

namespace cinch {
namespace {

// "thread.NAME.node.K" of one of the threads becomes "thread.NAME.node.FK".
void renumber(std::string& reference, const std::vector<std::string>& finer, int factor) {
  for (const std::string& name : finer) {
    const std::string stem = "thread." + name + ".node.";
    if (!reference.starts_with(stem)) continue;
    reference = stem + std::to_string(factor * std::stoi(reference.substr(stem.size())));
    return;
  }
}

bool carries_ring(const Scene& scene, const Thread& thread) {
  return std::any_of(scene.rings.begin(), scene.rings.end(), [&](const Ring& ring) {
    return ring.host == RingHost::element && ring.element_of == "thread." + thread.name;
  });
}

}  // namespace

Scene finer_threads(Scene scene, int factor) {
  std::vector<std::string> finer;
  for (Thread& thread : scene.threads) {
    if (carries_ring(scene, thread)) continue;
    finer.push_back(thread.name);
    thread.elements *= factor;
    std::map<int, NodeSpec> nodes;
    for (auto& [number, spec] : thread.nodes) nodes[factor * number] = std::move(spec);
    thread.nodes = std::move(nodes);
  }
  for (Mechanism& mechanism : scene.mechanisms) mechanism.towing_elements *= factor;
  for (Thread& thread : scene.threads) {
    renumber(thread.start.on, finer, factor);
    renumber(thread.end.on, finer, factor);
    for (auto& [number, spec] : thread.nodes) renumber(spec.on, finer, factor);
  }
  for (Net& net : scene.nets)
    for (auto& [place, spec] : net.nodes) renumber(spec.on, finer, factor);
  for (Probe& probe : scene.probes) renumber(probe.of, finer, factor);
  return scene;
}

}  // namespace cinch
