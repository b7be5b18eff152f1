#include "scene/spring.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "scene/fault.hpp"

namespace cinch {
namespace {

double circle_area(double diameter) { return std::numbers::pi * diameter * diameter / 4; }

// Far from what overflows or vanishes when such values are multiplied, divided and summed up.
bool usable(double value) { return value >= 1e-60 && value <= 1e60; }

void check(const Spring& spring, const SourceRef& source) {
  const AssemblyElement& e = spring.element;
  if (usable(e.rest_length) && usable(e.stiffness) && usable(spring.mass) && e.damping <= 1e60) return;
  char text[300];
  std::snprintf(
      text, sizeof text,
      "elements of length %.3g m and diameter %.3g m have stiffness %.3g N/m, damping %.3g N s/m and mass "
      "%.3g kg, allowed: 1e-60 to 1e60 each",
      e.rest_length, 2 * e.radius, e.stiffness, e.damping, spring.mass);
  fail(source, text);
}

}  // namespace

double compliance(double youngs_modulus, double poissons_ratio) {
  return (1 - poissons_ratio * poissons_ratio) / (std::numbers::pi * youngs_modulus);
}

Spring spring_of(double rest_length, double diameter, const Material& m, Index part,
                 const SourceRef& source) {
  Spring spring;
  spring.mass = m.density * circle_area(diameter) * rest_length;
  AssemblyElement& e = spring.element;
  e.rest_length = rest_length;
  e.stiffness = m.youngs_modulus * circle_area(diameter) / rest_length;
  e.damping = m.damping_rule == DampingRule::element
                  ? 2 * m.damping_ratio * std::sqrt(e.stiffness * spring.mass)
                  : 2 * m.damping_ratio / m.damping_frequency * e.stiffness;
  e.radius = diameter / 2;
  e.compliance = compliance(m.youngs_modulus, m.poissons_ratio);
  e.part = part;
  check(spring, source);
  return spring;
}

}  // namespace cinch
