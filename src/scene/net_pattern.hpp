// The numbering of a rectangular net: which node is where, which element joins what.
//
// Row by row: the knots of a row, then the inner nodes of its horizontal mesh sides (all first ones, all
// second ones,
// ...), then the inner nodes of the vertical sides above it, layer by layer. So every group of elements side
// by side has end nodes that rise by one: it becomes one run of the store, whatever the number of elements in
// a side.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace cinch {

class NetPattern {
 public:
  explicit NetPattern(const Net& net);

  Index nodes() const { return rows_ * row_stride_ + columns_ + 1 + sub_inner() * columns_; }
  /// Of any net, even of one too large to be numbered.
  static std::int64_t elements(const Net& net);
  static std::int64_t nodes(const Net& net);
  /// Node of horizontal side (column i, row j), k = 0 (left knot) .. elements_per_side (right knot).
  Index horizontal(Index i, Index j, Index k) const;
  /// Node of the vertical side above knot (i, j), k = 0 (lower knot) .. elements_per_side (upper knot).
  Index vertical(Index i, Index j, Index k) const;
  Index knot(Index i, Index j) const { return j * row_stride_ + i; }

  /// Calls visit(x, y) for each node in the order of their numbers: its unstretched place in the net's plane,
  /// m, origin at the centre.
  template <class Visit>
  void for_each_node(Visit visit) const;
  /// Calls visit(a, b) with the end nodes of each element, row by row.
  template <class Visit>
  void for_each_element(Visit visit) const;
  /// Nodes along an edge ("top", "right", "bottom", "left"), clockwise; empty for another name.
  std::vector<Index> edge(const std::string& name) const;
  /// Node at "top_left", ..., "knot.I.J"; -1 where there is none.
  Index place(const std::string& name) const;

 private:
  Index sub_inner() const { return sub_ - 1; }
  Index columns_, rows_, sub_, row_stride_;
  double mesh_;
};

template <class Visit>
void NetPattern::for_each_node(Visit visit) const {
  const double step = mesh_ / sub_;
  const auto put = [&](Index column_steps, Index row_steps) {
    visit((column_steps - 0.5 * columns_ * sub_) * step, (row_steps - 0.5 * rows_ * sub_) * step);
  };
  for (Index j = 0; j <= rows_; ++j) {
    for (Index i = 0; i <= columns_; ++i) put(i * sub_, j * sub_);
    for (Index k = 1; k < sub_; ++k)
      for (Index i = 0; i < columns_; ++i) put(i * sub_ + k, j * sub_);
    if (j == rows_) break;
    for (Index k = 1; k < sub_; ++k)
      for (Index i = 0; i <= columns_; ++i) put(i * sub_, j * sub_ + k);
  }
}

template <class Visit>
void NetPattern::for_each_element(Visit visit) const {
  for (Index j = 0; j <= rows_; ++j) {
    for (Index k = 0; k < sub_; ++k)
      for (Index i = 0; i < columns_; ++i) visit(horizontal(i, j, k), horizontal(i, j, k + 1));
    if (j == rows_) break;
    for (Index k = 0; k < sub_; ++k)
      for (Index i = 0; i <= columns_; ++i) visit(vertical(i, j, k), vertical(i, j, k + 1));
  }
}

}  // namespace cinch
