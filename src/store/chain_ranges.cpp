#include "store/chain_ranges.hpp"

#include <algorithm>

namespace cinch {
namespace {

using kernel::lanes;
using kernel::Span;
using kernel::Stretch;

constexpr Index shortest_chain = 4;  ///< groups; the pass has to be filled and emptied

Index last(const Span& s) { return s.node + s.groups * lanes; }
Index last(const Stretch& s) { return s.node + s.count; }

Span part(const Span& s, Index begin, Index end) {
  const Index k = begin - s.node, groups = k / lanes;
  return {begin,       (end - begin) / lanes,
          s.step,      s.parameter + groups,
          s.force + k, s.row_node < 0 ? -1 : s.row_node + k,
          -1};
}

Stretch part(const Stretch& s, Index begin, Index end) {
  Stretch piece{begin, end - begin, s.terms, {}, {}};
  for (Index t = 0; t < s.terms; ++t) {
    piece.plus[t] = s.plus[t] + begin - s.node;
    piece.minus[t] = s.minus[t] + begin - s.node;
  }
  return piece;
}

/// Nodes that span number `span` and stretch number `stretch` of a block share as a chain.
struct Chain {
  Index begin, end;
  std::size_t span, stretch;
};

bool chained(const Span& span, const Stretch& stretch) {
  return stretch.terms > 0 && stretch.minus[0] == stretch.plus[0] - 1 &&
         stretch.plus[0] - stretch.node == span.force - span.node;
}

std::vector<Chain> find_chains(const std::vector<Span>& spans, const std::vector<Stretch>& stretches) {
  std::vector<Chain> chains;
  for (std::size_t s = 0; s < spans.size(); ++s)
    for (std::size_t t = 0; t < stretches.size(); ++t) {
      if (!chained(spans[s], stretches[t])) continue;
      const Index begin = std::max(spans[s].node, (stretches[t].node + lanes - 1) / lanes * lanes);
      const Index end = std::min(last(spans[s]), last(stretches[t]) / lanes * lanes);
      if (end - begin >= shortest_chain * lanes) chains.push_back({begin, end, s, t});
    }
  std::sort(chains.begin(), chains.end(), [](const Chain& a, const Chain& b) { return a.begin < b.begin; });
  return chains;
}

// What lies outside the chains.
template <class Item>
std::vector<Item> rest(const std::vector<Item>& items, const std::vector<Chain>& chains,
                       std::size_t Chain::*number) {
  std::vector<Item> around;
  for (std::size_t i = 0; i < items.size(); ++i) {
    Index begin = items[i].node;
    for (const Chain& c : chains) {
      if (c.*number != i) continue;
      if (begin < c.begin) around.push_back(part(items[i], begin, c.begin));
      begin = c.end;
    }
    if (begin < last(items[i])) around.push_back(part(items[i], begin, last(items[i])));
  }
  return around;
}

}  // namespace

ChainRanges cut_out_chains(const std::vector<Span>& neighbours, const std::vector<Stretch>& stretches) {
  const std::vector<Chain> chains = find_chains(neighbours, stretches);
  ChainRanges out{rest(neighbours, chains, &Chain::span), {}, rest(stretches, chains, &Chain::stretch)};
  for (const Chain& c : chains) {
    out.spans.push_back(part(neighbours[c.span], c.begin, c.end));
    out.spans.back().stretch = static_cast<Index>(out.chain_stretches.size());
    out.chain_stretches.push_back(part(stretches[c.stretch], c.begin, c.end));
  }
  std::sort(out.spans.begin(), out.spans.end(), [](const Span& a, const Span& b) { return a.node < b.node; });
  return out;
}

}  // namespace cinch
