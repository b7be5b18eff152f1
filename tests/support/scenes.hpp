// What the physics tests share: short ways to write a scene, to move it and to look at it.
#pragma once
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "input/case_reader.hpp"
#include "plan/simulation.hpp"

namespace cinch::test {

constexpr double g0 = 9.81;  // m/s^2

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

inline Scene scene_of(std::string_view toml) { return parse_case(toml, "test.toml"); }

/// A second of `thread.main`, 2 mm thick, of material "m"; `rest`: further keys of the thread and what stands
/// behind it.
inline Scene thread_scene(double youngs_modulus, double damping_ratio, const std::string& rest) {
  Scene scene = scene_of(R"(schema = 1
[time]
end_s = 1
[material.m]
youngs_modulus_Pa = 1e9
density_kg_m3 = 970
[thread.main]
material = "m"
diameter_m = 0.002
)" + rest);
  scene.materials.at("m").youngs_modulus = youngs_modulus;
  scene.materials.at("m").damping_ratio = damping_ratio;
  return scene;
}

/// A mass of 0.1 kg on a thread of 200 elements, pushed aside: the thread has no damping and turns slack and
/// taut by turns. For 2 s, in steps of `step` s; the stable step is 1.56e-5 s.
inline Scene slackening_thread(double step) {
  Scene scene = thread_scene(1e8, 0, R"(
elements = 200
points_m = [[0, 0, 0], [0, 1, 0]]
start = { mass_kg = 0.1, velocity_m_s = [0, 0, -1] }
end = { support = "fixed" }
)");
  scene.time.end = 2;
  scene.time.step = step;
  return scene;
}

inline Vec3 place(const Simulation& sim, Index node) {
  return {sim.state().x[at(node)], sim.state().y[at(node)], sim.state().z[at(node)]};
}

inline std::vector<Vec3> places(const Simulation& sim) {
  std::vector<Vec3> all;
  for (Index i = 0; i < sim.model().nodes; ++i) all.push_back(place(sim, i));
  return all;
}

inline void run_until(Simulation& sim, double time) {
  sim.advance_to(sim.preparation().timeline.step_at(time));
}

inline double step_of(const Simulation& sim) { return sim.stepper().plan().dt; }

inline double circle(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

/// h of eq. (8), 1/Pa.
inline double compliance(double youngs_modulus, double poissons_ratio) {
  return (1 - poissons_ratio * poissons_ratio) / (std::numbers::pi * youngs_modulus);
}

/// k_c of eq. (7), N/m^1.5.
inline double hertz_stiffness(double r1, double r2, double h1, double h2) {
  return 4 / (3 * std::numbers::pi) / (h1 + h2) * std::sqrt(r1 * r2 / (r1 + r2));
}

}  // namespace cinch::test
