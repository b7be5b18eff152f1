#include "store/topology.hpp"

#include <algorithm>
#include <numeric>

namespace cinch {
namespace {

// Elements by their first node, as address and index lists.
struct ByFirstNode {
  std::vector<std::size_t> begin;
  std::vector<Index> element;

  ByFirstNode(const std::vector<std::array<Index, 2>>& elements, Index nodes)
      : begin(static_cast<std::size_t>(nodes) + 2), element(elements.size()) {
    for (const auto& e : elements) ++begin[static_cast<std::size_t>(e[0]) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::size_t> next(begin);
    for (std::size_t e = 0; e < elements.size(); ++e)
      element[next[static_cast<std::size_t>(elements[e][0])]++] = static_cast<Index>(e);
  }
};

}  // namespace

Topology cut_runs(const std::vector<std::array<Index, 2>>& elements, Index nodes) {
  const ByFirstNode lookup(elements, nodes);
  std::vector<bool> taken(elements.size());
  const auto find = [&](Index a, Index b) -> Index {
    if (a >= nodes) return -1;
    const auto node = static_cast<std::size_t>(a);
    for (std::size_t i = lookup.begin[node]; i < lookup.begin[node + 1]; ++i) {
      const auto e = static_cast<std::size_t>(lookup.element[i]);
      if (!taken[e] && elements[e][1] == b) return lookup.element[i];
    }
    return -1;
  };
  Topology out;
  out.user_element.reserve(elements.size());
  for (std::size_t first = 0; first < elements.size(); ++first) {
    if (taken[first]) continue;
    kernel::Span run{static_cast<Index>(out.user_element.size()), 0, elements[first][0], elements[first][1]};
    for (Index e = static_cast<Index>(first); e >= 0; e = find(run.a + run.count, run.b + run.count)) {
      taken[static_cast<std::size_t>(e)] = true;
      out.user_element.push_back(e);
      ++run.count;
    }
    out.runs.push_back(run);
  }
  return out;
}

void cut_element_blocks(const std::vector<kernel::Span>& runs, std::vector<kernel::Span>& spans,
                        std::vector<kernel::ElementBlock>& blocks) {
  Index room = 0;  // elements that the open block can still take
  for (const kernel::Span& run : runs) {
    for (Index done = 0; done < run.count;) {
      if (room == 0) {
        const auto here = static_cast<Index>(spans.size());
        blocks.push_back({here, here});
        room = kernel::block_size;
      }
      const Index count = std::min(room, run.count - done);
      spans.push_back({run.element + done, count, run.a + done, run.b + done});
      blocks.back().span_end = static_cast<Index>(spans.size());
      done += count;
      room -= count;
    }
  }
}

}  // namespace cinch
