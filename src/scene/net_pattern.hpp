// The numbering of a rectangular net: which node is where, which element joins what.
//
// Row by row: the knots of a row, then the inner nodes of its horizontal mesh sides (all first ones, all
// second ones,
// ...), then the inner nodes of the vertical sides above it, layer by layer. So every group of elements side
// by side has end nodes that rise by one: it becomes one run of the store, whatever the number of elements in
// a side.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cinch {

class NetPattern {
 public:
  explicit NetPattern(const Net& net);

  Index nodes() const { return rows_ * row_stride_ + columns_ + 1 + sub_inner() * columns_; }
  /// Node of horizontal side (column i, row j), k = 0 (left knot) .. elements_per_side (right knot).
  Index horizontal(Index i, Index j, Index k) const;
  /// Node of the vertical side above knot (i, j), k = 0 (lower knot) .. elements_per_side (upper knot).
  Index vertical(Index i, Index j, Index k) const;
  Index knot(Index i, Index j) const { return j * row_stride_ + i; }

  /// Unstretched place of each node in the net's plane, m, origin at the centre.
  std::vector<std::array<double, 2>> places() const;
  /// End nodes of each element, row by row.
  std::vector<std::array<Index, 2>> elements() const;
  /// Nodes along an edge ("top", "right", "bottom", "left"), clockwise; empty for another name.
  std::vector<Index> edge(const std::string& name) const;
  /// Node at "top_left", ..., "knot.I.J"; -1 where there is none.
  Index place(const std::string& name) const;

 private:
  Index sub_inner() const { return sub_ - 1; }
  Index columns_, rows_, sub_, row_stride_;
  double mesh_;
};

}  // namespace cinch
