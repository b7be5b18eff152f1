// The edge whips as it is drawn together, and is chaotic then: the means over some runs are compared.
#include <algorithm>
#include <cmath>

#include "common.hpp"

namespace cinch::study {

Problem edge_closure(Extent extent) {
  Problem p;
  p.name = "edge_closure";
  p.title = "An edge of a hanging net is drawn together (Sec. 5.2)";
  p.measure =
      "distance of the edge's knots from the reference, root of the mean square over knots and time, or the "
      "greatest of a mass, of the net's side";
  p.end = 0.4;
  p.samples = 40;
  p.perturb = [](Scene& scene, int run) { scene.gravity = (1 + 1e-6 * run) * scene.gravity.value(); };
  p.scene = [](const Setting& setting) { return scene_of("edge_closure", setting); };
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    std::vector<double> places;
    for (const char* end : {"start", "end"})
      append(places, now.position(now.assembly().node_of(std::string("thread.closing.") + end)));
    for (int k = 0; k <= 10; ++k)
      append(places, now.position(now.assembly().node_of("net.main.knot." + std::to_string(k) + ".0")));
    places.push_back(peak_ring_force(sim));
    return places;
  };
  p.errors = [](const Track& found, const Track& reference) {  // the net is 1 m wide
    double sum = 0, most = 0;
    for (std::size_t k = 2; k < 13; ++k) {
      for (std::size_t t = 0; t < found.samples.size(); ++t)
        sum += std::pow(distance(found.samples[t], reference.samples[t], 3 * k, 3 * k + 3), 2);
      most = std::max(most, greatest(found, reference, 3 * k, 3 * k + 3));
    }
    const double edge = std::sqrt(sum / 11 / static_cast<double>(found.samples.size()));
    const double masses = std::max(greatest(found, reference, 0, 3), greatest(found, reference, 3, 6));
    return Errors{{"error", std::max(edge, masses)},
                  {"edge_shape", edge},
                  {"one_knot", most},
                  {"mass_path", masses},
                  {"ring_force", last_apart(found, reference)}};
  };
  p.chaotic_measures = {"one_knot", "ring_force"};
  if (extent == Extent::trial) {  // its begin
    p.end = 0.02, p.samples = 2;
    p.reference.push_back({"sliding", 8, 0, 0.8, false, 0, 2});
    p.settings.push_back({"sliding", 6, 0, 0.8, false, 0, 2});
    return p;
  }
  constexpr int runs = 8;
  for (const int n : {72, 86, 100, 120, 144}) p.reference.push_back({"sliding", n, 0, 0.25, false, 1, runs});
  const std::vector<int> few = {6, 8, 12, 18, 26, 36};
  for (const double fraction : {0.8, 0.4}) add_series(p.settings, "sliding", few, fraction, 0);
  add_papers_step(p.settings, papers_rules, {240}, {240});
  if (extent == Extent::full) {
    add_papers_step(p.settings, "contact", {120, 240}, {});
    add_series(p.settings, "contact", {120, 240, 480}, 0.8);
  }
  set_runs(p.settings, runs);
  return p;
}

}  // namespace cinch::study
