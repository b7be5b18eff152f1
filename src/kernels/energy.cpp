// Energies of nodes at the time of a look. The velocity lies half a step back, and the look knows what the
// next step would add to it. The kinetic energy is m v(n-1/2).v(n+1/2)/2: with the energy of the springs at
// n, central differences keep it to the last digit as long as no spring turns slack, while that of the mean
// velocity, dt^2 F^2/(8 m) higher, trembles.
#include <cstddef>

#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::EnergyArguments;
using kernel::lanes;

template <bool whole>
inline void add_group(const EnergyArguments& g, std::ptrdiff_t first, std::ptrdiff_t count,
                      double* __restrict kinetic, double* __restrict gravity) {
#pragma omp simd
  for (std::ptrdiff_t lane = 0; lane < (whole ? lanes : count); ++lane) {
    const std::ptrdiff_t i = first + lane;
    const double u = g.vx[i], v = g.vy[i], w = g.vz[i], m = g.mass[i], twice = 2 * g.share;
    kinetic[lane] +=
        0.5 * m *
        (u * (u + twice * g.gain_x[i]) + v * (v + twice * g.gain_y[i]) + w * (w + twice * g.gain_z[i]));
    gravity[lane] -= m * (g.gravity[0] * g.x[i] + g.gravity[1] * g.y[i] + g.gravity[2] * g.z[i]);
  }
}

// Lane by lane, then lane after lane: the same bits for every vector width.
kernel::NodeEnergies node_energies(const EnergyArguments& g) {
  alignas(64) double kinetic[lanes] = {}, gravity[lanes] = {};
  std::ptrdiff_t i = 0;
  for (; i + lanes <= g.nodes; i += lanes) add_group<true>(g, i, lanes, kinetic, gravity);
  add_group<false>(g, i, g.nodes - i, kinetic, gravity);
  kernel::NodeEnergies sum{0, 0};
  for (Index lane = 0; lane < lanes; ++lane) {
    sum.kinetic += kinetic[lane];
    sum.gravity += gravity[lane];
  }
  return sum;
}

}  // namespace

void fill_energy(KernelTable& table) { table.node_energies = node_energies; }

}  // namespace cinch::CINCH_ISA
