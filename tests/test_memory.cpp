// How much memory a simulation takes, by the sums that `cinch check` prints and by what the system says.
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>

#include "base/error.hpp"
#include "support/scenes.hpp"
#include "support/shadowed.hpp"

#ifdef CINCH_SHADOWED
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();  // GCC brings no header for it
#endif

namespace {

using namespace cinch;
using namespace cinch::test;

constexpr const char* net = R"(schema = 1
[time]
end_s = 1
step_s = 1e-6
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[net.main]
material = "m"
diameter_m = 0.002
size_m = [40, 40]
mesh_m = 0.1
velocity_m_s = [0, 0, 1]
)";

constexpr const char* ball = R"([target.ball]
center_m = [0, 0, 1.0011]
radius_m = 1
youngs_modulus_Pa = 2e9
)";

// Bytes on the heap: resident ones without what the allocator keeps for later; by a sanitizer's own account
// where its shadow lies between.
double taken() {
#ifdef CINCH_SHADOWED
  return static_cast<double>(__sanitizer_get_current_allocated_bytes());
#else
  malloc_trim(0);
  std::ifstream pages("/proc/self/statm");
  double size = 0, present = 0;
  pages >> size >> present;
  return present * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
}

struct Growth {
  double measured, summed;  // bytes
  double items;             // nodes and elements
};

Growth growth_of(const Scene& scene, int threads) {
  const double before = taken();
  Simulation simulation(scene, threads);
  simulation.advance_to(8);
  simulation.look();
  const double measured = taken() - before;
  return {measured, static_cast<double>(simulation.memory().total()),
          static_cast<double>(simulation.model().nodes + simulation.model().elements)};
}

TEST(Memory, SumsAreWhatTheSystemSees) {
  for (const bool with_ball : {false, true})
    for (const int threads : {1, 2}) {
      SCOPED_TRACE(std::to_string(threads) + (with_ball ? " threads, ball" : " threads"));
      const Growth growth = growth_of(scene_of(std::string(net) + (with_ball ? ball : "")), threads);
      EXPECT_NEAR(growth.summed, growth.measured, 0.2 * growth.measured);
      EXPECT_LE(growth.summed, 250 * growth.items);
    }
}

TEST(Memory, TooManyElementsAreRefusedBeforeTheyAreMade) {
  Scene scene = scene_of(net);
  scene.nets[0].elements_per_side = 1000;
  try {
    assemble(scene);
    FAIL() << "320 million elements";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("320800000 elements, allowed: at most"), std::string::npos)
        << error.what();
  }
}

}  // namespace
