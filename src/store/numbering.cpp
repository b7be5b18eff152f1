#include "store/numbering.hpp"

#include <algorithm>
#include <numeric>

#include "kernels/arguments.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr unsigned char nowhere = 255;

// Calls visit(a, b) for the ends of every element.
template <class Visit>
void for_each_element(const Topology& topology, Visit visit) {
  for (const Run& run : topology.runs)
    for (Index k = 0; k < run.count; ++k)
      if (topology.slot_element[at(run.slot + k)] >= 0) visit(run.a + k, run.a + k + run.offset);
  for (const LinkEnds& link : topology.links) visit(link.a, link.b);
}

}  // namespace

Index Numbering::local(Index global_node) const {
  auto range = std::upper_bound(ranges_.begin(), ranges_.end(), global_node,
                                [](Index node, const Range& r) { return node < r.global; });
  if (range == ranges_.begin()) return -1;
  --range;
  const Index within = global_node - range->global;
  return within < range->count ? range->local + within : -1;
}

Index Numbering::ghosts() const {
  Index count = 0;
  for (Index i = 0; i < nodes(); ++i) count += ghost(i);
  return count;
}

void Numbering::append(Index global_node, unsigned char of_layer) {
  const bool goes_on = !global.empty() && global.back() == global_node - 1;
  while (!goes_on && nodes() % kernel::lanes != global_node % kernel::lanes) {
    global.push_back(-1);
    layer.push_back(nowhere);
  }
  if (!goes_on) ranges_.push_back({global_node, nodes(), 0});
  ++ranges_.back().count;
  global.push_back(global_node);
  layer.push_back(of_layer);
}

Numbering Numbering::all(Index nodes) {
  Numbering out;
  out.global.resize(at(nodes));
  std::iota(out.global.begin(), out.global.end(), 0);
  out.layer.assign(at(nodes), 0);
  out.ranges_.push_back({0, 0, nodes});
  return out;
}

Numbering Numbering::of(const std::vector<Index>& own, const Topology& topology, Index nodes, int depth) {
  std::vector<unsigned char> layer(at(nodes), nowhere);
  for (const Index node : own) layer[at(node)] = 0;
  for (int distance = 1; distance <= depth; ++distance) {
    const auto reach = static_cast<unsigned char>(distance), from = static_cast<unsigned char>(distance - 1);
    const auto spread = [&](Index here, Index there) {
      if (layer[at(here)] == from && layer[at(there)] == nowhere) layer[at(there)] = reach;
    };
    for_each_element(topology, [&](Index a, Index b) {
      spread(a, b);
      spread(b, a);
    });
  }
  Numbering out;
  out.depth = depth;
  for (Index i = 0; i < nodes; ++i)
    if (layer[at(i)] != nowhere) out.append(i, layer[at(i)]);
  return out;
}

Topology local_topology(const Topology& whole, const Numbering& numbering) {
  Topology out;
  const auto needed = [&](Index a, Index b) {
    return a >= 0 && b >= 0 && (numbering.moved(a) || numbering.moved(b));
  };
  for (const Run& run : whole.runs) {
    Index last_a = -1, last_b = -1;  // of the slot before, when it was taken
    for (Index k = 0; k < run.count; ++k) {
      const Index a = numbering.local(run.a + k), b = numbering.local(run.a + k + run.offset);
      if (!needed(a, b)) {
        last_a = -1;
        continue;
      }
      const bool goes_on = last_a >= 0 && a == last_a + 1 && b == last_b + 1;
      if (!goes_on)
        out.runs.push_back(
            {static_cast<Index>(out.slot_element.size()), 0, a, b - a, run.origin, run.neighbours});
      ++out.runs.back().count;
      out.slot_element.push_back(whole.slot_element[at(run.slot + k)]);
      last_a = a, last_b = b;
    }
  }
  for (const LinkEnds& link : whole.links) {
    const Index a = numbering.local(link.a), b = numbering.local(link.b);
    if (needed(a, b)) out.links.push_back({a, b, link.element});
  }
  return out;
}

}  // namespace cinch
