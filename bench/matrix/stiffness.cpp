// Stiff things with the automatic step: whatever a case may say, the step must suit it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "groups.hpp"
#include "scenes.hpp"
#include "watch.hpp"

namespace cinch::matrix {
namespace {

/// A thread of ten elements, stretched by 0.1 %, with a mass at its end that is pushed aside.
struct Stiff {
  double modulus = 1e9;    ///< Pa
  double element = 0.01;   ///< m
  double mass_ratio = 10;  ///< mass over an element's
  double damping = 0.106;
  DampingRule rule = DampingRule::element;
};

Scene stiff_thread(const Stiff& s) {
  Scene scene = plain_scene();
  Material& m = scene.materials["m"];
  m.youngs_modulus = s.modulus;
  m.damping_ratio = s.damping;
  m.damping_rule = s.rule;
  const double strain = 1e-3, length = 10 * s.element, waves = std::sqrt(s.modulus / m.density);
  m.damping_frequency = std::numbers::pi / 2 * waves / length;  // of the thread's own lowest mode
  Thread& thread = add_thread(scene, "main", {Vec3::Zero(), Vec3(length * (1 + strain), 0, 0)}, 10);
  const double element_mass =
      m.density * std::numbers::pi / 4 * thread.diameter * thread.diameter * s.element;
  thread.length = length;
  thread.start.support = Support::fixed;
  thread.end.mass = s.mass_ratio * element_mass;
  thread.end.velocity = strain * waves / std::sqrt(std::max(s.mass_ratio, 1.0)) * Vec3(-0.5, 1, 0.2);
  return scene;
}

std::string word(DampingRule rule) { return rule == DampingRule::element ? "element" : "stiffness"; }

Cell stiff_cell(const std::string& parameter, const std::string& value, const Stiff& s, Extent extent) {
  // what little damping leaves wins energy at the switch of slack and taut, over long
  Cell cell("stiffness", parameter, value, s.damping < 0.05 ? Must::either : Must::hold);
  cell.names = {"thread.main", "time step"};
  const std::int64_t steps = extent == Extent::full ? 200000 : 20000;
  cell.run = [s, steps] { return watch([s] { return stiff_thread(s); }, {steps}); };
  cell.place = {{"modulus_Pa", s.modulus},
                {"element_m", s.element},
                {"mass_ratio", s.mass_ratio},
                {"damping", s.damping}};
  return cell;
}

void add_sizes(std::vector<Cell>& cells, Extent extent) {
  for (const double element : {1e-4, 1e-3, 1e-2, 0.1, 0.5})
    for (int decade = 5; decade <= 12; ++decade) {
      const double modulus = std::pow(10, decade);
      cells.push_back(stiff_cell("modulus, element length", words(modulus) + " Pa, " + words(element) + " m",
                                 {modulus, element}, extent));
    }
}

void add_masses(std::vector<Cell>& cells, Extent extent) {
  for (const double ratio : {1e-3, 1.0, 1e2, 1e4, 1e6})
    for (const double damping : {0.0, 0.02, 0.106})
      cells.push_back(stiff_cell("mass beside a node, damping ratio", words(ratio) + ", " + words(damping),
                                 {1e9, 0.01, ratio, damping}, extent));
}

void add_dampings(std::vector<Cell>& cells, Extent extent) {
  for (const DampingRule rule : {DampingRule::element, DampingRule::stiffness})
    for (const double damping : {0.0, 0.005, 0.01, 0.05, 0.106, 0.5, 1.0, 3.0, 10.0})
      cells.push_back(stiff_cell("damping rule, ratio", word(rule) + ", " + words(damping),
                                 {1e9, 0.01, 10, damping, rule}, extent));
}

/// A thread with two masses flies across a ring's wire, or its first mass at a ball, at 1 m/s.
Scene contact(bool ring, double modulus, double alpha) {
  Scene scene = plain_scene();
  scene.contact.alpha_ring = scene.contact.alpha_target = alpha;
  Thread& thread = add_thread(scene, "main", {Vec3(-0.05, 0, 0), Vec3(0.05, 0, 0)}, 20);
  thread.velocity = Vec3(0, 0, -1);
  thread.start.mass = thread.end.mass = 0.01;
  if (ring) add_ring(scene, "r", Vec3(0, 0, 0.0068), Vec3(1, 0, 0)).youngs_modulus = modulus;
  else add_ball(scene, Vec3(0.01, 0.02, -0.152)).youngs_modulus = modulus;
  return scene;
}

void add_contacts(std::vector<Cell>& cells, Extent extent) {
  const std::int64_t steps = extent == Extent::full ? 100000 : 20000;
  for (const bool ring : {true, false})
    for (const double modulus : {1e6, 1e8, 1e10, 1e12})
      for (const double alpha : {0.0, 0.05, 0.3, 1.0}) {
        Cell cell("stiffness", ring ? "ring's modulus, alpha" : "ball's modulus, alpha",
                  words(modulus) + " Pa, " + words(alpha) + " s/m",
                  ring || alpha < 0.1 ? Must::hold : Must::either);
        cell.names = {"thread.main"};
        cell.run = [=] { return watch([=] { return contact(ring, modulus, alpha); }, {steps}); };
        cell.place = {{ring ? "ring_modulus_Pa" : "ball_modulus_Pa", modulus}, {"alpha_s_m", alpha}};
        cells.push_back(cell);
      }
}

}  // namespace

std::vector<Cell> stiffness(Extent extent) {
  std::vector<Cell> cells;
  add_sizes(cells, extent);
  add_masses(cells, extent);
  add_dampings(cells, extent);
  add_contacts(cells, extent);
  return cells;
}

}  // namespace cinch::matrix
