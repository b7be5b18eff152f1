#include <algorithm>

#include "common.hpp"

namespace cinch::study {

Problem ring_pull(Extent extent) {
  Problem p;
  p.name = "ring_pull";
  p.title = "A thread pulls a ring (Sec. 5.1)";
  p.measure =
      "greatest distance of ball and ring from the reference over the whole second, of the thread's length";
  p.end = 1;
  p.samples = 50;
  p.scene = [](const Setting& setting) { return scene_of("ring_pull", setting); };
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    const Vec3 ball = now.position(0), ring = now.ring_center(0);
    return std::vector<double>{ball.x(), ball.y(), ball.z(), ring.x(), ring.y(), ring.z()};
  };
  p.errors = [](const Track& found, const Track& reference) {  // the thread is 1 m long
    const double ball = greatest(found, reference, 0, 3), ring = greatest(found, reference, 3, 6);
    const auto &end = found.samples.back(), &right = reference.samples.back();
    return Errors{{"error", std::max(ball, ring)},
                  {"ball_path", ball},
                  {"ring_path", ring},
                  {"ball_end", distance(end, right, 0, 3)},
                  {"ring_end", distance(end, right, 3, 6)}};
  };
  if (extent == Extent::trial) {
    for (const int n : {18, 20}) p.reference.push_back({"sliding", n, 0, 0.5, false});
    add_series(p.settings, "sliding", {6, 9}, 0.8);
    add_series(p.settings, "contact", {25, 50, 100}, 0.8);  // 25 are too few: that run stops
    return p;
  }
  for (const int n : {100, 150, 200}) p.reference.push_back({"sliding", n, 0, 0.25, false});
  const std::vector<int> few = {6, 9, 13, 18, 26, 36, 50};
  for (const double fraction : {0.8, 0.4, 0.2}) add_series(p.settings, "sliding", few, fraction);
  add_series(p.settings, "contact", {50, 100, 200, 400}, 0.8);
  add_papers_step(p.settings, "contact", {50, 100, 200, 300}, {});
  add_papers_step(p.settings, papers_rules, {50, 100, 200, 300}, {100, 200, 300});
  if (extent == Extent::full) add_series(p.settings, "contact", {800, 1600}, 0.8);
  return p;
}

}  // namespace cinch::study
