// Shares of threads: every node once, and as little as can be computed twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "input/case_reader.hpp"
#include "plan/partition.hpp"
#include "plan/simulation.hpp"

namespace {

using namespace cinch;

// The net of the paper's capture with its threads in their rings, right after they have been laid; its
// closing phase comes early.
class Partition : public testing::Test {
 protected:
  Simulation simulation{
      read_case(CINCH_SOURCE_DIR "/cases/capture.toml", {{"closing.time_s", "0.01"}, {"time.end_s", "0.02"}}),
      1};

  Partition() { simulation.advance_to(std::llround(0.0101 / simulation.preparation().dt)); }

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

}  // namespace
