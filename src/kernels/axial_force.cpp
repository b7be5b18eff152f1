// Element forces, block by block; the law stands in axial_law.hpp.
#include "kernels/axial_law.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::ElementBlock;
using kernel::Span;

// One span; power[k] receives the damper's power of element k when the ledger wants it.
template <bool damped, bool ledger>
inline void span_forces(const AxialArguments& g, const Span& span, double* __restrict power) {
  const double* __restrict ax = g.x + span.a, * __restrict ay = g.y + span.a, * __restrict az = g.z + span.a;
  const double* __restrict bx = g.x + span.b, * __restrict by = g.y + span.b, * __restrict bz = g.z + span.b;
  const double* __restrict au = g.vx + span.a, * __restrict av = g.vy + span.a, * __restrict aw = g.vz + span.a;
  const double* __restrict bu = g.vx + span.b, * __restrict bv = g.vy + span.b, * __restrict bw = g.vz + span.b;
  const double* __restrict k = g.stiffness + span.element;
  const double* __restrict c = g.damping + span.element;
  const double* __restrict l0 = g.rest_length + span.element;
  double* __restrict fx = g.fx + span.element, * __restrict fy = g.fy + span.element, * __restrict fz = g.fz + span.element;
#pragma omp simd
  for (Index i = 0; i < span.count; ++i) {
    const double rx = bx[i] - ax[i], ry = by[i] - ay[i], rz = bz[i] - az[i];
    const double rr = rx * rx + ry * ry + rz * rz;
    const double rv = damped ? rx * (bu[i] - au[i]) + ry * (bv[i] - av[i]) + rz * (bw[i] - aw[i]) : 0.0;
    const Axial item = axial_law(rr, rv, k[i], damped ? c[i] : 0.0, l0[i]);
    fx[i] = item.per_length * rx;
    fy[i] = item.per_length * ry;
    fz[i] = item.per_length * rz;
    if (damped && ledger) power[i] = item.power;
  }
}

// Adds a block's powers lane by lane: element i of the block goes to lane i mod 8, whatever the vector width.
inline void add_lanes(const double* __restrict power, Index count, double dt, double* __restrict sums) {
  Index i = 0;
  for (; i + kernel::lanes <= count; i += kernel::lanes)
    for (Index lane = 0; lane < kernel::lanes; ++lane) sums[lane] += dt * power[i + lane];
  for (Index lane = 0; i < count; ++i, ++lane) sums[lane] += dt * power[i];
}

template <bool damped, bool ledger>
void axial_forces(const AxialArguments& g, const ElementBlock* blocks, const Span* spans, Index begin,
                  Index end) {
  alignas(64) double power[kernel::block_size];
  for (Index block = begin; block < end; ++block) {
    Index count = 0;
    for (Index s = blocks[block].span_begin; s < blocks[block].span_end; ++s) {
      span_forces<damped, ledger>(g, spans[s], power + count);
      count += spans[s].count;
    }
    if (damped && ledger) add_lanes(power, count, g.dt, g.dissipated + block * kernel::lanes);
  }
}

}  // namespace

void fill_axial(KernelTable& table) {
  table.axial_forces[0][0] = axial_forces<false, false>;
  table.axial_forces[0][1] = axial_forces<false, true>;
  table.axial_forces[1][0] = axial_forces<true, false>;
  table.axial_forces[1][1] = axial_forces<true, true>;
}

}  // namespace cinch::CINCH_ISA
