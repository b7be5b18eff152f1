// The cases that the documents show do what they say: they run.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "input/case_reader.hpp"
#include "plan/simulation.hpp"

namespace {

using namespace cinch;

// The text of the first block of TOML in a document.
std::string first_case_in(const std::string& document) {
  std::ifstream file(std::string(CINCH_SOURCE_DIR) + "/" + document);
  const std::string text(std::istreambuf_iterator<char>(file), {}), fence = "```toml\n";
  const std::size_t begin = text.find(fence) + fence.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

// Steps the case to its end, as `cinch run` would: energy is looked at on the way.
Summary run(const std::string& document) {
  const Scene scene = parse_case(first_case_in(document), document);
  Simulation simulation(scene, 1);
  const std::int64_t steps = simulation.preparation().timeline.step_at(scene.time.end);
  constexpr int looks = 50;
  for (int k = 0; k <= looks; ++k) {
    simulation.advance_to(steps * k / looks);
    simulation.check_energy(simulation.look());
  }
  return simulation.summary();
}

TEST(Readme, ItsCaseRuns) {
  const Summary summary = run("README.md");
  EXPECT_LT(summary.relative_residual, 1e-3);
  EXPECT_EQ(summary.rings, 1);
}

TEST(Readme, TheCaseInTheListOfKeysRuns) { EXPECT_LT(run("cases/README.md").relative_residual, 1e-3); }

}  // namespace
