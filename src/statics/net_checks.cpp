#include "statics/net_checks.hpp"

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "statics/equilibrium.hpp"

namespace cinch::statics {
namespace {

void check_arrays(const StaticNet& net) {
  const std::size_t nodes = net.position.size(), elements = net.elements.size();
  if (net.mass.size() != nodes || net.support.size() != nodes || net.axis.size() != nodes)
    throw NumericalError("error: static equilibrium: position, mass, support and axis differ in length");
  if (net.stiffness.size() != elements || net.rest_length.size() != elements)
    throw NumericalError("error: static equilibrium: elements, stiffness and rest length differ in length");
}

void check_nodes(const StaticNet& net) {
  for (std::size_t n = 0; n < net.position.size(); ++n)
    if (!net.position[n].allFinite() || !(net.mass[n] >= 0) ||
        (net.support[n] == Support::guided && !(net.axis[n].norm() > 0)))
      throw NumericalError("error: static equilibrium: bad position, mass or axis of " +
                           describe(net, net.position, n));
}

void check_elements(const StaticNet& net) {
  const Index end = static_cast<Index>(net.position.size());
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const auto [a, b] = net.elements[e];
    if (a < 0 || b < 0 || a >= end || b >= end || a == b || !(net.stiffness[e] > 0) ||
        !(net.rest_length[e] > 0))
      throw NumericalError("error: static equilibrium: bad nodes, stiffness or rest length of element " +
                           std::to_string(e));
  }
}

// Nodes of each connected piece.
std::vector<std::vector<std::size_t>> pieces(const StaticNet& net) {
  std::vector<std::vector<std::size_t>> neighbours(net.position.size()), found;
  for (const auto& [a, b] : net.elements) {
    neighbours[at(a)].push_back(at(b));
    neighbours[at(b)].push_back(at(a));
  }
  std::vector<bool> seen(net.position.size(), false);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    if (seen[n]) continue;
    seen[n] = true;
    std::vector<std::size_t> piece{n};
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const std::size_t other : neighbours[piece[i]])
        if (!seen[other]) {
          seen[other] = true;
          piece.push_back(other);
        }
    found.push_back(std::move(piece));
  }
  return found;
}

// The energy has no minimum only if a piece can be shifted as a whole along its supports with gravity doing
// work: with nothing fixed, along gravity itself, or along its guides if they are all parallel.
void check_supports(const StaticNet& net) {
  for (const auto& piece : pieces(net)) {
    double mass = 0;
    bool held = false;
    Vec3 way = net.gravity;
    bool guided = false;
    for (const std::size_t n : piece) {
      if (net.support[n] != Support::fixed) mass += net.mass[n];
      if (net.support[n] == Support::fixed) held = true;
      if (net.support[n] != Support::guided) continue;
      const Vec3 axis = net.axis[n].normalized();
      if (guided && axis.cross(way).norm() > 1e-9) held = true;
      way = axis;
      guided = true;
    }
    if (held || mass * std::abs(way.dot(net.gravity)) <= 1e-12 * mass * net.gravity.norm() * way.norm())
      continue;
    throw CanFall("error: static equilibrium: the piece of " + std::to_string(piece.size()) + " nodes with " +
                      describe(net, net.position, piece[0]) +
                      " can fall: it is tied to no fixed node, and no guide holds it against gravity",
                  piece[0], piece.size());
  }
}

}  // namespace

void check_net(const StaticNet& net) {
  check_arrays(net);
  check_nodes(net);
  check_elements(net);
  check_supports(net);
}

std::string describe(const StaticNet& net, const Points& x, std::size_t n) {
  const char* kind = net.support[n] == Support::guided ? "guided node" : "node";
  char text[160];
  std::snprintf(text, sizeof text, "%s %zu at (%.6g, %.6g, %.6g) m", kind, n, x[n].x(), x[n].y(), x[n].z());
  return text;
}

}  // namespace cinch::statics
