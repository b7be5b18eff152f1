// The broadphase's pairs: which elements and masses may touch which rings and balls until a margin of motion
// is used up. In the user's numbers; each thread takes from it what concerns its own nodes.
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "base/archive.hpp"
#include "plan/broadphase.hpp"

namespace cinch {

/// Share of the contact distance by which a thread may approach a wire within a step. Together with the depth
/// of pressed_share (contact_health.hpp) none gets through unnoticed: what goes from one side of the wire's
/// middle to the other is seen at one step at least within 1 - pressed_share of it, as jump_share < 2 (1 -
/// pressed_share).
inline constexpr double jump_share = 0.5;

class ContactList {
 public:
  /// `margin` in m; 0: some unstretched element lengths of the finest set. Up to `threads` search at once.
  ContactList(const Model& model, double margin, int threads = 1);
  void use_threads(int threads) { searches_.resize(static_cast<std::size_t>(threads)); }

  /// Finds all pairs anew, the same for any number of threads. The tallies of the balls' old pairs are summed
  /// up into one, those of new pairs begin.
  void rebuild(const Model& model, State& state);

  /// Saves or restores the pairs, as they were found in a state that is gone.
  void transfer(Archive& archive, const Model& model);

  double margin() const { return margin_; }
  /// False where no pair can have passed through each other unnoticed in a step that let two nodes come
  /// closer by `approach` (m) and led to `motion` (m, as of NearContacts). Wires turn with the hosts of their
  /// rings, the faster the shorter those are.
  bool may_jump(double approach, double motion) const;
  /// Takes hosts as long as they are now: motion since then can have made them shorter, for may_jump().
  void measure_hosts(const Model& model, const State& state, double motion);
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t pairs_tested() const;
  std::size_t memory() const;  ///< bytes, see memory.hpp

  std::vector<kernel::Pair> pairs;  ///< those of the rings in order, then those of the balls; each by element
  std::vector<Index> ring_begin;    ///< ring + 1
  std::vector<Index> ball_begin;    ///< ball + 1

 private:
  void require_ranges(const Archive& archive, const Model& model, std::int64_t pair_count) const;
  /// What one thread finds.
  struct Search {
    std::vector<Index> positions;     ///< in a set
    std::vector<kernel::Pair> pairs;  ///< with rings; the first thread puts its own where all belong
    std::int64_t tested = 0;
  };
  void find_near_ring(const Model& model, const State& state, std::size_t ring, Search& search,
                      std::vector<kernel::Pair>& found) const;
  void find_ring_pairs(const Model& model, const State& state);
  void find_ball_pairs(const Model& model, const State& state);

  void find_longest_approach();

  double margin_;
  double longest_approach_ = std::numeric_limits<double>::infinity();  ///< m, unnoticed
  // of rings with pairs, on hosts
  double greatest_turning_ = 0;       ///< radius over the host's length
  double inverse_shortest_host_ = 0;  ///< 1/m
  double measured_at_ = 0;            ///< motion, m
  std::vector<BoxTree> trees_;        ///< contact set
  std::vector<Search> searches_;      ///< thread
  std::int64_t rebuilds_ = 0;
};

}  // namespace cinch
