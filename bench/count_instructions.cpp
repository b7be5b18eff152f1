// Steps the solver or the stripped program on a scene that lacks a feature, for callgrind to count:
// bench/count.
//   cinch_count FEATURE solver|stripped STEPS      prints the state's hash
//   cinch_count --features
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "absent.hpp"
#include "store/fields.hpp"

namespace cinch::bench {

// Callgrind counts what happens between entering and leaving this function.
extern "C" [[gnu::noinline]] void cinch_counted(Simulation* solver, StrippedNet* net, std::int64_t steps) {
  if (solver != nullptr) solver->advance_to(solver->step() + steps);
  else net->advance(steps);
}

namespace {

void count(const Features& has, bool solver, std::int64_t steps) {
  if (solver) {
    const Scene scene = net_scene(absent_knots, has);
    Simulation simulation(scene, step_by_step(prepare(scene)), 1);
    cinch_counted(&simulation, nullptr, steps);
    std::printf("%016llx\n", static_cast<unsigned long long>(state_hash(simulation.state())));
  } else {
    StrippedNet net(has);
    cinch_counted(nullptr, &net, steps);
    State state = net.state();
    state.step += steps;
    std::printf("%016llx\n", static_cast<unsigned long long>(state_hash(state)));
  }
}

int main_of(int count_of, char** words) {
  if (count_of == 2 && std::strcmp(words[1], "--features") == 0) {
    for (const AbsentFeature& feature : absent_features()) std::printf("%s\n", feature.name.c_str());
    return 0;
  }
  for (const AbsentFeature& feature : absent_features())
    if (count_of == 4 && feature.name == words[1])
      return count(feature.has, std::strcmp(words[2], "solver") == 0, std::atoll(words[3])), 0;
  std::fprintf(stderr, "usage: cinch_count FEATURE solver|stripped STEPS, or --features\n");
  return 2;
}

}  // namespace
}  // namespace cinch::bench

int main(int count, char** words) { return cinch::bench::main_of(count, words); }
