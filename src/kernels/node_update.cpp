// Moves nodes by central differences:
//   v(n+1/2) = v(n-1/2) + dt F(n)/m,   x(n+1) = x(n) + dt v(n+1/2)            (paper Sec. 5.3)
// Forces that depend on velocity use v(n-1/2): the scheme is of second order in dt without them, of first
// order in them. Element forces are gathered in the pass that moves the nodes, and standing loads with them;
// what only a few nodes feel (links, contacts) is added behind it, v += dt L/m and x += dt (dt L/m), and
// supports take off last what they do not allow.
#include <cstddef>

#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::Constraint;
using kernel::Kick;
using kernel::Load;
using kernel::Moving;
using kernel::NodeArguments;
using kernel::Stretch;

// Where the forces of one term begin: those of the first node, x, y and z.
struct Force {
  const double *x, *y, *z;
  Force(const NodeArguments& g, Index first) : x(g.fx + first), y(g.fy + first), z(g.fz + first) {}
};

// The sum of a node's terms along one axis. In a chain the first term's forces follow each other in memory,
// so that one address serves both.
template <bool chain, int terms>
inline double sum(const double* p0, const double* m0, const double* p1, const double* m1, const double* p2,
                  const double* m2, const double* p3, const double* m3, std::ptrdiff_t i) {
  if (terms == 0) return 0;
  double all = p0[i] - (chain ? p0[i - 1] : m0[i]);
  if (terms > 1) all += p1[i] - m1[i];
  if (terms > 2) all += p2[i] - m2[i];
  if (terms > 3) all += p3[i] - m3[i];
  return all;
}

// `count` nodes; returns the greatest squared speed where it is watched. Parameters rather than a struct: so
// compilers know that the arrays are apart.
template <bool gravity, Moving::Kind kind, bool chain, int terms>
inline double move(std::ptrdiff_t count, double* __restrict x, double* __restrict y, double* __restrict z,
                   double* __restrict vx, double* __restrict vy, double* __restrict vz,
                   const double* __restrict scale, Force p0, Force m0, Force p1, Force m1, Force p2, Force m2,
                   Force p3, Force m3, const double* lx, const double* ly, const double* lz,
                   const double (&pull)[3], double dt) {
  constexpr bool loaded = kind == Moving::loaded;
  const double gx = pull[0], gy = pull[1], gz = pull[2];
  double greatest = 0;
#pragma omp simd reduction(max : greatest)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double s = scale[i];
    const double fx = sum<chain, terms>(p0.x, m0.x, p1.x, m1.x, p2.x, m2.x, p3.x, m3.x, i);
    const double fy = sum<chain, terms>(p0.y, m0.y, p1.y, m1.y, p2.y, m2.y, p3.y, m3.y, i);
    const double fz = sum<chain, terms>(p0.z, m0.z, p1.z, m1.z, p2.z, m2.z, p3.z, m3.z, i);
    const double ax = s * (loaded ? fx + lx[i] : fx);
    const double ay = s * (loaded ? fy + ly[i] : fy);
    const double az = s * (loaded ? fz + lz[i] : fz);
    const double u = vx[i] + (gravity ? ax + gx : ax);
    const double v = vy[i] + (gravity ? ay + gy : ay);
    const double w = vz[i] + (gravity ? az + gz : az);
    const double new_x = x[i] + dt * u, new_y = y[i] + dt * v, new_z = z[i] + dt * w;
    vx[i] = u, vy[i] = v, vz[i] = w;
    x[i] = new_x, y[i] = new_y, z[i] = new_z;
    if (kind != Moving::blind) {
      const double squared = u * u + v * v + w * w;
      greatest = squared > greatest ? squared : greatest;
    }
  }
  return greatest;
}

// The nodes of one stretch.
template <bool gravity, Moving::Kind kind, bool chain, int terms>
double move_stretch(const NodeArguments& g, const Stretch& s) {
  const auto load = [&](const double* loads) { return kind == Moving::loaded ? loads + s.node : nullptr; };
  return move<gravity, kind, chain, terms>(
      s.count, g.x + s.node, g.y + s.node, g.z + s.node, g.vx + s.node, g.vy + s.node, g.vz + s.node,
      g.scale + s.node, Force(g, s.plus[0]), Force(g, s.minus[0]), Force(g, s.plus[1]), Force(g, s.minus[1]),
      Force(g, s.plus[2]), Force(g, s.minus[2]), Force(g, s.plus[3]), Force(g, s.minus[3]), load(g.load_x),
      load(g.load_y), load(g.load_z), g.gravity, g.dt);
}

template <bool gravity, Moving::Kind kind>
inline double move_one(const NodeArguments& g, const Stretch& s) {
  const bool chain = s.minus[0] == s.plus[0] - 1;
  switch (s.terms) {
    case 0:
      return move_stretch<gravity, kind, false, 0>(g, s);
    case 1:
      return chain ? move_stretch<gravity, kind, true, 1>(g, s) : move_stretch<gravity, kind, false, 1>(g, s);
    case 2:
      return chain ? move_stretch<gravity, kind, true, 2>(g, s) : move_stretch<gravity, kind, false, 2>(g, s);
    case 3:
      return move_stretch<gravity, kind, false, 3>(g, s);
    default:
      return move_stretch<gravity, kind, false, kernel::max_terms>(g, s);
  }
}

template <bool gravity, Moving::Kind kind>
double move_nodes(const NodeArguments& g, const Stretch* stretches, Index begin, Index end) {
  double greatest = 0;
  for (Index i = begin; i < end; ++i) {
    const double here = move_one<gravity, kind>(g, stretches[i]);
    greatest = here > greatest ? here : greatest;
  }
  return greatest;
}

// One more force on a node that has moved already; its new squared speed.
inline double push(const NodeArguments& g, Index node, double fx, double fy, double fz) {
  const double s = g.scale[node];
  const double ax = s * fx, ay = s * fy, az = s * fz;
  const double u = g.vx[node] + ax, v = g.vy[node] + ay, w = g.vz[node] + az;
  g.vx[node] = u;
  g.vy[node] = v;
  g.vz[node] = w;
  g.x[node] += g.dt * ax;
  g.y[node] += g.dt * ay;
  g.z[node] += g.dt * az;
  return u * u + v * v + w * w;
}

double kick_nodes(const NodeArguments& g, const Kick* kicks, Index begin, Index end) {
  double greatest = 0;
  for (Index i = begin; i < end; ++i) {
    const Kick& k = kicks[i];
    const double here =
        push(g, k.node, k.sign * g.fx[k.force], k.sign * g.fy[k.force], k.sign * g.fz[k.force]);
    greatest = here > greatest ? here : greatest;
  }
  return greatest;
}

double load_nodes(const NodeArguments& g, const Load* loads, Index count) {
  double greatest = 0;
  for (Index i = 0; i < count; ++i) {
    const Load& l = loads[i];
    if (g.scale[l.node] == 0) continue;  // another thread moves it
    const double here = push(g, l.node, l.x, l.y, l.z);
    greatest = here > greatest ? here : greatest;
  }
  return greatest;
}

void hold_before(const NodeArguments& g, const Constraint* constraints, Index begin, Index end,
                 kernel::Held* held) {
  for (Index c = begin; c < end; ++c) {
    const Index i = constraints[c].node;
    held[c] = {g.x[i], g.y[i], g.z[i], g.vx[i], g.vy[i], g.vz[i]};
  }
}

// The node has moved freely; the support takes off what its axis does not allow and books the impulse.
void hold_after(const NodeArguments& g, const Constraint* constraints, Index begin, Index end,
                const kernel::Held* held, kernel::Reaction* const* reactions) {
  for (Index c = begin; c < end; ++c) {
    const Constraint& k = constraints[c];
    const kernel::Held& old = held[c];
    const V3 free{g.vx[k.node] - old.vx, g.vy[k.node] - old.vy, g.vz[k.node] - old.vz};
    const V3 axis{k.ax, k.ay, k.az};
    const V3 kept = dot(free, axis) * axis;
    const V3 taken = k.mass * (kept - free);
    const V3 moment = cross({old.x, old.y, old.z}, taken);
    kernel::Reaction& r = *reactions[c];
    const double impulse[3] = {taken.x, taken.y, taken.z}, turned[3] = {moment.x, moment.y, moment.z};
    for (int d = 0; d < 3; ++d) {
      r.impulse[d] += impulse[d];
      r.moment[d] += turned[d];
    }
    const V3 v = V3{old.vx, old.vy, old.vz} + kept;
    g.vx[k.node] = v.x, g.vy[k.node] = v.y, g.vz[k.node] = v.z;
    g.x[k.node] = old.x + g.dt * v.x, g.y[k.node] = old.y + g.dt * v.y, g.z[k.node] = old.z + g.dt * v.z;
  }
}

}  // namespace

void fill_node_update(KernelTable& table) {
  table.move_nodes[0][Moving::blind] = move_nodes<false, Moving::blind>;
  table.move_nodes[0][Moving::watched] = move_nodes<false, Moving::watched>;
  table.move_nodes[0][Moving::loaded] = move_nodes<false, Moving::loaded>;
  table.move_nodes[1][Moving::blind] = move_nodes<true, Moving::blind>;
  table.move_nodes[1][Moving::watched] = move_nodes<true, Moving::watched>;
  table.move_nodes[1][Moving::loaded] = move_nodes<true, Moving::loaded>;
  table.kick_nodes = kick_nodes;
  table.load_nodes = load_nodes;
  table.hold_before = hold_before;
  table.hold_after = hold_after;
}

}  // namespace cinch::CINCH_ISA
