// Ways to add element forces up at nodes, side by side on one net and by one law, with index arrays as any
// graph needs them. The solver gathers, too, but without index arrays (store/force_reduction.hpp).
//
// Each gives the same bits for any number of threads: the order of a node's sum hangs on the net alone.
#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned.hpp"
#include "base/index.hpp"

namespace cinch::bench {

enum class SumWay {
  gather,            ///< each element writes its force; each node adds up those of its elements
  coloured_scatter,  ///< elements add to both ends, colour by colour: none of a colour share a node
  private_sums       ///< each stretch of elements adds to an array of its own; these are added in order
};

/// A square net as scenes.hpp has it, one element a mesh side, taut by 0.1 %.
class SummedNet {
 public:
  /// What loops over elements read: addresses that no store changes.
  struct Net {
    const double *x, *y, *z, *u, *v, *w;
    const Index *a, *b;
  };

  SummedNet(std::int64_t knots, SumWay way, int threads);
  void advance(std::int64_t steps);
  Index nodes() const { return static_cast<Index>(place_[0].size()); }
  Index elements() const { return static_cast<Index>(end_a_.size()); }
  const AlignedVector<double>& places(int axis) const { return place_[axis]; }  ///< of nodes, m

 private:
  /// Elements that follow each other, and the nodes that they pull at.
  struct Stretch {
    Index begin, end, first_node, last_node;
    AlignedVector<double> force[3];  ///< N, of those nodes
  };

  void add_element(Index a, Index b);
  void sort_by_colour(const std::vector<Index>& colour);
  void list_elements_of_nodes();
  void cut_stretches();
  Net net() const;
  void step(int thread);
  void gather(int thread);
  void scatter(int thread);
  void sum_privately(int thread);
  void move(Index begin, Index end);

  SumWay way_;
  int threads_;
  AlignedVector<double> place_[3], speed_[3], force_[3], pull_[3];  ///< the last: of elements
  std::vector<Index> end_a_, end_b_;
  std::vector<Index> colour_begin_;             ///< colour + 1
  std::vector<Index> of_node_begin_, of_node_;  ///< node + 1; elements, -1 - e at an element's end b
  std::vector<Stretch> stretches_;
};

}  // namespace cinch::bench
