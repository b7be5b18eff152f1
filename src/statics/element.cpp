#include "statics/element.hpp"

#include <cmath>

namespace cinch::statics {
namespace {

// |d| - l0 = (d.d - l0^2) / (|d| + l0), the numerator with the rounding of every product and sum carried
// along: at strains of 1e-6 the plain difference would lose six of sixteen digits.
double compensated_elongation(const Vec3& d, double rest) {
  double sum = -rest * rest, carried = -std::fma(rest, rest, sum);
  for (const double c : d) {
    const double square = c * c, next = sum + square, part = next - sum;
    carried += std::fma(c, c, -square) + ((sum - (next - part)) + (square - part));
    sum = next;
  }
  return (sum + carried) / (d.norm() + rest);
}

}  // namespace

Vec3 span(const StaticNet& net, const Points& x, std::size_t e) {
  return x[at(net.elements[e][1])] - x[at(net.elements[e][0])];
}

double elongation(const StaticNet& net, const Points& x, std::size_t e) {
  return compensated_elongation(span(net, x, e), net.rest_length[e]);
}

double force_density(const StaticNet& net, const Points& x, std::size_t e) {
  const double stretch = elongation(net, x, e);
  return stretch > 0 ? net.stiffness[e] * stretch / span(net, x, e).norm() : 0;
}

// With u = d / l: second derivative = axial u u^T + (T / l) (I - u u^T).
Block stiffness_block(const Vec3& d, double axial, double density) {
  const Vec3 u = d.normalized();
  return density * Block::Identity() + (axial - density) * u * u.transpose();
}

Block true_block(const StaticNet& net, const Points& x, std::size_t e) {
  const double density = force_density(net, x, e);
  return stiffness_block(span(net, x, e), density > 0 ? net.stiffness[e] : 0, density);
}

Points nodal_force(const StaticNet& net, const Points& x, const std::function<double(std::size_t)>& q) {
  Points force(x.size());
  for (std::size_t n = 0; n < x.size(); ++n) force[n] = net.mass[n] * net.gravity;
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const Vec3 pull = q(e) * span(net, x, e);
    force[at(net.elements[e][0])] += pull;
    force[at(net.elements[e][1])] -= pull;
  }
  return force;
}

}  // namespace cinch::statics
