// A mass M on an elastic thread of mass m = rho A L that hangs from x = 0, with gravity g along x. By how far
// a point is drawn down, u(x, t), obeys
//   rho u_tt = E u_xx + rho g,   u(0) = 0,   M u_tt = M g - E A u_x at x = L,
// which rests at  u_s = g/c^2 (L x - x^2 / 2) + M g x / (E A),  c^2 = E / rho.  Begun at rest with an even
// stretch u = e x it is  u_s + sum a_n sin(k_n x) cos(c k_n t),  k_n L tan(k_n L) = m / M,  and
//   a_n = (rho A int w sin(k_n x) dx + M w(L) sin(k_n L)) / (rho A int sin^2(k_n x) dx + M sin^2(k_n L)),
// w = e x - u_s: the sines are orthogonal with the mass at the end. The thread stays taut.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common.hpp"
#include "input/case_reader.hpp"

namespace cinch::study {
namespace {

constexpr double gravity = 9.81, length = 1, modulus = 1e8, density = 970, weight = 0.01;  // SI units
constexpr double diameter = 0.002, area = std::numbers::pi / 4 * diameter * diameter;
constexpr double own_mass = density * area * length;
constexpr double stiffness = modulus * area / length;                      // N/m
constexpr double at_rest = (weight + own_mass / 2) * gravity / stiffness;  // u_s at the weight, m
constexpr double at_first = 0.5 * weight * gravity / stiffness;            // u there at t = 0, m

Scene hanging(const Setting& setting) {
  char text[800];
  std::snprintf(text, sizeof text, R"(schema = 1
[time]
end_s = 1
[gravity]
acceleration_m_s2 = [%.17g, 0, 0]
[material.m]
youngs_modulus_Pa = %.17g
density_kg_m3 = %.17g
damping_ratio = 0
[thread.main]
material = "m"
diameter_m = %.17g
elements = %d
length_m = %.17g
points_m = [[0, 0, 0], [%.17g, 0, 0]]
start = { support = "fixed" }
end = { mass_kg = %.17g }
)",
                gravity, modulus, density, diameter, setting.elements, length, length + at_first, weight);
  Scene scene = parse_case(text, "hanging.toml");
  scene.time.step = setting.fraction * prepare(scene).stable_step;
  return scene;
}

// The n-th root q = k_n L of q tan q = ratio, between n pi and (n + 1/2) pi: there q sin q - ratio cos q
// changes its sign once, from that of -cos(n pi).
double wave_number(int n, double ratio) {
  double low = n * std::numbers::pi, high = low + 0.5 * std::numbers::pi;
  const double sign = n % 2 == 0 ? 1 : -1;
  for (int i = 0; i < 60; ++i) {
    const double q = 0.5 * (low + high);
    (sign * (q * std::sin(q) - ratio * std::cos(q)) < 0 ? low : high) = q;
  }
  return 0.5 * (low + high);
}

// u of the weight as a sum of swings.
struct Swing {
  double amplitude, frequency;  // m, rad/s
};

std::array<Swing, 400> swings() {  // amplitudes fall as 1 / n^3
  const double c2 = modulus / density;
  // w = b1 x + b2 x^2
  const double b1 = at_first / length - gravity * length / c2 - weight * gravity / (modulus * area);
  const double b2 = 0.5 * gravity / c2;
  std::array<Swing, 400> all;
  for (int n = 0; n < 400; ++n) {
    const double q = wave_number(n, own_mass / weight), k = q / length, s = std::sin(q), c = std::cos(q);
    const double x_sin = (s - q * c) / (k * k);
    const double x2_sin = (2 * q * s + (2 - q * q) * c - 2) / (k * k * k);
    const double above =
        density * area * (b1 * x_sin + b2 * x2_sin) + weight * (b1 * length + b2 * length * length) * s;
    const double below = density * area * 0.5 * (length - s * c / k) + weight * s * s;
    all[static_cast<std::size_t>(n)] = {above / below * s, std::sqrt(c2) * k};
  }
  return all;
}

}  // namespace

Problem weight_on_a_thread(Extent extent) {
  Problem p;
  p.name = "weight_on_a_thread";
  p.title = "A weight swings up and down on a thread (exact solution)";
  p.measure = "greatest distance of the weight from its place over ten swings, of the stretch at rest";
  p.end = 0.4;
  p.samples = 400;
  p.scene = hanging;
  p.sample = [](Simulation& sim) {
    const Look& now = sim.look();
    return std::vector<double>{now.position(now.assembly().node_of("thread.main.end")).x() - length};
  };
  p.exact = [all = swings()](double time) {
    double u = at_rest;
    for (const Swing& swing : all) u += swing.amplitude * std::cos(swing.frequency * time);
    return std::vector<double>{u};
  };
  p.errors = [](const Track& found, const Track& reference) {
    return Errors{{"error", greatest(found, reference, 0, 1) / at_rest}};
  };
  std::vector<int> elements{2, 4, 8, 16, 32, 64, 128};
  if (extent == Extent::trial) elements = {4, 8, 16};
  for (const double fraction : {0.95, 0.8, 0.4, 0.2, 0.1})
    add_series(p.settings, "threads", elements, fraction);
  return p;
}

}  // namespace cinch::study
