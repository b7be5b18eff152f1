#include "closing_masses.hpp"

namespace cinch::study {

static constexpr double closing_time = 0.001;  // s

Problem net_closing(Extent extent) {
  Problem p;
  p.name = "net_closing";
  p.title = "A deployed net closes (Sec. 5.3 without deployment and target)";
  p.measure = measure_of_closing;
  p.end = 0.4;
  p.samples = 40;
  p.scene = [](const Setting& setting) {
    return scene_of("capture", setting, [](Scene& scene) {
      scene.targets.clear();
      scene.closing.time = closing_time;
      for (Net& net : scene.nets) net.stowed_factor = 1;
      for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 1;
    });
  };
  p.sample = [](Simulation& sim) { return sample_of_closing(sim, sim.look()); };
  p.errors = [](const Track& found, const Track& reference) {
    return errors_of_closing(found, reference, closing_time);
  };
  p.chaotic_measures = {"split_mass_velocity_greatest", "ring_force"};
  if (extent == Extent::trial) {  // its begin
    p.end = 0.02, p.samples = 2;
    p.reference.push_back({"sliding", 8, 0, 0.8, false, 0});
    add_series(p.settings, "sliding", {6}, 0.8, 0);
    return p;
  }
  for (const int n : {52, 62, 72, 86, 104}) p.reference.push_back({"sliding", n, 0, 0.25, false});
  const std::vector<int> few = {6, 8, 12, 18, 26, 36};
  for (const double fraction : {0.8, 0.4}) add_series(p.settings, "sliding", few, fraction);
  for (const double fraction : {0.95, 0.8, 0.4}) add_series(p.settings, "sliding", few, fraction, 0);
  add_series(p.settings, "contact", {120, 240}, 0.8);
  add_papers_step(p.settings, "contact", {120, 240, 480}, {240});
  if (extent == Extent::full) add_series(p.settings, "contact", {480, 960}, 0.8);
  return p;
}

}  // namespace cinch::study
