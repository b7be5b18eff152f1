// The contacts of one thread's nodes: which of the broadphase's pairs are worth a look in this step, and the
// forces of those that touch.
//
// The greatest speed tells how much two surfaces approach each other at most, so a pair with a gap need not
// be looked at until that much motion has gone by: how much, its own ring's host decides as it lies then
// (ring_sleep.hpp). Pairs sleep accordingly; those that could touch within a short window of motion are near
// and are evaluated every step. Sleeping pairs do not touch, so the forces are those of all pairs.
#pragma once
#include <span>
#include <vector>

#include "kernels/kernel_table.hpp"
#include "plan/own_tallies.hpp"
#include "plan/step_plan.hpp"

namespace cinch {

/// Pairs in a thread's own numbers: those of rings by ring and element, then those of balls.
struct LocalContacts {
  std::vector<kernel::Pair> pairs;
  Index ball_begin = 0;                          ///< first pair with a ball
  std::vector<kernel::RingGeometry> rings;       ///< ring
  std::vector<kernel::RingTally*> ring_tallies;  ///< ring: null where another thread books it
  std::vector<double> centers;                   ///< ball x 3, m
  std::vector<kernel::BallTally*> ball_tallies;  ///< pair: likewise; null for pairs with rings
  bool shared = false;                           ///< among threads
};

/// The state that contacts look at; all of a thread's nodes.
struct NodeView {
  const double *x, *y, *z, *vx, *vy, *vz, *share;
};

class NearContacts {
 public:
  /// Takes a new list; all its pairs are awake. `margin`: the motion for which the list is good, m. `share`:
  /// node_share by node.
  void renew(LocalContacts contacts, double margin, const double* share);

  /// Takes what is booked from the state and gives it back, before and after steps.
  void take() { ring_tallies_.take(), ball_tallies_.take(); }
  void give() const { ring_tallies_.give(), ball_tallies_.give(); }

  /// Evaluates the contacts at `time`, when `motion` (m: by which two nodes can have come closer, twice the
  /// way of the fastest) of the margin has gone by. Books over `booked_dt` s (0: only what is of this
  /// moment). `loads` holds the forces then.
  void evaluate(const NodeView& nodes, const StepPlan& plan, double time, double booked_dt, double motion);

  /// All nodes that may feel one.
  std::vector<Index> nodes() const;
  /// Motion up to which nothing touches.
  double asleep_until() const;

  std::span<const kernel::Load> loads() const {
    return {loads_.data(), static_cast<std::size_t>(load_count_)};
  }
  std::int64_t evaluated() const { return evaluated_; }  ///< pairs so far
  std::size_t memory() const;                            ///< bytes, see memory.hpp

 private:
  void find_near(double motion);
  void wake(double motion);

  const KernelTable& kernels_ = kernels();
  LocalContacts contacts_;
  OwnTallies<kernel::RingTally> ring_tallies_;
  OwnTallies<kernel::BallTally> ball_tallies_;
  std::vector<kernel::RingLane> lanes_;  ///< pair with a ring
  AlignedVector<double> scratch_;
  double window_ = 0;           ///< m
  double near_until_ = 0;       ///< motion up to which `near_` is complete
  std::vector<double> asleep_;  ///< pair: motion up to which it sleeps
  std::vector<Index> near_;     ///< pairs that wake within the window, ascending
  std::size_t near_count_ = 0;
  std::vector<Index> awake_;                 ///< those that could touch now
  Index awake_count_ = 0, awake_rings_ = 0;  ///< all, and those with rings, which come first
  std::vector<double> sleep_;                ///< awake pair: motion that it needs to touch; of balls the gap
  std::vector<kernel::Load> loads_;          ///< room for all
  Index load_count_ = 0;
  std::int64_t evaluated_ = 0;
};

}  // namespace cinch
