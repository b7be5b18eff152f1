// The same bits with one, two and four threads, in hard scenes as in tame ones.
#include "base/error.hpp"
#include "groups.hpp"
#include "motion_scenes.hpp"
#include "store/fields.hpp"
#include "watch.hpp"

namespace cinch::matrix {
namespace {

struct End {
  std::uint64_t hash = 0;
  std::int64_t step = 0;
  std::string message;
  bool operator==(const End&) const = default;
};

/// How a run ends; one that stops must stop at the same step with the same words.
End end_of(const SceneMaker& make, std::int64_t steps, int threads) {
  Simulation sim(make(), threads);
  End end;
  try {
    sim.advance_to(steps);
  } catch (const NumericalError& error) {
    end.message = error.what();
  }
  end.hash = state_hash(sim.state());
  end.step = sim.step();
  return end;
}

Outcome compare(const SceneMaker& make, std::int64_t steps) {
  const End serial = end_of(make, steps, 1);
  for (const int threads : {2, 4})
    if (const End other = end_of(make, steps, threads); !(other == serial))
      return {Verdict::failed, 0, steps,
              std::to_string(threads) + " threads end otherwise than one, at step " +
                  std::to_string(other.step) + " and " + std::to_string(serial.step)};
  char hash[30];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(serial.hash));
  return {Verdict::held, 0, serial.step,
          std::string("state_hash ") + hash + (serial.message.empty() ? "" : ", stopped alike")};
}

}  // namespace

std::vector<Cell> threads(Extent extent) {
  const std::int64_t steps = extent == Extent::full ? 5000 : 500;
  const std::pair<const char*, SceneMaker> all[] = {
      {"tense chain at 0.99 of the bound", [] { return at_fraction(tense_chain(400, 0), 0.99); }},
      {"tense net", [] { return tense_net(0.106); }},
      {"junction", [] { return tense_junction(0.106); }},
      {"thread on a ball, 10 m/s", [] { return thread_on_ball(10); }},
      {"thread on a ring, 1 m/s", [] { return thread_in_ring(1); }},
      {"thread on a ring, 500 m/s", [] { return thread_in_ring(500); }},
      {"two rings", two_rings},
      {"folded net with rings", folded_ringed_net},
      {"closing at t = 0", [] { return closing_net(0); }},
      {"growing chain, step 1.01", [] { return at_fraction(tense_chain(40, 0), 1.01); }},
  };
  std::vector<Cell> cells;
  for (const auto& [name, make] : all)
    cells.emplace_back("threads", "1, 2 and 4 threads", name, Must::hold,
                       [make = make, steps] { return compare(make, steps); });
  return cells;
}

}  // namespace cinch::matrix
