// The bits of each case as they are known: every compiler and instruction set that runs this test comes to
// them (tests/run with GCC, tests/sanitizers with clang). Where a change is meant to move them,
// CINCH_WRITE_BITS=1 prints what the table shall hold.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "plan/simulation.hpp"
#include "store/fields.hpp"
#include "support/quick_cases.hpp"

namespace {

using namespace cinch;
using namespace cinch::test;

struct Known {
  const char* name;
  Case scene;
  unsigned long long state_hash;
};

TEST(KnownBits, AreReached) {
  for (const Known& one : {Known{"ring_pull", ring_pull(), 0xf9d57eba60016ef1},
                           {"edge_closure", edge_closure(), 0x27447c9cf6e2007e},
                           {"capture", capture(), 0xb5dd1dcfe60932a0},
                           {"small_large_capture", small_large_capture(), 0x6ae6ee6f0dd737b2},
                           {"held_capture", held_capture(), 0xf0a608b111c9d7eb},
                           {"capture_in_two_steps", capture_in_two_steps(), 0x2f23d2afece4d119}}) {
    Simulation simulation(read(one.scene), 1);
    simulation.advance_to(one.scene.steps);
    const unsigned long long found = state_hash(simulation.state());
    if (std::getenv("CINCH_WRITE_BITS") != nullptr)
      std::printf("{\"%s\", %s(), 0x%016llx}\n", one.name, one.name, found);
    else EXPECT_EQ(found, one.state_hash) << one.name;
  }
}

}  // namespace
