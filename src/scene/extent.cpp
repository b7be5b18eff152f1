#include "scene/extent.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "scene/fault.hpp"
#include "scene/net_pattern.hpp"

namespace cinch {
namespace {

/// Slots of runs are numbered, and an element may bring eight void ones: see topology.cpp.
constexpr std::int64_t most_elements = std::numeric_limits<Index>::max() / 9;

/// Bytes that a node or an element takes at least: nets take 125 while `cinch check` tries them and 144 while
/// they write a frame, threads more. So what is refused would not fit.
constexpr std::int64_t bytes_of_item = 120;

}  // namespace

Extent extent_of(const Scene& scene) {
  Extent sum;
  std::int64_t most = 0;
  const auto add = [&](std::int64_t nodes, std::int64_t elements, const SourceRef& source) {
    sum.nodes += nodes;
    sum.elements += elements;
    if (elements <= most) return;
    most = elements;
    sum.largest = source;
  };
  for (const Net& net : scene.nets) add(NetPattern::nodes(net), NetPattern::elements(net), net.source);
  for (const Mechanism& mechanism : scene.mechanisms)
    add(mechanism.towing_elements + 2, mechanism.towing_elements, mechanism.source);
  for (const Thread& thread : scene.threads)
    add(thread.elements + std::int64_t{1}, thread.elements, thread.source);
  sum.nodes += std::count_if(scene.rings.begin(), scene.rings.end(),
                             [](const Ring& r) { return r.host == RingHost::node; });
  return sum;
}

void require_room(const Extent& extent, std::size_t memory) {
  if (extent.elements > most_elements)
    fail(extent.largest, "the scene has " + std::to_string(extent.elements) + " elements, allowed: at most " +
                             std::to_string(most_elements) + " (this part has most of them)");
  const std::int64_t items = extent.nodes + extent.elements;
  const auto room =
      static_cast<std::int64_t>(std::min<std::size_t>(memory, std::size_t{1} << 62)) / bytes_of_item;
  if (items <= room) return;
  char text[300];
  std::snprintf(
      text, sizeof text,
      "the scene has %lld nodes and %lld elements, allowed: %lld in all, as this machine has %.3g GB of "
      "memory (this part has most of them)",
      static_cast<long long>(extent.nodes), static_cast<long long>(extent.elements),
      static_cast<long long>(room), static_cast<double>(memory) / 1e9);
  fail(extent.largest, text);
}

}  // namespace cinch
