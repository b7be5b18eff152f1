#include "store/topology.hpp"

#include <algorithm>

namespace cinch {
namespace {

constexpr Index shortest_run = 4;  ///< fewer elements cost less as links than as a loop
constexpr Index widest_gap = 8;    ///< void slots that cost less than the start of another loop

// An element by the distance of its nodes and its lower node; `layer` counts elements that join the same two.
struct Place {
  Index offset, a, element, layer;
};

std::vector<Place> sorted_places(const std::vector<Index>& end_a, const std::vector<Index>& end_b) {
  std::vector<Place> places;
  places.reserve(end_a.size());
  for (std::size_t e = 0; e < end_a.size(); ++e) {
    const auto [low, high] = std::minmax(end_a[e], end_b[e]);
    places.push_back({high - low, low, static_cast<Index>(e), 0});
  }
  const auto before = [](const Place& l, const Place& r) {
    if (l.offset != r.offset) return l.offset < r.offset;
    if (l.layer != r.layer) return l.layer < r.layer;
    return l.a != r.a ? l.a < r.a : l.element < r.element;
  };
  std::sort(places.begin(), places.end(), before);
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
std::size_t end_of_run(const std::vector<Place>& places, std::size_t first) {
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

Topology cut_runs(const std::vector<Index>& end_a, const std::vector<Index>& end_b) {
  const std::vector<Place> places = sorted_places(end_a, end_b);
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
