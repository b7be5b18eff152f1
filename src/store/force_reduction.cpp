#include "store/force_reduction.hpp"

#include <algorithm>

namespace cinch {
namespace {

// Nodes [node, node + count) of one block take sign times the force of elements [element, element + count).
struct Piece {
  Index node, element, count;
  double sign;
};
using Pieces = std::vector<std::vector<Piece>>;  // of each block, in the order of the sum

// One end of a run, cut at the blocks' borders.
void add_pieces(Pieces& by_block, Index first, Index element, Index count, double sign) {
  for (Index done = 0; done < count;) {
    const Index node = first + done;
    const Index block = node / kernel::block_size;
    const Index room = (block + 1) * kernel::block_size - node;
    const Index take = std::min(room, count - done);
    by_block[static_cast<std::size_t>(block)].push_back({node, element + done, take, sign});
    done += take;
  }
}

// Cuts a block's nodes where a piece begins or ends: between two cuts all nodes have the same summands.
void add_stretches(const kernel::NodeBlock& block, const std::vector<Piece>& pieces, ElementGather& gather) {
  std::vector<Index> cuts{block.first, block.first + block.count};
  for (const Piece& p : pieces) cuts.insert(cuts.end(), {p.node, p.node + p.count});
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  const auto number = [&](Index node) {
    return static_cast<std::size_t>(std::lower_bound(cuts.begin(), cuts.end(), node) - cuts.begin());
  };
  std::vector<std::vector<kernel::GatherSource>> sources(cuts.size() - 1);
  for (const Piece& p : pieces)
    for (std::size_t s = number(p.node); cuts[s] < p.node + p.count; ++s)
      sources[s].push_back({p.element + cuts[s] - p.node, p.sign});
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const auto begin = static_cast<Index>(gather.sources.size());
    gather.sources.insert(gather.sources.end(), sources[s].begin(), sources[s].end());
    gather.stretches.push_back(
        {cuts[s], cuts[s + 1] - cuts[s], begin, static_cast<Index>(gather.sources.size())});
  }
}

}  // namespace

void cut_node_blocks(Index nodes, const std::vector<kernel::Span>& runs,
                     const std::vector<kernel::Constraint>& constraints,
                     std::vector<kernel::NodeBlock>& blocks, ElementGather& gather) {
  const Index count = (nodes + kernel::block_size - 1) / kernel::block_size;
  Pieces by_block(static_cast<std::size_t>(count));
  for (const kernel::Span& run : runs) {
    add_pieces(by_block, run.a, run.element, run.count, 1);
    add_pieces(by_block, run.b, run.element, run.count, -1);
  }
  Index constraint = 0;
  const auto total = static_cast<Index>(constraints.size());
  for (Index b = 0; b < count; ++b) {
    kernel::NodeBlock block{};
    block.first = b * kernel::block_size;
    block.count = std::min(kernel::block_size, nodes - block.first);
    block.stretch_begin = static_cast<Index>(gather.stretches.size());
    add_stretches(block, by_block[static_cast<std::size_t>(b)], gather);
    block.stretch_end = static_cast<Index>(gather.stretches.size());
    block.constraint_begin = constraint;
    while (constraint < total &&
           constraints[static_cast<std::size_t>(constraint)].node < block.first + block.count)
      ++constraint;
    block.constraint_end = constraint;
    blocks.push_back(block);
  }
}

void LoadGather::rebuild(const std::vector<Index>& node_of_slot, Index node_blocks) {
  entries.clear();
  for (std::size_t slot = 0; slot < node_of_slot.size(); ++slot)
    entries.push_back({node_of_slot[slot], static_cast<Index>(slot)});
  std::sort(entries.begin(), entries.end(), [](const kernel::LoadEntry& l, const kernel::LoadEntry& r) {
    return l.node != r.node ? l.node < r.node : l.slot < r.slot;
  });
  begin.assign(static_cast<std::size_t>(node_blocks) + 1, static_cast<Index>(entries.size()));
  std::size_t entry = 0;
  for (Index b = 0; b < node_blocks; ++b) {
    while (entry < entries.size() && entries[entry].node < b * kernel::block_size) ++entry;
    begin[static_cast<std::size_t>(b)] = static_cast<Index>(entry);
  }
}

}  // namespace cinch
