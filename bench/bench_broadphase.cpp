// The broadphase: a search for all pairs anew, on a net with a ring on every third element of its edges and a
// ball under it. Pairs tested should grow as the scene does.
#include <benchmark/benchmark.h>

#include "counters.hpp"
#include "plan/contact_list.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

// Edges of a net of n x n knots are closed by four threads with elements of a tenth of the mesh.
std::string scene_text(std::int64_t knots) {
  const double side = 0.1 * static_cast<double>(knots - 1);
  std::string text =
      net_text(knots) + "[target.ball]\ncenter_m = [0, 0, -0.15]\nradius_m = 0.145\n" +
      "youngs_modulus_Pa = 2.3e9\npoissons_ratio = 0.39\n[rings.r]\njoint = \"contact\"\nnet = \"main\"\n"
      "diameter_m = 0.02\nwire_diameter_m = 0.004\nmass_kg = 0.006\nyoungs_modulus_Pa = 70e9\ncells = [";
  for (std::int64_t cell = 1; cell < knots; cell += 3) text += std::to_string(cell) + ", ";
  text += "]\n";
  const double half = 0.5 * side * 1.001;
  const auto thread = [&](const std::string& name, double x0, double y0, double x1, double y1) {
    const auto point = [](double x, double y) {
      return "[" + std::to_string(x) + ", " + std::to_string(y) + ", 0.005]";
    };
    text += "[thread." + name +
            "]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = " + std::to_string(10 * (knots - 1)) +
            "\npoints_m = [" + point(x0, y0) + ", " + point(x1, y1) + "]\n";
  };
  thread("top", -half, half, half, half), thread("bottom", -half, -half, half, -half);
  thread("left", -half, -half, -half, half), thread("right", half, -half, half, half);
  return text;
}

void search(benchmark::State& state, std::int64_t knots) {
  Simulation simulation(parse_case(scene_text(knots), "search.toml"), 1);
  const Model& model = simulation.model();
  ContactList list(model, 0);
  list.rebuild(model, simulation.state());
  const std::int64_t before = list.pairs_tested(), rebuilds = list.rebuilds();
  for (auto _ : state) list.rebuild(model, simulation.state());
  const double searches = static_cast<double>(list.rebuilds() - rebuilds);
  state.counters["pairs_tested"] = static_cast<double>(list.pairs_tested() - before) / searches;
  state.counters["pairs_kept"] = static_cast<double>(list.pairs.size());
  count_scene(state, model.nodes, model.elements, 1);
  state.counters["items_per_second"] =
      benchmark::Counter(searches * model.elements, benchmark::Counter::kIsRate);
}

[[maybe_unused]] const bool registered = [] {
  for (const std::int64_t knots : {11, 32, 100, 316}) {
    const std::int64_t elements = 2 * knots * (knots - 1) + 40 * (knots - 1);
    benchmark::RegisterBenchmark(("broadphase/" + std::to_string(elements)).c_str(), search, knots)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace cinch::bench
