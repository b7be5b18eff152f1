#include "study_problem.hpp"

#include <algorithm>
#include <cstdio>

#include "input/case_reader.hpp"
#include "scene/mouth.hpp"

namespace cinch::study {
namespace {

const std::string papers_rules = "contact, paper's rules";

Scene scene_of(const std::string& name, const Setting& setting) {
  Scene scene = read_case(std::string(CINCH_SOURCE_DIR) + "/cases/" + name + ".toml");
  const bool sliding = setting.method == "sliding";
  for (Ring& ring : scene.rings) ring.joint = sliding ? RingJoint::sliding : RingJoint::contact;
  if (setting.method == papers_rules) {
    scene.contact.couple = RingCouple::paper;
    scene.contact.distance = DistanceMethod::golden;
    scene.contact.shared_node = SharedNode::paper;
  }
  for (Thread& thread : scene.threads) thread.elements = setting.elements;
  scene.probes.clear();
  scene.time.joint_steps = setting.joint_steps;
  scene.time.step = setting.step;
  if (!(setting.step > 0)) scene.time.step = setting.fraction * prepare(scene).stable_step;
  return scene;
}

// Steps by fractions of the stable one, and the paper's step.
void add_series(std::vector<Setting>& to, const std::string& method, const std::vector<int>& elements,
                double fraction, int joint_steps = 1) {
  for (const int n : elements) to.push_back({method, n, 0, fraction, false, joint_steps});
}
void add_papers_step(std::vector<Setting>& to, const std::string& method, const std::vector<int>& elements,
                     const std::vector<int>& papers) {
  for (const int n : elements)
    to.push_back({method, n, 1e-6, 0, std::count(papers.begin(), papers.end(), n) > 0});
}

double distance(const std::vector<double>& a, const std::vector<double>& b, std::size_t first,
                std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// Greatest distance of some of the numbers over all samples.
double greatest(const Track& a, const Track& b, std::size_t first, std::size_t last) {
  double most = 0;
  for (std::size_t s = 0; s < a.samples.size(); ++s)
    most = std::max(most, distance(a.samples[s], b.samples[s], first, last));
  return most;
}

}  // namespace

std::string Setting::series() const {
  char words[40];
  if (step > 0) std::snprintf(words, sizeof words, ", step %g s", step);
  else std::snprintf(words, sizeof words, ", %g of the stable step", fraction);
  return method + words + (joint_steps == 0 ? ", forces held" : "");
}

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
    Scene scene = scene_of("capture", setting);
    scene.targets.clear();
    scene.closing.time = 0.001;
    for (Net& net : scene.nets) net.stowed_factor = 1;
    for (Mechanism& mechanism : scene.mechanisms) mechanism.initial_stretch = 1;
    return scene;
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
  for (const int n : {52, 72, 104}) p.reference.push_back({"sliding", n, 0, 0.25, false});
  const std::vector<int> few = {6, 8, 12, 18, 26, 36};
  for (const double fraction : {0.8, 0.4}) add_series(p.settings, "sliding", few, fraction);
  for (const double fraction : {0.95, 0.8, 0.4}) add_series(p.settings, "sliding", few, fraction, 0);
  add_series(p.settings, "contact", {120, 240}, 0.8);
  add_papers_step(p.settings, "contact", {120, 240, 480}, {240});
  if (extent == Extent::full) add_series(p.settings, "contact", {480, 960}, 0.8);
  return p;
}

}  // namespace cinch::study
