// The numbering of a rectangular net: which node is where, which element joins what.
//
// Row by row: the knots of a row, then the inner nodes of its horizontal mesh sides (all first ones, all
// second ones, ...), then the inner nodes of the vertical sides above it, layer by layer. So every group of
// elements side by side has end nodes that rise by one: it becomes one run of the store, whatever the number
// of elements in a side.
//
// Rows of narrow nets with inner nodes would be short runs. Some of them make a band: the knots of all its
// rows, then all first nodes of horizontal sides, and so on. Where there is one more node to a row than there
// are meshes, the last ones of all rows come behind the others. So nodes of one mesh are equally far apart in
// all rows of a band, and elements of all rows become one run.
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
  Index knot(Index i, Index j) const;

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
  /// Rows from `row` on, `rows` of knots and `upright` of vertical sides.
  struct Band {
    Index row, rows, upright;
    Index first;  ///< node
  };
  Band band_of(Index j) const;
  Index sub_inner() const { return sub_ - 1; }
  Index of_upright(Index rows, Index row, Index i) const;

  Index columns_, rows_, sub_, row_stride_, band_rows_;
  double mesh_;
};

template <class Visit>
void NetPattern::for_each_node(Visit visit) const {
  const double step = mesh_ / sub_;
  const auto put = [&](Index column_steps, Index row_steps) {
    visit((column_steps - 0.5 * columns_ * sub_) * step, (row_steps - 0.5 * rows_ * sub_) * step);
  };
  for (Index j = 0; j <= rows_; j += band_rows_) {
    const Band band = band_of(j);
    const auto put_rows = [&](Index rows, Index right, Index up) {
      for (Index row = j; row < j + rows; ++row)
        for (Index i = 0; i < columns_; ++i) put(i * sub_ + right, row * sub_ + up);
    };
    const auto put_upright = [&](Index rows, Index up) {
      put_rows(rows, 0, up);
      for (Index row = j; row < j + rows; ++row) put(columns_ * sub_, row * sub_ + up);
    };
    put_upright(band.rows, 0);
    for (Index k = 1; k < sub_; ++k) put_rows(band.rows, k, 0);
    for (Index k = 1; k < sub_; ++k) put_upright(band.upright, k);
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
