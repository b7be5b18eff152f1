// Which elements may touch which ring or ball until a margin of motion is used up.
//
// Groups of a few elements that follow each other along a thread get axis-aligned boxes; pairs of groups,
// pairs of pairs and so on get theirs, a binary tree in the order of the elements. Each ring (a ball of
// radius `reach` around its centre, whatever way it turns) and each target descends it. Building is linear in
// the elements, a query logarithmic, and candidates come out in ascending order without sorting.
#pragma once
#include <cstdint>
#include <vector>

#include "store/model.hpp"
#include "store/state.hpp"

namespace cinch {

/// Axis-aligned box, m.
struct Box {
  double low[3], high[3];
};

/// The tree of boxes over the elements of one contact set.
class BoxTree {
 public:
  static constexpr Index leaf_size = 8;

  /// Boxes of the set's elements as they lie now. Up to `threads` share the work.
  void build(const Model& model, const ContactSet& set, const State& state, int threads);
  /// Appends the positions in the set of all elements that lie within `distance` (m, centre lines) of
  /// `center`.
  void query(const Model& model, const ContactSet& set, const State& state, const Vec3& center,
             double distance, std::vector<Index>& found, std::int64_t& pairs_tested) const;
  std::size_t memory() const;  ///< bytes, see memory.hpp

 private:
  std::vector<std::vector<Box>> levels_;  ///< levels_[0]: groups of elements; the last one: one box
};

/// Distance of the point from the segment between two nodes, m.
double distance_to_element(const State& state, Index a, Index b, const Vec3& center);

}  // namespace cinch
