// Runs, numberings of pieces and the force reduction: every element's force reaches its two nodes once, in
// one and the same order, however a scene is cut. An interpreter reads the lists that kernels work from and
// does what they say with whole numbers as forces, so that sums are exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "store/force_reduction.hpp"
#include "support/graphs.hpp"

namespace {

using namespace cinch;
using test::Graph;
using test::sample_graphs;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Topology cut(const Graph& g) { return cut_runs(g.a, g.b); }

// ----------------------------------------------------------------------------------------------------
// Runs

TEST(Runs, CoverEveryElementOnceWithItsEnds) {
  for (const Graph& g : sample_graphs()) {
    SCOPED_TRACE(g.name);
    const Topology topology = cut(g);
    std::vector<int> seen(g.size());
    const auto check = [&](Index element, Index a, Index b) {
      ++seen[at(element)];
      ASSERT_EQ(std::minmax(g.a[at(element)], g.b[at(element)]), std::minmax(a, b));
      ASSERT_LT(a, b);
    };
    Index next = 0;
    for (const cinch::Run& run : topology.runs) {
      ASSERT_EQ(run.slot, next);
      for (Index k = 0; k < run.count; ++k)
        if (const Index e = topology.slot_element[at(run.slot + k)]; e >= 0)
          check(e, run.a + k, run.a + k + run.offset);
      EXPECT_GE(topology.slot_element[at(run.slot)], 0) << "a run begins with an element";
      EXPECT_GE(topology.slot_element[at(run.slot + run.count - 1)], 0) << "and ends with one";
      next += run.count;
    }
    EXPECT_EQ(next, static_cast<Index>(topology.slot_element.size()));
    for (const LinkEnds& link : topology.links) check(link.element, link.a, link.b);
    EXPECT_EQ(seen, std::vector<int>(g.size(), 1));
  }
}

TEST(Runs, FollowThreadsAndNets) {
  const auto counts = [](const Graph& g) {
    const Topology t = cut(g);
    return std::pair{t.runs.size(), t.links.size()};
  };
  EXPECT_EQ(counts(test::thread_graph(1000)), std::pair(std::size_t{1}, std::size_t{0}));
  EXPECT_EQ(counts(test::net_graph(10, 10, 1)), std::pair(std::size_t{2}, std::size_t{0}))
      << "rows and columns";
  EXPECT_EQ(counts(test::net_graph(1000, 20, 1)), std::pair(std::size_t{2}, std::size_t{0}));
  EXPECT_EQ(counts(test::net_graph(10, 10, 4)), std::pair(std::size_t{8}, std::size_t{11}))
      << "whatever the number of rows; links end in the last knot of each";
  EXPECT_LE(counts(test::net_graph(30, 30, 2)).first, 2u * 10) << "two bands";
  EXPECT_EQ(counts(test::dressed_net_graph(10, 10, 4, 240)), std::pair(std::size_t{2}, std::size_t{4}))
      << "threads go on where the rows end; each hangs on one link";
}

TEST(Runs, FewSlotsAreVoid) {
  for (const Graph& g : sample_graphs()) {
    SCOPED_TRACE(g.name);
    const Topology topology = cut(g);
    const auto voids = std::count(topology.slot_element.begin(), topology.slot_element.end(), -1);
    EXPECT_LE(voids, static_cast<std::ptrdiff_t>(topology.slot_element.size() * 7 / 8));
    if (g.name.starts_with("net")) {
      EXPECT_LE(voids, static_cast<std::ptrdiff_t>(topology.slot_element.size() / 2));
    }
  }
}

// ----------------------------------------------------------------------------------------------------
// Pieces

// Shares of whole grains: by stretches, every other grain, or as dice fall.
std::vector<std::vector<Index>> shares(Index nodes, int pieces, int way) {
  std::mt19937 random(9);
  std::vector<std::vector<Index>> out(at(pieces));
  const Index grains = (nodes + kernel::grain - 1) / kernel::grain;
  std::vector<int> owner;
  for (Index g = 0; g < grains; ++g)
    owner.push_back(
        way == 0 ? static_cast<int>(g * pieces / grains)
                 : (way == 1 ? static_cast<int>(g % pieces) : static_cast<int>(random() % unsigned(pieces))));
  for (Index i = 0; i < nodes; ++i) out[at(owner[at(i / kernel::grain)])].push_back(i);
  return out;
}

// Steps of the graph from the nearest own node, by brute force.
std::vector<int> distances(const Graph& g, const std::vector<Index>& own, int limit) {
  std::vector<int> d(at(g.nodes), limit + 1);
  for (const Index i : own) d[at(i)] = 0;
  for (int round = 0; round < limit; ++round)
    for (std::size_t e = 0; e < g.size(); ++e) {
      d[at(g.b[e])] = std::min(d[at(g.b[e])], d[at(g.a[e])] + 1);
      d[at(g.a[e])] = std::min(d[at(g.a[e])], d[at(g.b[e])] + 1);
    }
  return d;
}

TEST(Numberings, HoldOwnNodesAndTheirGhosts) {
  for (const Graph& g : sample_graphs())
    for (const int depth : {1, 3})
      for (const auto& own : shares(g.nodes, 3, 2)) {
        SCOPED_TRACE(g.name);
        const Numbering n = Numbering::of(own, cut(g), g.nodes, depth);
        const std::vector<int> distance = distances(g, own, depth);
        Index last = -1, ghosts = 0;
        for (Index i = 0; i < n.nodes(); ++i) {
          const Index global = n.global[at(i)];
          if (global < 0) {
            EXPECT_FALSE(n.moved(i) || n.own(i) || n.ghost(i));
            continue;
          }
          EXPECT_LT(last, global) << "ascending";
          EXPECT_EQ(i % kernel::lanes, global % kernel::lanes) << "the same lane everywhere";
          EXPECT_EQ(n.local(global), i);
          EXPECT_EQ(n.layer[at(i)], distance[at(global)]);
          EXPECT_EQ(n.moved(i), distance[at(global)] < depth);
          ghosts += n.ghost(i);
          last = global;
        }
        EXPECT_EQ(n.ghosts(), ghosts);
        for (Index i = 0; i < g.nodes; ++i) EXPECT_EQ(n.local(i) >= 0, distance[at(i)] <= depth);
        EXPECT_EQ(n.local(g.nodes), -1);
        EXPECT_LE(n.nodes(), (static_cast<Index>(own.size()) + ghosts) * kernel::lanes);
      }
}

TEST(Numberings, OfAllIsTheUsersOwn) {
  const Numbering n = Numbering::all(300);
  for (Index i = 0; i < 300; ++i) {
    EXPECT_EQ(n.local(i), i);
    EXPECT_TRUE(n.own(i) && n.moved(i));
  }
  EXPECT_EQ(n.nodes(), 300);
  EXPECT_EQ(n.ghosts(), 0);
}

// ----------------------------------------------------------------------------------------------------
// The reduction

// What one node takes: forces of elements by number, with their signs, in order; terms of one pass stand
// together.
struct Taken {
  std::vector<std::vector<int>> terms;  // of the pass: each run's +(e + 1) and -(e + 1), zeros left out
  std::vector<int> kicks;
  bool operator==(const Taken&) const = default;
};

// Whether chains go in a pass of their own, which leaves only its last group's forces behind.
enum class Chains { in_two_passes, in_one_pass };

// Does what the lists say. A force is the element's number + 1, so that zero is no element.
class Interpreter {
 public:
  Interpreter(const Topology& topology, const Numbering& numbering, Chains chains = Chains::in_one_pass)
      : topology_(topology),
        numbering_(numbering),
        fused_(chains == Chains::in_one_pass),
        lists_(reduce_forces(topology, numbering, {}, 256)),  // small graphs shall have many blocks
        force_(at(lists_.force_count), 0) {
    for (const cinch::Run& run : topology.runs)
      for (Index g = 0; g < group_count(run); ++g) groups_.push_back({&run, g});
  }

  // One step; visit(global node, what it takes) for each node that moves.
  template <class Visit>
  void step(Visit visit) {
    Index next_node = 0;
    for (std::size_t b = 0; b < lists_.blocks.size(); ++b) {
      const Block& block = lists_.blocks[b];
      ASSERT_EQ(lists_.edges[b], next_node);
      next_node = lists_.edges[b + 1];
      for (Index p = block.patch_begin; p < block.patch_end; ++p) patch(lists_.patches[at(p)]);
      for (Index i = block.span_begin; i < block.neighbour_begin; ++i) {
        ASSERT_FALSE(groups_[at(lists_.spans[at(i)].parameter)].run->neighbours);
        compute(lists_.spans[at(i)]);
      }
      for (Index l = block.link_begin; l < block.link_end; ++l)
        force_[at(lists_.links[at(l)].force)] = topology_.links[at(l)].element + 1;
      std::map<Index, Taken> taken;
      Index last = -1, chains = 0;
      for (Index i = block.neighbour_begin; i < block.span_end; ++i) {
        const kernel::Span& span = lists_.spans[at(i)];
        ASSERT_GE(span.node, last) << "ascending";
        ASSERT_EQ(span.step, 1);
        last = span.node;
        chains += span.stretch >= 0;
        if (fused_ && span.stretch >= 0) update(span, lists_.stretches[at(span.stretch)], taken);
        else compute(span);
      }
      ASSERT_EQ(chains, block.chain_stretch_end - block.stretch_begin);
      for (Index s = fused_ ? block.chain_stretch_end : block.stretch_begin; s < block.stretch_end; ++s)
        gather(lists_.stretches[at(s)], taken);
      for (Index k = block.kick_begin; k < block.kick_end; ++k) {
        const kernel::Kick& kick = lists_.kicks[at(k)];
        ASSERT_TRUE(moved_.contains(kick.node)) << "kicked after it has moved";
        if (const int f = force_[at(kick.force)]; f != 0)
          (taken.contains(kick.node) ? taken[kick.node] : late_[kick.node])
              .kicks.push_back(kick.sign > 0 ? f : -f);
      }
      for (const auto& [node, what] : taken) visit(numbering_.global[at(node)], what);
      ASSERT_TRUE(late_.empty()) << "a kick comes with its node's block";
    }
    EXPECT_EQ(next_node, numbering_.nodes());
    moved_.clear();
  }

  const std::multimap<Index, Index>& rows() const { return rows_; }  // ledger row -> element, as booked
  int chains() const { return chains_; }                             // met so far

 private:
  struct Group {
    const cinch::Run* run;
    Index number;
  };

  void patch(const kernel::Patch& p) {
    for (Index k = 0; k < p.count; ++k) force_[at(p.to + k)] = p.from < 0 ? 0 : force_[at(p.from + k)];
  }

  void compute(const kernel::Span& span) {
    ASSERT_EQ(span.node % kernel::lanes, 0);
    for (Index g = 0; g < span.groups; ++g) {
      const auto [run, number] = groups_[at(span.parameter + g)];
      ASSERT_EQ(first_group_node(*run) + number * kernel::lanes, span.node + g * kernel::lanes);
      ASSERT_EQ(span.step, run->offset);
      for (Index lane = 0; lane < kernel::lanes; ++lane) {
        const Index node = span.node + g * kernel::lanes + lane, k = node - run->a;
        ASSERT_LT(node + span.step, numbering_.nodes() + kernel::lanes) << "within what can be read";
        const Index e = k >= 0 && k < run->count ? topology_.slot_element[at(run->slot + k)] : -1;
        force_[at(span.force + g * kernel::lanes + lane)] = e + 1;
        if (e < 0) continue;
        ASSERT_FALSE(moved_.contains(node) || moved_.contains(node + span.step))
            << "computed before its ends move";
        if (span.row_node >= 0) rows_.emplace((span.row_node + g * kernel::lanes + lane) / kernel::grain, e);
      }
    }
  }

  void update(const kernel::Span& span, const kernel::Stretch& stretch, std::map<Index, Taken>& taken) {
    ASSERT_EQ(span.node, stretch.node);
    ASSERT_EQ(span.groups * kernel::lanes, stretch.count) << "whole groups";
    ASSERT_EQ(span.force, stretch.plus[0]);
    ASSERT_EQ(span.force - 1, stretch.minus[0]);
    compute(span);
    gather(stretch, taken);
    for (Index k = 0; k < stretch.count - kernel::lanes; ++k) force_[at(span.force + k)] = unwritten;
    ++chains_;
  }

  void gather(const kernel::Stretch& s, std::map<Index, Taken>& taken) {
    ASSERT_GT(s.count, 0);
    ASSERT_LE(s.terms, kernel::max_terms);
    for (Index k = 0; k < s.count; ++k) {
      Taken& node = taken[s.node + k];
      ASSERT_TRUE(moved_.insert(s.node + k).second) << "moved once";
      for (Index t = 0; t < s.terms; ++t) {
        std::vector<int> term;
        ASSERT_TRUE(force_[at(s.plus[t] + k)] != unwritten && force_[at(s.minus[t] + k)] != unwritten);
        if (const int f = force_[at(s.plus[t] + k)]; f != 0) term.push_back(f);
        if (const int f = force_[at(s.minus[t] + k)]; f != 0) term.push_back(-f);
        if (!term.empty()) node.terms.push_back(term);
      }
    }
  }

  static constexpr int unwritten = 1 << 30;

  const Topology& topology_;
  const Numbering& numbering_;
  bool fused_;
  ForceReduction lists_;
  int chains_ = 0;
  std::vector<int> force_;
  std::vector<Group> groups_;
  std::set<Index> moved_;
  std::map<Index, Taken> late_;
  std::multimap<Index, Index> rows_;
};

// Elements at each node, + where it is the lower end.
std::vector<std::vector<int>> incident(const Graph& g) {
  std::vector<std::vector<int>> at_node(at(g.nodes));
  for (std::size_t e = 0; e < g.size(); ++e) {
    const auto [low, high] = std::minmax(g.a[e], g.b[e]);
    at_node[at(low)].push_back(static_cast<int>(e) + 1);
    at_node[at(high)].push_back(-static_cast<int>(e) - 1);
  }
  return at_node;
}

std::vector<int> all_of(const Taken& taken) {
  std::vector<int> all = taken.kicks;
  for (const auto& term : taken.terms) all.insert(all.end(), term.begin(), term.end());
  std::sort(all.begin(), all.end());
  return all;
}

TEST(ForceReduction, EveryNodeTakesItsElementsOnce) {
  for (const Graph& g : sample_graphs())
    for (const Chains chains : {Chains::in_two_passes, Chains::in_one_pass}) {
      SCOPED_TRACE(g.name);
      const Topology topology = cut(g);
      const Numbering numbering = Numbering::all(g.nodes);
      std::vector<std::vector<int>> wanted = incident(g);
      for (auto& list : wanted) std::sort(list.begin(), list.end());
      Interpreter interpreter(topology, numbering, chains);
      for (int step = 0; step < 2; ++step) {  // a buffer that another step has used
        Index nodes = 0;
        interpreter.step([&](Index node, const Taken& taken) {
          ASSERT_EQ(all_of(taken), wanted[at(node)]) << "node " << node << ", step " << step;
          ++nodes;
        });
        ASSERT_FALSE(HasFatalFailure());
        EXPECT_EQ(nodes, g.nodes);
      }
    }
}

TEST(ForceReduction, ChainsAreFoundInThreadsAndInTheRowsOfANet) {
  const auto chains = [](const Graph& g) {
    const Topology topology = cut(g);
    const Numbering numbering = Numbering::all(g.nodes);
    Interpreter interpreter(topology, numbering);
    interpreter.step([](Index, const Taken&) {});
    return interpreter.chains();
  };
  EXPECT_EQ(chains(test::thread_graph(200)), 1);
  EXPECT_EQ(chains(test::thread_graph(1000)), 4) << "one a block";
  EXPECT_GE(chains(test::net_graph(100, 100, 1)), 40);
  EXPECT_EQ(chains(test::thread_graph(20)), 0) << "too short to pay";
}

TEST(ForceReduction, PiecesTakeTheSameInTheSameOrder) {
  for (const Graph& g : sample_graphs()) {
    const Topology topology = cut(g);
    const Numbering all = Numbering::all(g.nodes);
    std::map<Index, Taken> whole;
    Interpreter(topology, all, Chains::in_two_passes).step([&](Index node, const Taken& taken) {
      whole[node] = taken;
    });
    for (const int pieces : {2, 3, 5})
      for (const int way : {0, 1, 2})
        for (const int depth : {1, 2}) {
          SCOPED_TRACE(g.name + ", " + std::to_string(pieces) + " pieces, way " + std::to_string(way) +
                       ", depth " + std::to_string(depth));
          Index own_nodes = 0;
          for (const auto& own : shares(g.nodes, pieces, way)) {
            const Numbering numbering = Numbering::of(own, topology, g.nodes, depth);
            const Topology local = local_topology(topology, numbering);
            Interpreter interpreter(local, numbering);
            interpreter.step([&](Index node, const Taken& taken) {
              if (!numbering.own(numbering.local(node))) return;
              ASSERT_EQ(taken.terms, whole[node].terms) << "node " << node;
              ASSERT_EQ(taken.kicks, whole[node].kicks) << "node " << node;
              ++own_nodes;
            });
            ASSERT_FALSE(HasFatalFailure());
          }
          EXPECT_EQ(own_nodes, g.nodes);
        }
  }
}

// Elements of each row and lane of the ledger in the order in which they are booked.
using Booked = std::map<std::pair<Index, Index>, std::vector<Index>>;

void book(const Graph& g, Interpreter& interpreter, Booked& booked) {
  interpreter.step([](Index, const Taken&) {});
  for (const auto& [row, element] : interpreter.rows())
    booked[{row, std::min(g.a[at(element)], g.b[at(element)]) % kernel::lanes}].push_back(element);
}

TEST(ForceReduction, PiecesBookInTheSameOrder) {
  for (const Graph& g : sample_graphs()) {
    const Topology topology = cut(g);
    const Numbering all = Numbering::all(g.nodes);
    Booked whole;
    Interpreter interpreter(topology, all);
    book(g, interpreter, whole);
    for (const int way : {0, 1, 2}) {
      SCOPED_TRACE(g.name + ", way " + std::to_string(way));
      Booked pieces;
      for (const auto& own : shares(g.nodes, 3, way)) {
        const Numbering numbering = Numbering::of(own, topology, g.nodes, 1);
        const Topology local = local_topology(topology, numbering);
        Interpreter piece(local, numbering);
        book(g, piece, pieces);
      }
      EXPECT_EQ(pieces, whole);
    }
  }
}

TEST(ForceReduction, EachElementIsBookedOnceInTheRowOfItsLowerEnd) {
  for (const Graph& g : sample_graphs()) {
    SCOPED_TRACE(g.name);
    const Topology topology = cut(g);
    std::vector<int> booked(g.size());
    for (const auto& own : shares(g.nodes, 3, 1)) {
      const Numbering numbering = Numbering::of(own, topology, g.nodes, 2);
      const Topology local = local_topology(topology, numbering);
      Interpreter interpreter(local, numbering);
      interpreter.step([](Index, const Taken&) {});
      for (const auto& [row, element] : interpreter.rows()) {
        ++booked[at(element)];
        EXPECT_EQ(row, std::min(g.a[at(element)], g.b[at(element)]) / kernel::grain);
      }
      const ForceReduction lists = reduce_forces(local, numbering, {});
      for (std::size_t l = 0; l < lists.links.size(); ++l)
        if (lists.links[l].row >= 0) {
          const Index element = local.links[l].element;
          ++booked[at(element)];
          EXPECT_EQ(lists.links[l].row, std::min(g.a[at(element)], g.b[at(element)]) / kernel::grain);
        }
    }
    EXPECT_EQ(booked, std::vector<int>(g.size(), 1));
  }
}

TEST(ForceReduction, ConstraintsGoWithTheirBlocks) {
  const Graph g = test::thread_graph(1000);
  std::vector<kernel::Constraint> constraints;
  for (Index node = 0; node < g.nodes; node += 3) constraints.push_back({node, 1, 0, 0, 1});
  const ForceReduction lists = reduce_forces(cut(g), Numbering::all(g.nodes), constraints);
  Index next = 0;
  for (std::size_t b = 0; b < lists.blocks.size(); ++b) {
    EXPECT_EQ(lists.blocks[b].constraint_begin, next);
    for (; next < lists.blocks[b].constraint_end; ++next) {
      EXPECT_GE(constraints[at(next)].node, lists.edges[b]);
      EXPECT_LT(constraints[at(next)].node, lists.edges[b + 1]);
    }
  }
  EXPECT_EQ(next, static_cast<Index>(constraints.size()));
}

TEST(ForceReduction, ForcesOfANetFitIntoTheCache) {
  const Graph g = test::net_graph(400, 400, 1);
  const Topology topology = cut(g);
  for (const Index block : {256, 2048})
    EXPECT_LT(reduce_forces(topology, Numbering::all(g.nodes), {}, block).force_count, 2200 + 3 * block)
        << "of 320,800 elements: rows stay a block long, columns a row and a block";
}

// A side of 64 elements is a run, and there are 1804 of them.
TEST(ForceReduction, ShortRunsTakeNoMoreThanTheirForces) {
  for (const auto& [columns, rows] : {std::pair{4, 200}, std::pair{200, 4}}) {
    const Graph g = test::net_graph(columns, rows, 64);
    const ForceReduction lists = reduce_forces(cut(g), Numbering::all(g.nodes), {});
    EXPECT_LT(lists.force_count, 3 * static_cast<Index>(g.size())) << g.name;
  }
}

}  // namespace
