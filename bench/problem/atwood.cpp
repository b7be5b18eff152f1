// Atwood's machine: masses M and m on an elastic thread that hangs on both sides of a ring, with a sliding
// joint. A thread of mass mu a length that does not stretch, over a ring without size, obeys
//   (M + m + mu L) x'' = g (M - m) + g mu (b - a + 2 x)
// by how far x the heavy side has gone down, whose length was b, a the light one's, L = a + b. From rest that
// is
//   x = (c / k^2) (cosh(k t) - 1),  k^2 = 2 g mu / (M + m + mu L),  c = x'' at first.
// This thread stretches by 1e-3, nearly evenly: what it does otherwise is 1e-5 of its way.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common.hpp"
#include "input/case_reader.hpp"

namespace cinch::study {
namespace {

constexpr double gravity = 9.81, heavy = 0.3, light = 0.2, modulus = 1e9, density = 970;  // SI units
constexpr double diameter = 0.002, area = std::numbers::pi / 4 * diameter * diameter;
constexpr double light_side = 0.9, heavy_side = 0.3, both_sides = light_side + heavy_side;  // as laid, m
constexpr double opening = 0.0035 - 0.00225 - 0.001;  // of the ring, less half of the thread's thickness, m
constexpr double moved = heavy + light + density * area * both_sides;
constexpr double end = 0.6;  // s

double first_acceleration() {
  const double more = density * area * (heavy_side - light_side);
  return gravity * (heavy - light + more) / moved;
}

double way_down(double time) {
  const double k2 = 2 * gravity * density * area / moved;
  return first_acceleration() / k2 * (std::cosh(std::sqrt(k2) * time) - 1);
}

Scene machine(const Setting& setting) {
  const double pull = light * (gravity + first_acceleration());
  char text[1200];
  std::snprintf(text, sizeof text, R"(schema = 1
[time]
end_s = 1
[gravity]
acceleration_m_s2 = [0, 0, %.17g]
[material.m]
youngs_modulus_Pa = %.17g
density_kg_m3 = %.17g
[thread.main]
material = "m"
diameter_m = %.17g
elements = %d
length_m = %.17g
points_m = [[0, -1e-6, %.17g], [0, 0, 0], [0, 1e-6, %.17g]]
start = { mass_kg = %.17g }
end = { mass_kg = %.17g }
[ring.pulley]
diameter_m = 0.007
wire_diameter_m = 0.0045
mass_kg = 1
youngs_modulus_Pa = 1e9
center_m = [0, 0, %.17g]
normal = [0, 1, 0]
support = "fixed"
joint = "sliding"
)",
                -gravity, modulus, density, diameter, setting.elements,
                both_sides / (1 + pull / (modulus * area)), -light_side, -heavy_side, light, heavy,
                opening - 1e-7);  // so that the thread as laid is within
  Scene scene = parse_case(text, "atwood.toml");
  scene.time.joint_steps = setting.joint_steps;
  scene.time.step = setting.fraction * prepare(scene).stable_step;
  return scene;
}

}  // namespace

Problem atwood(Extent extent) {
  Problem p;
  p.name = "atwood";
  p.title = "Two masses on a thread over a ring (Atwood's machine, exact solution)";
  p.measure = "greatest distance of the heavy mass from its place over 0.6 s, of the way that it goes";
  p.end = end;
  p.samples = 100;
  p.scene = machine;
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    return std::vector<double>{-heavy_side - now.position(now.assembly().node_of("thread.main.end")).z()};
  };
  p.exact = [](double time) { return std::vector<double>{way_down(time)}; };
  p.errors = [](const Track& found, const Track& reference) {
    return Errors{{"error", greatest(found, reference, 0, 1) / way_down(end)}};
  };
  std::vector<int> elements{4, 8, 16, 32, 64};
  if (extent == Extent::trial) elements = {4, 8, 16};
  for (const double fraction : {0.8, 0.4, 0.2, 0.1}) add_series(p.settings, "sliding", elements, fraction);
  return p;
}

}  // namespace cinch::study
