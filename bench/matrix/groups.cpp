// All groups, one after the other.
#include "groups.hpp"

namespace cinch::matrix {

std::vector<Cell> all_cells(Extent extent) {
  std::vector<Cell> all;
  for (const auto group : {stiffness, slack, step, motion, threads})
    for (Cell& cell : group(extent)) all.push_back(std::move(cell));
  return all;
}

}  // namespace cinch::matrix
