#include "scene/closing_loads.hpp"

#include <cmath>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// A mass on nodes, kg.
using Loads = std::map<Index, double>;

// Where a node is before the closing time.
void add_at(const Assembly& assembly, Index node, double mass, Loads& loads) {
  if (node < assembly.nodes_before) {
    loads[node] += mass;
    return;
  }
  const Lay& lay = assembly.lays[at(node - assembly.nodes_before)];
  loads[lay.a] += (1 - lay.s) * mass;
  if (lay.s > 0) loads[lay.b] += lay.s * mass;
}

// Of a thread's own mass, whatever its nodes carry besides.
Loads loads_by_nodes(const Assembly& assembly, const LaidThread& laid) {
  Loads loads;
  const std::vector<Index>& nodes = assembly.parts[at(laid.part)].nodes;
  const double half = 0.5 * laid.mass / static_cast<double>(nodes.size() - 1);
  for (std::size_t k = 1; k < nodes.size(); ++k)
    for (const std::size_t end : {k - 1, k}) add_at(assembly, nodes[end], half, loads);
  return loads;
}

Loads even_loads(const LaidAlong& along, const LaidThread& laid) {
  Loads loads;
  const Carrier& carrier = along.carrier;
  const double line = laid.mass / along.length;
  for (std::size_t n = 1; n < carrier.nodes.size(); ++n)
    for (const std::size_t end : {n - 1, n})
      loads[carrier.nodes[end]] += 0.5 * line * (carrier.reach[n] - carrier.reach[n - 1]);
  loads[carrier.nodes.front()] += line * along.overhang;
  loads[carrier.nodes.back()] += line * (along.length - along.overhang - carrier.reach.back());
  return loads;
}

void load_evenly(const LaidAlong& along, Assembly& assembly, LaidThread& laid) {
  if (assembly.laid_nodes(laid).empty()) return;  // none could take the difference when it is laid
  Loads excess = even_loads(along, laid);
  for (const auto& [node, mass] : loads_by_nodes(assembly, laid)) excess[node] -= mass;
  constexpr double rounding = 1e-12;
  for (const auto& [node, mass] : excess) {
    if (std::abs(mass) <= rounding * laid.mass) continue;
    assembly.nodes[at(node)].mass_before += mass;
    laid.excess.push_back({node, mass});
  }
}

}  // namespace

void superpose_closing_masses(const std::map<Index, LaidAlong>& carriers, Assembly& assembly) {
  for (AssemblyNode& n : assembly.nodes) n.mass_before = n.mass;
  for (const Lay& lay : assembly.lays) {
    const double mass = assembly.nodes[at(lay.node)].mass;
    assembly.nodes[at(lay.a)].mass_before += (1 - lay.s) * mass;
    if (lay.s > 0) assembly.nodes[at(lay.b)].mass_before += lay.s * mass;
    assembly.nodes[at(lay.node)].mass_before = 0;
  }
  for (LaidThread& laid : assembly.laid) load_evenly(carriers.at(laid.part), assembly, laid);
}

}  // namespace cinch
