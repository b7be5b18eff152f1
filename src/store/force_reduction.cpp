#include "store/force_reduction.hpp"

#include <algorithm>

namespace cinch {
namespace {

// The part of nodes [first, first + count) of a run's end that lies in one block, as a piece.
void add_piece(std::vector<std::vector<kernel::GatherPiece>>& by_block, Index first, Index element,
               Index count, double sign) {
  for (Index done = 0; done < count;) {
    const Index node = first + done;
    const Index block = node / kernel::block_size;
    const Index room = (block + 1) * kernel::block_size - node;
    const Index take = std::min(room, count - done);
    by_block[static_cast<std::size_t>(block)].push_back({node, element + done, take, sign});
    done += take;
  }
}

}  // namespace

void cut_node_blocks(Index nodes, const std::vector<kernel::Span>& runs,
                     const std::vector<kernel::Constraint>& constraints,
                     std::vector<kernel::NodeBlock>& blocks, std::vector<kernel::GatherPiece>& pieces) {
  const Index count = (nodes + kernel::block_size - 1) / kernel::block_size;
  std::vector<std::vector<kernel::GatherPiece>> by_block(static_cast<std::size_t>(count));
  for (const kernel::Span& run : runs) {
    add_piece(by_block, run.a, run.element, run.count, 1);
    add_piece(by_block, run.b, run.element, run.count, -1);
  }
  Index constraint = 0;
  const auto total = static_cast<Index>(constraints.size());
  for (Index b = 0; b < count; ++b) {
    const Index first = b * kernel::block_size;
    kernel::NodeBlock block{
        first, std::min(kernel::block_size, nodes - first), static_cast<Index>(pieces.size()), 0, constraint,
        0};
    const auto& mine = by_block[static_cast<std::size_t>(b)];
    pieces.insert(pieces.end(), mine.begin(), mine.end());
    while (constraint < total && constraints[static_cast<std::size_t>(constraint)].node < first + block.count)
      ++constraint;
    block.piece_end = static_cast<Index>(pieces.size());
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
