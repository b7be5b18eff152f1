#include "store/topology.hpp"

#include <algorithm>
#include <numeric>

namespace cinch {
namespace {

constexpr Index shortest_run = 4;  ///< fewer elements cost less as links than as a loop
constexpr Index widest_gap = 8;    ///< void slots that cost less than the start of another loop

// An element by the distance of its nodes and its lower node; `layer` counts elements that join the same two.
struct Place {
  Index offset, a, element, layer;
};

// Where in sorted order the items of each key from 0 to `largest` begin.
template <class Key>
std::vector<Index> beginnings(std::size_t items, Index largest, Key key) {
  std::vector<Index> begin(static_cast<std::size_t>(largest) + 2);
  for (std::size_t i = 0; i < items; ++i) ++begin[static_cast<std::size_t>(key(i)) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

// By offset, lower node and element: two counting sorts, as every net gives millions of places in few
// offsets.
LargeVector<Place> places_by_offset(std::span<const Index> end_a, std::span<const Index> end_b) {
  const std::size_t elements = end_a.size();
  Index largest = 0;
  for (std::size_t e = 0; e < elements; ++e) largest = std::max({largest, end_a[e], end_b[e]});
  const auto low = [&](std::size_t e) { return std::min(end_a[e], end_b[e]); };
  const auto offset = [&](std::size_t e) { return std::max(end_a[e], end_b[e]) - low(e); };
  const auto next = [](std::vector<Index>& begin, Index key) {
    return static_cast<std::size_t>(begin[static_cast<std::size_t>(key)]++);
  };
  LargeVector<Index> by_node(elements);
  std::vector<Index> begin = beginnings(elements, largest, low);
  for (std::size_t e = 0; e < elements; ++e) by_node[next(begin, low(e))] = static_cast<Index>(e);
  LargeVector<Place> places(elements);
  begin = beginnings(elements, largest, offset);
  for (const Index element : by_node) {
    const auto e = static_cast<std::size_t>(element);
    places[next(begin, offset(e))] = {offset(e), low(e), element, 0};
  }
  return places;
}

LargeVector<Place> sorted_places(std::span<const Index> end_a, std::span<const Index> end_b) {
  LargeVector<Place> places = places_by_offset(end_a, end_b);
  const auto before = [](const Place& l, const Place& r) {
    if (l.offset != r.offset) return l.offset < r.offset;
    if (l.layer != r.layer) return l.layer < r.layer;
    return l.a != r.a ? l.a < r.a : l.element < r.element;
  };
  bool layered = false;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].offset == places[i - 1].offset && places[i].a == places[i - 1].a) {
      places[i].layer = places[i - 1].layer + 1;
      layered = true;
    }
  if (layered) std::sort(places.begin(), places.end(), before);
  return places;
}

// The stretch [first, last) of places that one run takes: same offset, gaps no wider than what it already
// has.
std::size_t end_of_run(const LargeVector<Place>& places, std::size_t first) {
  std::size_t last = first + 1;
  for (; last < places.size(); ++last) {
    const Place &here = places[last], &before = places[last - 1];
    if (here.offset != before.offset || here.layer != before.layer) break;
    const Index gap = here.a - before.a - 1;
    if (gap > std::min(widest_gap, static_cast<Index>(last - first))) break;
  }
  return last;
}

}  // namespace

Topology cut_runs(std::span<const Index> end_a, std::span<const Index> end_b) {
  const LargeVector<Place> places = sorted_places(end_a, end_b);
  Topology out;
  out.slot_element.reserve(end_a.size() + end_a.size() / 16);
  for (std::size_t first = 0; first < places.size();) {
    const std::size_t last = end_of_run(places, first);
    const Place& begin = places[first];
    if (static_cast<Index>(last - first) < shortest_run) {
      for (std::size_t i = first; i < last; ++i)
        out.links.push_back({places[i].a, places[i].a + places[i].offset, places[i].element});
    } else {
      const auto slot = static_cast<Index>(out.slot_element.size());
      const Index count = places[last - 1].a - begin.a + 1;
      out.runs.push_back(
          {slot, count, begin.a, begin.offset, static_cast<Index>(out.runs.size()), begin.offset == 1});
      out.slot_element.resize(out.slot_element.size() + static_cast<std::size_t>(count), -1);
      for (std::size_t i = first; i < last; ++i)
        out.slot_element[static_cast<std::size_t>(slot + places[i].a - begin.a)] = places[i].element;
    }
    first = last;
  }
  std::sort(out.links.begin(), out.links.end(), [](const LinkEnds& l, const LinkEnds& r) {
    return l.a != r.a ? l.a < r.a : l.element < r.element;
  });
  return out;
}

}  // namespace cinch
