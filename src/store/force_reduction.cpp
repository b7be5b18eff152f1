#include "store/force_reduction.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "store/chain_ranges.hpp"

namespace cinch {
namespace {

using kernel::lanes;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr Index up(Index count) { return (count + lanes - 1) / lanes * lanes; }

constexpr Index nearby =
    64;  ///< ends farther apart have a ring of forces; nearer ones are copied from block to block

// Nodes [node, node + count) take the forces of [force, force + count), as lower (+) or upper (-) ends of one
// run.
struct Source {
  Index node, count, force, origin;
  bool plus;
  Index real_begin, real_end;  // nodes of this run; the others get zeros

  Source part(Index begin, Index end) const {
    Source s = *this;
    s.node = begin, s.count = end - begin, s.force = force + begin - node;
    return s;
  }
  bool real() const { return node < real_end && node + count > real_begin; }
};
using Sources = std::vector<Source>;

/// Builds the lists of a ForceReduction, block by block.
class Builder {
 public:
  Builder(const Topology& topology, const Numbering& numbering,
          const std::vector<kernel::Constraint>& constraints, Index block_size)
      : topology_(topology), numbering_(numbering), constraints_(constraints), block_size_(block_size) {}

  ForceReduction build() {
    cut_blocks();
    lay_out_forces();
    of_block_.resize(block_count());
    for (std::size_t r = 0; r < topology_.runs.size(); ++r) layout_[r].ring ? add_ring(r) : add_run(r);
    for (std::size_t b = 0; b < block_count(); ++b) add_block(b);
    return std::move(out_);
  }

 private:
  struct Layout {
    Index first;      ///< where the force of the first node of a block (short, ring: of the run) goes
    Index period;     ///< of a ring
    Index parameter;  ///< of the run's first group
    bool short_run, ring;
  };
  struct OfBlock {
    std::vector<kernel::Patch> patches;
    std::vector<kernel::Span> spans, neighbours;
    Sources sources;
  };

  std::size_t block_count() const { return out_.edges.size() - 1; }
  Index nodes() const { return numbering_.nodes(); }
  Index edge(std::size_t block) const { return out_.edges[block]; }
  std::size_t block_of(Index node) const {
    return at(static_cast<Index>(std::upper_bound(out_.edges.begin(), out_.edges.end(), node) -
                                 out_.edges.begin())) -
           1;
  }

  // Nodes that a run touches, in whole groups: what the last lanes lack is zero.
  Index covered(const Run& run) const { return std::min(nodes(), up(run.a + run.count + run.offset)); }

  // Blocks of whole grains, so that a ledger row is summed in the same order whatever the blocks.
  void cut_blocks() {
    out_.edges.push_back(0);
    Index last = 0;  // where a grain began
    for (Index i = 1; i <= nodes(); ++i) {
      if (i < nodes() && (numbering_.global[at(i)] < 0 || numbering_.global[at(i)] % kernel::grain != 0))
        continue;
      if (i - out_.edges.back() > block_size_ && last > out_.edges.back()) out_.edges.push_back(last);
      last = i;
    }
    if (nodes() > out_.edges.back()) out_.edges.push_back(nodes());
    for (std::size_t b = 0; b < block_count(); ++b) longest_ = std::max(longest_, up(edge(b + 1) - edge(b)));
  }

  void lay_out_forces() {
    first_link_ = longest_;  // forces [0, longest block) stay zero
    out_.force_count = up(first_link_ + static_cast<Index>(topology_.links.size()));
    Index parameter = 0;
    for (const Run& run : topology_.runs) {
      Layout l{};
      l.parameter = parameter;
      parameter += group_count(run);
      const Index first = first_group_node(run);
      const bool one_block = block_of(first) == block_of(covered(run) - 1);
      l.ring = run.offset > nearby && !one_block;
      l.short_run = !l.ring && covered(run) - first <= longest_;
      l.period = up(run.offset + longest_);
      l.first = out_.force_count + (l.ring ? 0 : up(run.offset));
      out_.force_count = l.first + room(run, l);
      layout_.push_back(l);
    }
  }

  // Of a run's forces, behind its first one. A net may have as many runs as sides, and most are short.
  Index room(const Run& run, const Layout& l) const {
    const Index computed = lanes * group_count(run);
    if (l.ring) return std::min(l.period, computed);
    if (l.short_run) return std::max(computed, up(covered(run) - first_group_node(run)));
    return longest_ + lanes;
  }

  // A run whose ends are near each other: every block has its forces in the same place, but for a short one,
  // whose forces each have their own.
  void add_run(std::size_t r) {
    const Run& run = topology_.runs[r];
    const Index begin = first_group_node(run), computed = begin + lanes * group_count(run),
                end = covered(run);
    const std::size_t first_block = block_of(begin), last_block = block_of(end - 1);
    for (std::size_t b = first_block; b <= last_block; ++b) {
      const Index low = std::max(begin, edge(b)), high = std::min(end, edge(b + 1));
      const Index place = layout_[r].first - (layout_[r].short_run ? begin : edge(b));  // of node 0
      const Index stop = std::min(computed, up(edge(b + 1)));
      if (low < stop) add_span(r, b, low, (stop - low) / lanes, place + low);
      if (!layout_[r].short_run) {  // else all that is not computed is zero for ever
        const Index before = edge(b) - edge(b == 0 ? 0 : b - 1);
        of_block_[b].patches.push_back({place + low - run.offset,
                                        b == first_block ? -1 : place + low - run.offset + before,
                                        run.offset});
        const Index done = std::max(low, std::min(stop, high));
        if (done < high) of_block_[b].patches.push_back({place + done, -1, high - done});
      }
      add_source(b, low, high - low, place + low, run, true);
      add_source(b, low, high - low, place + low - run.offset, run, false);
    }
  }

  // A run whose ends are far apart: its forces go round, and nodes are cut where they do.
  void add_ring(std::size_t r) {
    const Run& run = topology_.runs[r];
    const Index begin = first_group_node(run), end = begin + lanes * group_count(run);
    for_ring_pieces(r, 0, [&](Index node, Index count, std::size_t block, Index force) {
      add_span(r, block, node, count / lanes, force);
      const Index moved = std::min(count, nodes() - node);
      if (moved > 0) add_source(block, node, moved, force, run, true);
    });
    const Index last = std::min(end + run.offset, nodes());
    for_ring_pieces(r, run.offset, [&](Index node, Index count, std::size_t block, Index force) {
      const Index moved = std::min(count, last - node);
      if (moved > 0) add_source(block, node, moved, force, run, false);
    });
  }

  // Calls visit(node, count, block, force) for nodes `shift` behind those of the run's groups, cut at blocks
  // and where the ring goes round.
  template <class Visit>
  void for_ring_pieces(std::size_t r, Index shift, Visit visit) const {
    const Layout& l = layout_[r];
    const Index begin = first_group_node(topology_.runs[r]), length = lanes * group_count(topology_.runs[r]);
    for (Index k = 0; k < length && begin + k + shift < nodes();) {
      const Index node = begin + k + shift;
      const std::size_t block = block_of(node);
      const Index edge_here = shift == 0 ? up(edge(block + 1)) : edge(block + 1);
      const Index count = std::min({length - k, l.period - k % l.period, edge_here - node});
      visit(node, count, block, l.first + k % l.period);
      k += count;
    }
  }

  void add_source(std::size_t block, Index node, Index count, Index force, const Run& run, bool plus) {
    const Index first = plus ? run.a : run.a + run.offset;
    of_block_[block].sources.push_back({node, count, force, run.origin, plus, first, first + run.count});
  }

  // Groups whose ends are others' nodes are booked by those: cut there.
  void add_span(std::size_t r, std::size_t block, Index node, Index groups, Index force) {
    const Run& run = topology_.runs[r];
    const Index parameter = layout_[r].parameter + (node - first_group_node(run)) / lanes;
    for (Index g = 0; g < groups;) {
      const Index row_node = booked_as(node + g * lanes);
      Index end = g + 1;
      while (end < groups &&
             booked_as(node + end * lanes) == (row_node < 0 ? -1 : row_node + (end - g) * lanes))
        ++end;
      (run.neighbours ? of_block_[block].neighbours : of_block_[block].spans)
          .push_back({node + g * lanes, end - g, run.offset, parameter + g, force + g * lanes, row_node, -1});
      g = end;
    }
  }

  // User's number of a group's first node where it is booked here, or -1. Grains are whole: one own node
  // tells.
  Index booked_as(Index node) const {
    for (Index i = node; i < std::min(node + lanes, nodes()); ++i)
      if (numbering_.own(i)) return numbering_.global[at(i)] / lanes * lanes;
    return -1;
  }

  void add_block(std::size_t b) {
    Block block{};
    const Index end = edge(b + 1);
    const auto size = [](const auto& list) { return static_cast<Index>(list.size()); };
    const auto append = [](auto& list, const auto& more) {
      list.insert(list.end(), more.begin(), more.end());
    };
    block.patch_begin = size(out_.patches);
    append(out_.patches, of_block_[b].patches);
    block.patch_end = size(out_.patches);
    block.link_begin = size(out_.links);
    while (size(out_.links) < size(topology_.links) && topology_.links[out_.links.size()].a < end) add_link();
    block.link_end = size(out_.links);
    block.kick_begin = size(out_.kicks);
    stretches_.clear();
    add_stretches(edge(b), end, of_block_[b].sources);
    add_link_kicks(end);
    const ChainRanges chains = cut_out_chains(of_block_[b].neighbours, stretches_);
    block.span_begin = size(out_.spans);
    append(out_.spans, of_block_[b].spans);
    block.neighbour_begin = size(out_.spans);
    block.stretch_begin = size(out_.stretches);
    for (kernel::Span span : chains.spans) {
      if (span.stretch >= 0) span.stretch += block.stretch_begin;
      out_.spans.push_back(span);
    }
    block.span_end = size(out_.spans);
    append(out_.stretches, chains.chain_stretches);
    block.chain_stretch_end = size(out_.stretches);
    append(out_.stretches, chains.stretches);
    block.stretch_end = size(out_.stretches);
    block.kick_end = size(out_.kicks);
    block.constraint_begin = next_constraint_;
    while (next_constraint_ < size(constraints_) && constraints_[at(next_constraint_)].node < end)
      ++next_constraint_;
    block.constraint_end = next_constraint_;
    out_.blocks.push_back(block);
  }

  void add_link() {
    const auto number = static_cast<Index>(out_.links.size());
    const LinkEnds& ends = topology_.links[at(number)];
    const Index force = first_link_ + number;
    const Index row = numbering_.own(ends.a) ? numbering_.global[at(ends.a)] / kernel::grain : -1;
    out_.links.push_back({ends.a, ends.b, force, row, 0, 0, 0, 0});
    for (const auto& [node, sign] : {std::pair{ends.a, 1.0}, {ends.b, -1.0}})
      if (numbering_.moved(node)) link_kicks_.emplace(node, kernel::Kick{node, force, sign});
  }

  // Those of nodes before `end`: both links of lower and of upper ends have been met by then.
  void add_link_kicks(Index end) {
    auto kick = link_kicks_.begin();
    for (; kick != link_kicks_.end() && kick->first < end; ++kick) out_.kicks.push_back(kick->second);
    link_kicks_.erase(link_kicks_.begin(), kick);
  }

  // The nodes [begin, end) cut where a source begins or ends; calls visit(begin, end, sources) for each
  // stretch.
  template <class Visit>
  static void cut(std::vector<Index> cuts, const Sources& sources, Visit visit) {
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    const auto number = [&](Index node) {
      return at(static_cast<Index>(std::lower_bound(cuts.begin(), cuts.end(), node) - cuts.begin()));
    };
    std::vector<Sources> of_stretch(cuts.size() - 1);
    for (const Source& s : sources)
      for (std::size_t i = number(s.node); cuts[i] < s.node + s.count; ++i)
        of_stretch[i].push_back(s.part(cuts[i], cuts[i + 1]));
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) visit(cuts[i], cuts[i + 1], of_stretch[i]);
  }

  void add_stretches(Index begin, Index end, const Sources& sources) {
    std::vector<Index> cuts{begin, end};
    for (const Source& s : sources) cuts.insert(cuts.end(), {s.node, s.node + s.count});
    for (Index i = begin + 1; i < end; ++i)
      if (numbering_.moved(i) != numbering_.moved(i - 1)) cuts.push_back(i);
    cut(std::move(cuts), sources, [&](Index from, Index to, const Sources& here) {
      if (!numbering_.moved(from)) return;
      if (simple(here)) add_stretch(from, to, terms_of(here));
      else add_busy_stretch(from, to, here);
    });
  }

  using Terms =
      std::map<Index, std::array<Index, 2>>;  // run of the scene -> plus, minus; in the order of the runs

  static Terms terms_of(const Sources& sources) {
    Terms terms;
    for (const Source& s : sources) terms[s.origin][s.plus ? 0 : 1] = s.force;
    return terms;
  }

  // Whether one pass takes all terms, and no two stretches of one run (which a cut of the scene has left)
  // overlap with their zeros.
  static bool simple(const Sources& sources) {
    std::map<std::pair<Index, bool>, int> count;
    std::set<Index> origins;
    for (const Source& s : sources) {
      if (++count[{s.origin, s.plus}] > 1) return false;
      origins.insert(s.origin);
    }
    return origins.size() <= kernel::max_terms;
  }

  // Where that is not so: cut without what is zero for all nodes, so that every cut of the scene finds the
  // same terms; those that no pass takes any more become kicks.
  void add_busy_stretch(Index begin, Index end, const Sources& sources) {
    std::vector<Index> cuts{begin, end};
    for (const Source& s : sources)
      for (const Index edge : {s.real_begin, s.real_end})
        if (edge > begin && edge < end) cuts.push_back(edge);
    cut(std::move(cuts), sources, [&](Index from, Index to, Sources here) {
      std::erase_if(here, [](const Source& s) { return !s.real(); });
      add_stretch(from, to, terms_of(here));
    });
  }

  void add_stretch(Index begin, Index end, const Terms& terms) {
    kernel::Stretch stretch{begin, end - begin, 0, {}, {}};
    for (const auto& [origin, forces] : terms) {
      if (stretch.terms < kernel::max_terms) {
        stretch.plus[stretch.terms] = forces[0];
        stretch.minus[stretch.terms++] = forces[1];
        continue;
      }
      for (Index k = 0; k < end - begin; ++k)
        for (std::size_t side = 0; side < 2; ++side)
          if (forces[side] != 0) out_.kicks.push_back({begin + k, forces[side] + k, side == 0 ? 1.0 : -1.0});
    }
    stretches_.push_back(stretch);
  }

  const Topology& topology_;
  const Numbering& numbering_;
  const std::vector<kernel::Constraint>& constraints_;
  Index block_size_;
  ForceReduction out_;
  Index longest_ = lanes;                          ///< block, in whole groups
  Index first_link_ = 0;                           ///< force of the first link
  std::vector<Layout> layout_;                     ///< run
  std::vector<OfBlock> of_block_;                  ///< block
  std::vector<kernel::Stretch> stretches_;         ///< of the present block
  std::multimap<Index, kernel::Kick> link_kicks_;  ///< by node, in the order of the links
  Index next_constraint_ = 0;
};

}  // namespace

ForceReduction reduce_forces(const Topology& topology, const Numbering& numbering,
                             const std::vector<kernel::Constraint>& constraints, Index block_size) {
  return Builder(topology, numbering, constraints, block_size).build();
}

}  // namespace cinch
