#include <algorithm>
#include <cstdio>

#include "common.hpp"

namespace cinch::study {
namespace {

// All but the settings.
Problem pull(const std::function<void(Scene&)>& change) {
  Problem p;
  p.measure =
      "greatest distance of ball and ring from the reference over the whole second, of the thread's length";
  p.end = 1;
  p.samples = 50;
  p.scene = [change](const Setting& setting) { return scene_of("ring_pull", setting, change); };
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    std::vector<double> found;
    append(found, now.position(0));  // the ball
    append(found, now.ring_center(0));
    found.push_back(peak_ring_force(sim));
    return found;
  };
  p.errors = [](const Track& found, const Track& reference) {  // the thread is 1 m long
    const double ball = greatest(found, reference, 0, 3), ring = greatest(found, reference, 3, 6);
    const auto &end = found.samples.back(), &right = reference.samples.back();
    return Errors{{"error", std::max(ball, ring)},
                  {"ball_path", ball},
                  {"ring_path", ring},
                  {"ball_end", distance(end, right, 0, 3)},
                  {"ring_end", distance(end, right, 3, 6)},
                  {"ring_force", last_apart(found, reference)}};
  };
  p.chaotic_measures = {"ring_force"};  // jumps as nodes pass
  return p;
}

void add_trial(Problem& p) {
  for (const int n : {18, 20}) p.reference.push_back({"sliding", n, 0, 0.5, false});
  add_series(p.settings, "sliding", {6, 9}, 0.8);
}

}  // namespace

Problem ring_pull(Extent extent) {
  Problem p = pull({});
  p.name = "ring_pull";
  p.title = "A thread pulls a ring (Sec. 5.1)";
  if (extent == Extent::trial) {
    add_trial(p);
    add_series(p.settings, "contact", {25, 50, 100}, 0.8);  // 25 are too few: that run stops
    return p;
  }
  for (const int n : {100, 150, 200}) p.reference.push_back({"sliding", n, 0, 0.25, false});
  const std::vector<int> few = {6, 9, 12, 13, 18, 26, 36, 50};
  for (const double fraction : {0.8, 0.4, 0.2}) add_series(p.settings, "sliding", few, fraction);
  add_series(p.settings, "contact", {50, 100, 200, 400}, 0.8);
  add_papers_step(p.settings, "contact", {50, 100, 200, 300}, {});
  for (const char* rule : {papers_distance, papers_couple, papers_nodes})
    add_papers_step(p.settings, rule, {100, 200}, {});
  add_papers_step(p.settings, papers_rules, {50, 100, 200, 300}, {100, 200, 300});
  if (extent == Extent::full) add_series(p.settings, "contact", {800, 1600}, 0.8);
  return p;
}

// Another damping is another problem, with a reference of its own.
Problem damped_ring_pull(Extent extent, double damping_ratio) {
  Problem p = pull([damping_ratio](Scene& scene) {
    for (auto& [name, material] : scene.materials) material.damping_ratio = damping_ratio;
  });
  char digits[40];
  std::snprintf(digits, sizeof digits, "%g", damping_ratio);
  p.name = std::string("ring_pull_damped_") + digits;
  p.title = std::string("A thread pulls a ring (Sec. 5.1), damping ratio ") + digits + " in place of 0.106";
  if (extent == Extent::trial) {
    add_trial(p);
    return p;
  }
  for (const int n : {100, 150, 200}) p.reference.push_back({"sliding", n, 0, 0.25, false});
  for (const double fraction : {0.8, 0.4})
    add_series(p.settings, "sliding", {6, 9, 12, 18, 26, 36}, fraction);
  add_series(p.settings, "contact", {50, 100, 200}, 0.8);
  return p;
}

}  // namespace cinch::study
