// From the first touch on a capture is chaotic: what differs by rounding at first differs by centimetres in
// the end. The means over some runs are not, and these are compared.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common.hpp"
#include "scene/mouth.hpp"

namespace cinch::study {
namespace {

// Of an event; not a number as long as it has not come, and so are means over runs of which one lacks it.
double time_of(Simulation& sim, const std::string& kind) {
  for (const Event& event : sim.summary().events)
    if (event.kind == kind) return event.time;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Problem capture(Extent extent) {
  Problem p;
  p.name = "capture";
  p.title = "A net catches a ball (Sec. 5.3)";
  p.measure =
      "greatest difference of the mouth's area, of the open one, or of a split mass's place, of the net's "
      "side";
  p.end = 2;
  p.samples = 400;
  p.runs = 8;
  p.perturb = [](Scene& scene, int run) {
    for (Mechanism& mechanism : scene.mechanisms) mechanism.launch_velocity *= 1 + 1e-5 * run;
  };
  p.scene = [](const Setting& setting) { return scene_of("capture", setting); };
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    sim.note_events(now);
    std::vector<double> found{mouth_area(now.ring_centers())};
    append(found, now.position(now.assembly().node_of("mechanism.m1.a")));
    found.insert(found.end(), {time_of(sim, "target_contact"), time_of(sim, "mouth_closed")});
    return found;
  };
  p.errors = [](const Track& found, const Track& reference) {  // the net is 1 m wide, its mouth 1 m^2
    const auto &end = found.samples.back(), &right = reference.samples.back();
    const double area = greatest(found, reference, 0, 1), mass = greatest(found, reference, 1, 4);
    return Errors{{"error", std::max(area, mass)},
                  {"mouth_area", area},
                  {"split_mass_path", mass},
                  {"contact_time", std::abs(end[4] / right[4] - 1)},
                  {"closing_time", std::abs(end[5] / right[5] - 1)}};
  };
  if (extent == Extent::trial) {  // the first of its flight
    p.end = 0.2, p.samples = 20, p.runs = 3;
    p.reference.push_back({"sliding", 8, 0, 0.8, false, 0});
    add_series(p.settings, "sliding", {6}, 0.8, 0);
    return p;
  }
  for (const int n : {36, 44, 52}) p.reference.push_back({"sliding", n, 0, 0.4, false, 0});
  const std::vector<int> few = {6, 8, 12, 18, 26};
  for (const double fraction : {0.8, 0.4}) add_series(p.settings, "sliding", few, fraction, 0);
  // steps beyond 0.9 are too long for contacts with the ball
  add_series(p.settings, "sliding", {10, 12}, 0.9, 0);
  add_series(p.settings, "sliding", {10}, 0.9, 6);  // as long as they may be
  add_papers_step(p.settings, papers_rules, {240}, {240});
  if (extent == Extent::full) {
    add_papers_step(p.settings, "contact", {240}, {});
    add_series(p.settings, "contact", {240, 480}, 0.8);
  }
  return p;
}

}  // namespace cinch::study
