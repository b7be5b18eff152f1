// The candidates of rings and balls, their loads on nodes, and how long the list stays good.
#pragma once
#include <cstdint>
#include <vector>

#include "plan/broadphase.hpp"
#include "store/force_reduction.hpp"

namespace cinch {

class ContactList {
 public:
  /// `margin` in m; 0: half the mean unstretched element length of the finest set.
  ContactList(const Model& model, double margin);

  /// Finds all candidates anew; tallies of rings that have lost their candidates are released.
  void rebuild(const Model& model, State& state);

  double margin() const { return margin_; }
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t pairs_tested() const { return pairs_tested_; }

  // candidates: those of the rings in order, then those of the balls
  std::vector<kernel::Candidate> candidates;
  std::vector<Index> ring_begin;                 ///< ring + 1
  std::vector<Index> ball_begin;                 ///< ball + 1
  Index host_slot = 0;                           ///< slots: 2 for each candidate, then 2 for each ring's host
  AlignedVector<double> load_x, load_y, load_z;  ///< slot, N
  LoadGather gather;

 private:
  void find_ring_candidates(const Model& model, State& state);
  void find_ball_candidates(const Model& model, const State& state);
  void lay_out_slots(const Model& model);

  double margin_;
  std::vector<BoxTree> trees_;  ///< contact set
  std::vector<Index> found_;
  std::int64_t rebuilds_ = 0, pairs_tested_ = 0;
};

}  // namespace cinch
