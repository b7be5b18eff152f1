// The broadphase's pairs: which elements and masses may touch which rings and balls until a margin of motion
// is used up. In the user's numbers; each thread takes from it what concerns its own nodes.
#pragma once
#include <cstdint>
#include <vector>

#include "base/archive.hpp"
#include "plan/broadphase.hpp"

namespace cinch {

class ContactList {
 public:
  /// `margin` in m; 0: some unstretched element lengths of the finest set.
  ContactList(const Model& model, double margin);

  /// Finds all pairs anew. The tallies of the balls' old pairs are summed up into one, those of new pairs
  /// begin.
  void rebuild(const Model& model, State& state);

  /// Saves or restores the pairs, as they were found in a state that is gone.
  void transfer(Archive& archive, const Model& model);

  double margin() const { return margin_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t pairs_tested() const { return pairs_tested_; }
  std::size_t memory() const;  ///< bytes, see memory.hpp

  std::vector<kernel::Pair> pairs;  ///< those of the rings in order, then those of the balls; each by element
  std::vector<Index> ring_begin;    ///< ring + 1
  std::vector<Index> ball_begin;    ///< ball + 1

 private:
  void require_ranges(const Archive& archive, const Model& model, std::int64_t pair_count) const;
  void find_ring_pairs(const Model& model, const State& state);
  void find_ball_pairs(const Model& model, const State& state);

  double margin_;
  std::vector<BoxTree> trees_;  ///< contact set
  std::vector<Index> found_;
  std::int64_t rebuilds_ = 0, pairs_tested_ = 0;
};

}  // namespace cinch
