#include "scene/net_pattern.hpp"

#include <algorithm>
#include <charconv>

namespace cinch {
namespace {

constexpr Index nodes_of_band = 2048;  // about a block of the force reduction
constexpr Index fewest_rows = 4;       // of a band: elements of the last column make runs of so many

}  // namespace

NetPattern::NetPattern(const Net& net)
    : columns_(net.columns()), rows_(net.rows()), sub_(net.elements_per_side), mesh_(net.mesh) {
  row_stride_ = (columns_ + 1) + sub_inner() * columns_ + sub_inner() * (columns_ + 1);
  const Index rows = nodes_of_band / row_stride_;
  band_rows_ = sub_ > 1 && rows >= fewest_rows ? rows : 1;
}

NetPattern::Band NetPattern::band_of(Index j) const {
  const Index row = j / band_rows_ * band_rows_;
  return {row, std::min(band_rows_, rows_ + 1 - row), std::min(band_rows_, rows_ - row), row * row_stride_};
}

// Among `rows` of nodes with one more than there are meshes.
Index NetPattern::of_upright(Index rows, Index row, Index i) const {
  return i < columns_ ? row * columns_ + i : rows * columns_ + row;
}

Index NetPattern::knot(Index i, Index j) const {
  const Band band = band_of(j);
  return band.first + of_upright(band.rows, j - band.row, i);
}

Index NetPattern::horizontal(Index i, Index j, Index k) const {
  if (k == 0) return knot(i, j);
  if (k == sub_) return knot(i + 1, j);
  const Band band = band_of(j);
  return band.first + band.rows * (columns_ + 1 + (k - 1) * columns_) + (j - band.row) * columns_ + i;
}

Index NetPattern::vertical(Index i, Index j, Index k) const {
  if (k == 0) return knot(i, j);
  if (k == sub_) return knot(i, j + 1);
  const Band band = band_of(j);
  const Index below = band.rows * (columns_ + 1 + sub_inner() * columns_);
  return band.first + below + band.upright * (k - 1) * (columns_ + 1) +
         of_upright(band.upright, j - band.row, i);
}

std::int64_t NetPattern::elements(const Net& net) {
  const std::int64_t columns = net.columns(), rows = net.rows();
  return net.elements_per_side * (columns * (rows + 1) + rows * (columns + 1));
}

std::int64_t NetPattern::nodes(const Net& net) {
  const std::int64_t columns = net.columns(), rows = net.rows();
  return elements(net) - columns * rows + 1;  // Euler: knots and inner nodes - elements + meshes = 1
}

std::vector<Index> NetPattern::edge(const std::string& name) const {
  std::vector<Index> nodes;
  if (name == "top" || name == "bottom") {
    const Index j = name == "top" ? rows_ : 0;
    for (Index i = 0; i < columns_; ++i)
      for (Index k = 0; k < sub_; ++k) nodes.push_back(horizontal(i, j, k));
    nodes.push_back(knot(columns_, j));
  } else if (name == "left" || name == "right") {
    const Index i = name == "right" ? columns_ : 0;
    for (Index j = 0; j < rows_; ++j)
      for (Index k = 0; k < sub_; ++k) nodes.push_back(vertical(i, j, k));
    nodes.push_back(knot(i, rows_));
  }
  // clockwise: the right edge runs downwards, the bottom edge from right to left
  if (name == "right" || name == "bottom") std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

namespace {

// "I.J" to two numbers; false when the text is not that.
bool parse_pair(std::string_view text, Index& i, Index& j) {
  const auto dot = text.find('.');
  if (dot == std::string_view::npos) return false;
  const auto whole = [](std::string_view part, Index& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size();
  };
  return whole(text.substr(0, dot), i) && whole(text.substr(dot + 1), j);
}

}  // namespace

Index NetPattern::place(const std::string& name) const {
  if (name == "top_left") return knot(0, rows_);
  if (name == "top_right") return knot(columns_, rows_);
  if (name == "bottom_right") return knot(columns_, 0);
  if (name == "bottom_left") return knot(0, 0);
  Index i = 0, j = 0;
  if (name.starts_with("knot.") && parse_pair(std::string_view(name).substr(5), i, j) && i >= 0 && j >= 0 &&
      i <= columns_ && j <= rows_)
    return knot(i, j);
  return -1;
}

}  // namespace cinch
