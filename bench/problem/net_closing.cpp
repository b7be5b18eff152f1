#include <algorithm>

#include "common.hpp"
#include "scene/mouth.hpp"

namespace cinch::study {

Problem net_closing(Extent extent) {
  Problem p;
  p.name = "net_closing";
  p.title = "A deployed net closes (Sec. 5.3 without deployment and target)";
  p.measure =
      "greatest difference of the mouth's area, of the open one, or of a split mass's place, of the net's "
      "side";
  p.end = 0.4;
  p.samples = 40;
  p.scene = [](const Setting& setting) {
    return scene_of("capture", setting, [](Scene& scene) {
      scene.targets.clear();
      scene.closing.time = 0.001;
      for (Net& net : scene.nets) net.stowed_factor = 1;
      for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 1;
    });
  };
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    const Vec3 mass = now.position(now.assembly().node_of("mechanism.m1.a"));
    return std::vector<double>{mouth_area(now.ring_centers()), mass.x(), mass.y(), mass.z()};
  };
  p.errors = [](const Track& found, const Track& reference) {  // the net is 1 m wide, its mouth 1 m^2
    const double area = greatest(found, reference, 0, 1), mass = greatest(found, reference, 1, 4);
    return Errors{{"error", std::max(area, mass)}, {"mouth_area", area}, {"split_mass_path", mass}};
  };
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
