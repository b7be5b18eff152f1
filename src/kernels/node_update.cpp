// Gathers the forces on each node in a fixed order and moves it by central differences:
//   v(n+1/2) = v(n-1/2) + dt F(n)/m,   x(n+1) = x(n) + dt v(n+1/2)            (paper Sec. 5.3)
// Forces that depend on velocity use v(n-1/2): the scheme is of second order in dt without them, of first
// order in them.
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::NodeArguments;
using kernel::NodeBlock;

// Forces on the nodes of one block, N.
struct BlockForce {
  alignas(64) double x[kernel::block_size], y[kernel::block_size], z[kernel::block_size];
};

// Nodes of one stretch with `count` summands each, known when compiled: one pass, each force written once.
template <bool gravity, int count>
inline void sum_stretch(const NodeArguments& g, const kernel::GatherStretch& s, Index first, BlockForce& f) {
  double* __restrict fx = f.x + (s.node - first), * __restrict fy = f.y + (s.node - first), * __restrict fz = f.z + (s.node - first);
  const double* __restrict m = g.mass + s.node;
  const double gx = g.gravity[0], gy = g.gravity[1], gz = g.gravity[2];
  const double *ex[count + 1], *ey[count + 1], *ez[count + 1];
  double sign[count + 1];
  for (int n = 0; n < count; ++n) {
    const kernel::GatherSource& source = g.sources[s.source_begin + n];
    ex[n] = g.fx + source.element;
    ey[n] = g.fy + source.element;
    ez[n] = g.fz + source.element;
    sign[n] = source.sign;
  }
#pragma omp simd
  for (Index i = 0; i < s.count; ++i) {
    double x = gravity ? m[i] * gx : 0.0, y = gravity ? m[i] * gy : 0.0, z = gravity ? m[i] * gz : 0.0;
    for (int n = 0; n < count; ++n) {
      x += sign[n] * ex[n][i];
      y += sign[n] * ey[n][i];
      z += sign[n] * ez[n][i];
    }
    fx[i] = x;
    fy[i] = y;
    fz[i] = z;
  }
}

// The summands from number `from` on, for the few nodes where more than four elements meet.
inline void add_rest(const NodeArguments& g, const kernel::GatherStretch& s, Index from, Index first,
                     BlockForce& f) {
  for (Index n = s.source_begin + from; n < s.source_end; ++n) {
    const auto [element, sign] = g.sources[n];
    for (Index i = 0; i < s.count; ++i) {
      f.x[s.node - first + i] += sign * g.fx[element + i];
      f.y[s.node - first + i] += sign * g.fy[element + i];
      f.z[s.node - first + i] += sign * g.fz[element + i];
    }
  }
}

template <bool gravity>
inline void gather(const NodeArguments& g, const kernel::GatherStretch& s, Index first, BlockForce& f) {
  switch (s.source_end - s.source_begin) {
    case 0:
      return sum_stretch<gravity, 0>(g, s, first, f);
    case 1:
      return sum_stretch<gravity, 1>(g, s, first, f);
    case 2:
      return sum_stretch<gravity, 2>(g, s, first, f);
    case 3:
      return sum_stretch<gravity, 3>(g, s, first, f);
    default:
      sum_stretch<gravity, 4>(g, s, first, f);
      return add_rest(g, s, 4, first, f);
  }
}

inline void add_loads(const NodeArguments& g, Index begin, Index end, Index first, BlockForce& f) {
  for (Index e = begin; e < end; ++e) {
    const Index i = g.entries[e].node - first, slot = g.entries[e].slot;
    f.x[i] += g.load_x[slot];
    f.y[i] += g.load_y[slot];
    f.z[i] += g.load_z[slot];
  }
}

// Guided and fixed nodes keep the force along their axis; the rest is the support's reaction.
inline void constrain(const NodeArguments& g, const NodeBlock& block, BlockForce& f) {
  for (Index c = block.constraint_begin; c < block.constraint_end; ++c) {
    const kernel::Constraint& k = g.constraints[c];
    const Index i = k.node - block.first;
    const double along = f.x[i] * k.ax + f.y[i] * k.ay + f.z[i] * k.az;
    const double kept[3] = {along * k.ax, along * k.ay, along * k.az};
    const double taken[3] = {g.dt * (kept[0] - f.x[i]), g.dt * (kept[1] - f.y[i]), g.dt * (kept[2] - f.z[i])};
    const double at[3] = {g.x[k.node], g.y[k.node], g.z[k.node]};
    kernel::Reaction& r = g.reactions[c];
    for (int d = 0; d < 3; ++d) {
      r.impulse[d] += taken[d];
      r.moment[d] += at[(d + 1) % 3] * taken[(d + 2) % 3] - at[(d + 2) % 3] * taken[(d + 1) % 3];
    }
    f.x[i] = kept[0];
    f.y[i] = kept[1];
    f.z[i] = kept[2];
  }
}

inline kernel::Watch move(const NodeArguments& g, const NodeBlock& block, const BlockForce& f) {
  double* __restrict x = g.x + block.first, * __restrict y = g.y + block.first, * __restrict z = g.z + block.first;
  double *__restrict vx = g.vx + block.first, *__restrict vy = g.vy + block.first,
         *__restrict vz = g.vz + block.first;
  const double* __restrict inverse_mass = g.inverse_mass + block.first;
  const double dt = g.dt;
  double greatest = 0, sum = 0;  // the sum only tells whether all is finite, so its order does not matter
#pragma omp simd reduction(max : greatest) reduction(+ : sum)
  for (Index i = 0; i < block.count; ++i) {
    const double scale = dt * inverse_mass[i];
    const double u = vx[i] + scale * f.x[i], v = vy[i] + scale * f.y[i], w = vz[i] + scale * f.z[i];
    vx[i] = u;
    vy[i] = v;
    vz[i] = w;
    x[i] += dt * u;
    y[i] += dt * v;
    z[i] += dt * w;
    const double squared = u * u + v * v + w * w;
    greatest = squared > greatest ? squared : greatest;
    sum += squared;
  }
  return {greatest, sum};
}

template <bool gravity>
void update_nodes(const NodeArguments& g, const NodeBlock* blocks, Index begin, Index end,
                  kernel::Watch* watch) {
  BlockForce f;
  for (Index b = begin; b < end; ++b) {
    const NodeBlock& block = blocks[b];
    for (Index s = block.stretch_begin; s < block.stretch_end; ++s)
      gather<gravity>(g, g.stretches[s], block.first, f);
    add_loads(g, g.entry_begin[b], g.entry_begin[b + 1], block.first, f);
    constrain(g, block, f);
    watch[b] = move(g, block, f);
  }
}

}  // namespace

void fill_node_update(KernelTable& table) {
  table.update_nodes[0] = update_nodes<false>;
  table.update_nodes[1] = update_nodes<true>;
}

}  // namespace cinch::CINCH_ISA
