// Shares of threads: every node once, and as little as can be computed twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "input/case_reader.hpp"
#include "plan/partition.hpp"
#include "plan/simulation.hpp"
#include "support/quick_cases.hpp"

namespace {

using namespace cinch;

// The net of the paper's capture with its threads in their rings, right after they have been laid; its
// closing phase comes early.
class Partition : public testing::Test {
 protected:
  Simulation simulation{
      read_case(CINCH_SOURCE_DIR "/cases/capture.toml", {{"closing.time_s", "0.01"}, {"time.end_s", "0.02"}}),
      1};

  Partition() { simulation.advance_to(simulation.preparation().timeline.step_at(0.0101)); }

  const Model& model() const { return simulation.model(); }
  const ContactList& contacts() const { return simulation.stepper().contacts(); }

  std::vector<int> owners(int pieces) {
    std::vector<int> owner(static_cast<std::size_t>(model().nodes), -1);
    const auto shares = partition(model(), simulation.state(), contacts(), pieces);
    for (std::size_t p = 0; p < shares.size(); ++p)
      for (const Index node : shares[p]) {
        EXPECT_EQ(owner[static_cast<std::size_t>(node)], -1) << "node " << node;
        owner[static_cast<std::size_t>(node)] = static_cast<int>(p);
      }
    return owner;
  }
};

TEST_F(Partition, TakesEveryNodeOnce) {
  for (int pieces = 1; pieces <= 5; ++pieces) {
    const std::vector<int> owner = owners(pieces);
    EXPECT_EQ(std::count(owner.begin(), owner.end(), -1), 0);
  }
}

TEST_F(Partition, OfACaptureHalvesNetAndThreadsTogether) {
  const std::vector<int> owner = owners(2);
  const auto of = [&](Index node) { return owner[static_cast<std::size_t>(node)]; };
  int twice = 0, first = 0;
  for (std::size_t e = 0; e < static_cast<std::size_t>(model().elements); ++e) {
    twice += of(model().end_a[e]) != of(model().end_b[e]);
    first += of(model().end_a[e]) == 0;
  }
  EXPECT_LE(twice, 20) << "a line of the net and some threads";
  EXPECT_NEAR(first, model().elements / 2, model().elements / 20);
  int pairs = 0, shared = 0;
  for (std::size_t r = 0; r + 1 < contacts().ring_begin.size(); ++r)
    for (Index i = contacts().ring_begin[r]; i < contacts().ring_begin[r + 1]; ++i, ++pairs) {
      const kernel::Pair& pair = contacts().pairs[static_cast<std::size_t>(i)];
      const kernel::RingGeometry& ring = model().rings[r];
      shared += std::set{of(pair.a), of(pair.b), of(ring.a), of(ring.b)}.size() > 1;
    }
  EXPECT_GT(pairs, 30);
  EXPECT_LE(shared, pairs / 8) << "evaluated by both threads";
}

// What a piece needs of the others, by piece.
std::vector<std::size_t> foreign_nodes(const Model& model, const ContactList& contacts,
                                       const std::vector<std::vector<Index>>& shares) {
  std::vector<std::size_t> owner(static_cast<std::size_t>(model.nodes));
  for (std::size_t p = 0; p < shares.size(); ++p)
    for (const Index node : shares[p]) owner[static_cast<std::size_t>(node)] = p;
  std::vector<std::set<Index>> needed(shares.size());
  const auto meet = [&](std::initializer_list<Index> nodes) {
    for (const Index node : nodes)
      for (const Index other : nodes) needed[owner[static_cast<std::size_t>(node)]].insert(other);
  };
  for (std::size_t e = 0; e < static_cast<std::size_t>(model.elements); ++e)
    meet({model.end_a[e], model.end_b[e]});
  for (std::size_t r = 0; r + 1 < contacts.ring_begin.size(); ++r)
    for (Index i = contacts.ring_begin[r]; i < contacts.ring_begin[r + 1]; ++i) {
      const kernel::Pair& pair = contacts.pairs[static_cast<std::size_t>(i)];
      meet({pair.a, pair.b, model.rings[r].a, model.rings[r].b});
    }
  std::vector<std::size_t> foreign;
  for (std::size_t p = 0; p < shares.size(); ++p) foreign.push_back(needed[p].size() - shares[p].size());
  return foreign;
}

// Where a thread along an edge of the net makes more than one share, it is cut across, together with the
// edge.
TEST(PartitionOfALargeCapture, CutsThreadsTogetherWithTheirEdges) {
  std::vector<Override> sets = test::large_capture_with(50);
  sets.push_back({"closing.time_s", "1e-5"});
  Simulation simulation(read_case(CINCH_SOURCE_DIR "/cases/large_capture.toml", sets), 1);
  simulation.advance_to(simulation.preparation().timeline.step_at(0.03));
  const Model& model = simulation.model();
  const ContactList& contacts = simulation.stepper().contacts();
  constexpr int pieces = 8;
  const auto shares = partition(model, simulation.state(), contacts, pieces);
  std::size_t most = 0;
  for (const auto& share : shares) most = std::max(most, share.size());
  EXPECT_LT(most, 3 * static_cast<std::size_t>(model.nodes) / pieces / 2);
  const auto foreign = foreign_nodes(model, contacts, shares);
  EXPECT_LT(*std::max_element(foreign.begin(), foreign.end()), 800u) << "1078 with straight cuts";
}

}  // namespace
