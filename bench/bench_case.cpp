// Run time of each case: phases as steps of the solver from a state that the case really comes to, and whole
// cases as runs of the program, start-up and output included. minutes_per_simulated_second is the figure that
// the paper's run times translate into.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "counters.hpp"
#include "film.hpp"
#include "output/summary_json.hpp"
#include "scenes.hpp"
#include "store/fields.hpp"
#include "temporary_folder.hpp"

namespace cinch::bench {
namespace {

// Always the same stretch of a case, whatever the mode, so that runs can be compared.
struct Stretch {
  double from;                  ///< s
  std::int64_t batch, batches;  ///< steps between two readings of the clock
};

void measure(benchmark::State& state, Simulation& simulation, std::int64_t batch) {
  simulation.advance_to(simulation.step() + batch);  // threads make their pieces and lists
  count_handover(state);
  const StageSeconds before = simulation.stepper().seconds();
  const std::int64_t flown = simulation.stepper().flown();
  const double begin = clock_seconds();
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  const double wall = clock_seconds() - begin;
  StageSeconds seconds = simulation.stepper().seconds();
  for (std::size_t s = 0; s < stage_count; ++s) seconds[s] -= before[s];
  const Model& model = simulation.model();
  const double steps = static_cast<double>(state.iterations() * batch);
  count_steps(state, model, steps, static_cast<double>(simulation.stepper().flown() - flown));
  count_simulated(state, steps * simulation.stepper().plan().dt);
  count_scene(state, model.nodes, model.elements, simulation.threads());
  count_shares(state, seconds, wall);
  tell_bits(state, state_hash(simulation.state()));
}

// The flight unfolds the stowed net, from the first jerks on to the ball; the closing phase has its threads
// in many rings and the net on the ball.
constexpr Stretch deployment{0.6, 50'000, 16}, closing{1.70, 500, 200};

void capture(benchmark::State& state, Stretch stretch, int threads) {
  static const Scene scene = read_case(case_file("capture"));
  static const Film film(scene, {deployment.from, closing.from});
  Simulation simulation(scene, threads);
  film.wind(simulation, stretch.from);
  measure(state, simulation, stretch.batch);
}

// The same states: what is dissipated changes nothing of the motion.
void capture_without_ledger(benchmark::State& state, Stretch stretch, int threads) {
  static const Scene scene = read_case(case_file("capture"), {{"output.ledger", "false"}});
  static const Film film(scene, {closing.from});
  Simulation simulation(scene, threads);
  film.wind(simulation, stretch.from);
  measure(state, simulation, stretch.batch);
}

// The thread has slid through the ring by half of its way; the edge is half closed.
constexpr Stretch ring_sliding{0.5, 2000, 50}, edge_closing{0.25, 1000, 50};

void short_case(benchmark::State& state, const std::string& name, Stretch stretch, int threads) {
  const Scene scene = read_case(case_file(name));
  Simulation simulation(scene, threads);
  simulation.advance_to(simulation.preparation().timeline.step_at(stretch.from));
  measure(state, simulation, stretch.batch);
}

// Closing threads take up slack in the first of 800 rings.
constexpr Stretch large_closing{0.08, 400, 5};

void large_closing_phase(benchmark::State& state, Stretch stretch, int threads) {
  static const Scene scene = read_case(case_file("large_capture"));
  static const Film film(scene, {stretch.from});
  Simulation simulation(scene, threads);
  film.wind(simulation, stretch.from);
  measure(state, simulation, stretch.batch);
}

// The same net before its threads close, taut by 0.1 % and soft, so that it stays so: in the case itself it
// lies at its rest length, where rounding decides which elements pull.
void large_taut_net(benchmark::State& state, Stretch stretch, int threads) {
  static const Scene scene = read_case(case_file("large_capture"), {{"material.net.youngs_modulus_Pa", "1"},
                                                                    {"net.main.stowed_factor", "1.001"},
                                                                    {"time.step_s", "1e-6"}});
  Simulation simulation(scene, threads);
  measure(state, simulation, stretch.batch);
}

// Elements join when a case closes.
double element_updates(const Preparation& p, std::int64_t steps) {
  const std::int64_t first = p.phases.size() == 1 ? steps : std::min(p.closing_step, steps);
  return static_cast<double>(first) * p.phases.front().model.elements +
         static_cast<double>(steps - first) * p.phases.back().model.elements;
}

using Changes = std::vector<Override>;

// The settings of README for a capture within 1 %, up to its verdict.
const Changes fast_capture{{"case.method", "sliding"},         {"time.step_s", "auto"},
                           {"thread.*.elements", "12"},        {"closing.safety", "0.8"},
                           {"time.joint_steps", "7"},          {"time.end_when", "mouth_closed"},
                           {"output.probe_interval_s", "0.01"}};

void whole(benchmark::State& state, const std::string& name, const Changes& changes, int threads) {
  const TemporaryFolder folder;
  std::string command = "'" CINCH_PROGRAM "' run '" + case_file(name) + "' --quiet --overwrite --threads " +
                        std::to_string(threads) + " --out '" + folder.path().string() + "'";
  for (const Override& change : changes) command += " --set '" + change.key + "=" + change.value + "'";
  command += " > /dev/null";
  count_handover(state);
  const double begin = clock_seconds();
  for (auto _ : state)
    if (std::system(command.c_str()) != 0) return state.SkipWithError("the program failed");
  const double wall = (clock_seconds() - begin) / static_cast<double>(state.iterations());
  const Summary summary = read_summary(folder.path() / "summary.json");
  const auto runs = static_cast<double>(state.iterations());
  count_updates(state, runs * element_updates(prepare(read_case(case_file(name), changes)), summary.steps));
  count_simulated(state, runs * summary.simulated_seconds);
  count_scene(state, summary.nodes, summary.elements, summary.threads);
  StageSeconds seconds{};
  for (std::size_t s = 0; s < stage_count; ++s) seconds[s] = summary.stages.at(s).seconds;
  count_shares(state, seconds, wall);
  tell_bits(state, summary.state_hash);
}

// The same in one process, without output: as a study of many captures steps them.
void until_closed(benchmark::State& state, int threads) {
  const Scene scene = read_case(case_file("capture"), fast_capture);
  std::int64_t steps = 0;
  std::optional<Simulation> simulation;
  for (auto _ : state) {
    simulation.emplace(scene, threads);
    const Timeline& timeline = simulation->preparation().timeline;
    for (int k = 1; simulation->step() < simulation->end_step(); ++k) {
      simulation->advance_to(timeline.step_at(scene.output.probe_interval * k));
      simulation->note_events(simulation->look());
    }
    steps += simulation->step();
  }
  const Model& model = simulation->model();
  count_updates(state, element_updates(simulation->preparation(), steps / state.iterations()) *
                           static_cast<double>(state.iterations()));
  count_simulated(state, static_cast<double>(state.iterations()) * simulation->time());
  count_scene(state, model.nodes, model.elements, simulation->threads());
  tell_bits(state, state_hash(simulation->state()));
}

template <class Run, class... Arguments>
void add(const std::string& name, std::int64_t iterations, int threads, Run run, Arguments... arguments) {
  benchmark::RegisterBenchmark(("case/" + name + "/threads:" + std::to_string(threads)).c_str(), run,
                               arguments..., threads)
      ->Iterations(iterations)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool registered = [] {
  for (const int threads : thread_counts()) {
    add("capture/deployment", deployment.batches, threads, capture, deployment);
    add("capture/closing", closing.batches, threads, capture, closing);
    if (threads == 1) {
      add("capture/closing_without_ledger", closing.batches, threads, capture_without_ledger, closing);
      add("ring_pull/sliding", ring_sliding.batches, threads, short_case, std::string("ring_pull"),
          ring_sliding);
      add("edge_closure/closing", edge_closing.batches, threads, short_case, std::string("edge_closure"),
          edge_closing);
      add("capture/sliding_until_closed", 10, threads, until_closed);
      add("capture/sliding_until_closed/whole", 5, threads, whole, std::string("capture"), fast_capture);
    }
    add("large_capture/taut_net", large_closing.batches, threads, large_taut_net, large_closing);
    add("large_capture/closing/long", large_closing.batches, threads, large_closing_phase, large_closing);
    // where threads do not pay, a whole case of a million steps takes minutes
    const std::string longer = threads > 1 ? "/long" : "";
    for (const char* name : {"ring_pull", "edge_closure", "capture"})
      add(name + ("/whole" + longer), 1, threads, whole, std::string(name), Changes{});
    add("large_capture/whole/long", 1, threads, whole, std::string("large_capture"), Changes{});
  }
  return true;
}();

}  // namespace
}  // namespace cinch::bench
