#include "common.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "input/case_reader.hpp"

namespace cinch::study {

static void take_rules(Contact& contact, const std::string& method) {
  const bool all = method == papers_rules;
  if (all || method == papers_couple) contact.couple = RingCouple::paper;
  if (all || method == papers_distance) contact.distance = DistanceMethod::golden;
  if (all || method == papers_nodes) contact.shared_node = SharedNode::paper;
}

Scene scene_of(const std::string& name, const Setting& setting, const std::function<void(Scene&)>& change) {
  Scene scene = read_case(std::string(CINCH_SOURCE_DIR) + "/cases/" + name + ".toml");
  if (change) change(scene);
  const bool sliding = setting.method == "sliding";
  for (Ring& ring : scene.rings) ring.joint = sliding ? RingJoint::sliding : RingJoint::contact;
  take_rules(scene.contact, setting.method);
  for (Thread& thread : scene.threads) thread.elements = setting.elements;
  scene.probes.clear();
  scene.time.joint_steps = setting.joint_steps;
  scene.time.step = setting.step;
  if (setting.step > 0) return scene;
  const std::vector<Phase> phases = prepare(scene).phases;
  const double later = setting.closing_fraction > 0 ? setting.closing_fraction : setting.fraction;
  scene.time.step = setting.fraction * phases.front().bound.step;
  scene.closing.step = later * phases.back().bound.step;
  return scene;
}

void add_series(std::vector<Setting>& to, const std::string& method, const std::vector<int>& elements,
                double fraction, int joint_steps) {
  for (const int n : elements) to.push_back({method, n, 0, fraction, false, joint_steps});
}
void add_papers_step(std::vector<Setting>& to, const std::string& method, const std::vector<int>& elements,
                     const std::vector<int>& papers) {
  for (const int n : elements)
    to.push_back({method, n, 1e-6, 0, std::count(papers.begin(), papers.end(), n) > 0});
}

void set_closing_fraction(std::vector<Setting>& settings, double fraction) {
  for (Setting& setting : settings) setting.closing_fraction = fraction;
}

void set_runs(std::vector<Setting>& settings, int runs) {
  for (Setting& setting : settings) setting.runs = runs;
}

double distance(const std::vector<double>& a, const std::vector<double>& b, std::size_t first,
                std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

double greatest(const Track& a, const Track& b, std::size_t first, std::size_t last) {
  double most = 0;
  for (std::size_t s = 0; s < a.samples.size(); ++s)
    most = std::max(most, distance(a.samples[s], b.samples[s], first, last));
  return most;
}

void append(std::vector<double>& to, const Vec3& place) {
  to.insert(to.end(), {place.x(), place.y(), place.z()});
}

double peak_ring_force(const Simulation& sim) {
  double most = 0;
  for (const kernel::RingTally& ring : sim.state().rings) most = std::max(most, ring.peak_force);
  return most;
}

double last_apart(const Track& found, const Track& reference, std::size_t back) {
  const auto &end = found.samples.back(), &right = reference.samples.back();
  const std::size_t place = end.size() - 1 - back;
  return std::abs(end[place] / right[place] - 1);
}

static std::string words_of_hold(const Setting& setting) {
  if (setting.joint_steps == 1) return "";
  return ", forces held" +
         (setting.joint_steps > 1 ? " for " + std::to_string(setting.joint_steps) + " steps" : "");
}

std::string Setting::series() const {
  char words[80];
  if (step > 0) std::snprintf(words, sizeof words, ", step %g s", step);
  else if (closing_fraction > 0)
    std::snprintf(words, sizeof words, ", %g, then %g of the stable step", fraction, closing_fraction);
  else std::snprintf(words, sizeof words, ", %g of the stable step", fraction);
  return method + words + words_of_hold(*this);
}

std::string Setting::but_for_the_step() const {
  return method + ", " + std::to_string(elements) + " elements" + words_of_hold(*this);
}

std::vector<Problem> problems(Extent extent) {
  return {weight_on_a_thread(extent),
          atwood(extent),
          ring_pull(extent),
          damped_ring_pull(extent, 0.02),
          damped_ring_pull(extent, 0.5),
          edge_closure(extent),
          net_closing(extent),
          capture(extent)};
}

}  // namespace cinch::study
