// Free flight: how long elements stay slack if no force acts on their nodes, and those nodes moved by many
// steps at once. The additions are those of node_update.cpp one by one, and so are the bits.
//
// Between nodes that fly freely r(t) = r + t u, u the difference of their velocities, in a common field of
// gravity, too. |r(t)|^2 is convex, so an element that is slack now stays so until
//   t = (-b + sqrt(b^2 - a c)) / a,   a = u.u, b = r.u, c = r.r - l^2 <= 0.
#include <cmath>
#include <cstddef>

#include "kernels/eight.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::lanes;
using kernel::Link;
using kernel::NodeArguments;
using kernel::Span;

// When an element of length l reaches it, s; `below` = l^2 - r.r. Not a number between nodes at rest.
inline double time_to_stretch(double below, double uu, double ru) {
  const double root = std::sqrt(ru * ru + uu * below);
  return ru > 0 ? below / (ru + root) : (root - ru) / uu;
}

// How the elements of a group stand: l^2 - r.r, u.u, r.u.
struct Approaches {
  alignas(64) double below[lanes], uu[lanes], ru[lanes];
};

inline void approach(const AxialArguments& g, const Span& s, std::ptrdiff_t group, double part,
                     Approaches& out) {
  const double* __restrict const rest =
      g.palette +
      (kernel::palette_fields * static_cast<std::ptrdiff_t>(g.parameter[s.parameter + group]) + 2) * lanes;
  const std::ptrdiff_t first = s.node + group * lanes;
#pragma omp simd
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t i = first + lane, j = i + s.step;
    const double rx = g.x[j] - g.x[i], ry = g.y[j] - g.y[i], rz = g.z[j] - g.z[i];
    const double u = g.vx[j] - g.vx[i], v = g.vy[j] - g.vy[i], w = g.vz[j] - g.vz[i];
    const double length = part * rest[lane];
    out.below[lane] = length * length - (rx * rx + ry * ry + rz * rz);
    out.uu[lane] = u * u + v * v + w * w;
    out.ru[lane] = rx * u + ry * v + rz * w;
  }
}

// 0 where an element of the group is not slack. Those that are it now and after `enough`, by far most, are
// it in between, too: no roots for them.
inline double time_of_group(const AxialArguments& g, const Span& s, std::ptrdiff_t group, double part,
                            double enough) {
  Approaches a;
  approach(g, s, group, part, a);
  double taut = 0, taut_later = 0;
#pragma omp simd reduction(+ : taut, taut_later)
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    taut += a.below[lane] > 0 ? 0.0 : 1.0;
    taut_later += a.below[lane] > enough * (2 * a.ru[lane] + enough * a.uu[lane]) ? 0.0 : 1.0;
  }
  if (taut > 0) return 0;
  if (!(taut_later > 0)) return enough;
  double least = enough;
#pragma omp simd reduction(min : least)
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const double time = time_to_stretch(a.below[lane], a.uu[lane], a.ru[lane]);
    least = time < least ? time : least;
  }
  return least;
}

inline double time_of_link(const AxialArguments& g, const Link& l, double part) {
  const V3 r = V3{g.x[l.b], g.y[l.b], g.z[l.b]} - V3{g.x[l.a], g.y[l.a], g.z[l.a]};
  const V3 u = V3{g.vx[l.b], g.vy[l.b], g.vz[l.b]} - V3{g.vx[l.a], g.vy[l.a], g.vz[l.a]};
  const double length = part * l.rest_length, below = length * length - dot(r, r);
  return below > 0 ? time_to_stretch(below, dot(u, u), dot(r, u)) : 0;
}

double time_to_pull(const AxialArguments& g, const Span* spans, Index span_count, const Link* links,
                    Index link_count, double part, double enough) {
  double least = enough;
  for (Index i = 0; i < span_count; ++i)
    for (Index group = 0; group < spans[i].groups && least > 0; ++group) {
      const double time = time_of_group(g, spans[i], group, part, enough);
      least = time < least ? time : least;
    }
  for (Index i = 0; i < link_count && least > 0; ++i) {
    const double time = time_of_link(g, links[i], part);
    least = time < least ? time : least;
  }
  return least;
}

inline void read(const double* from, double& to) { to = *from; }
inline void write(double* to, double from) { *to = from; }
inline void read(const double* from, Eight& to) { __builtin_memcpy(to.part, from, sizeof to.part); }
inline void write(double* to, const Eight& from) { __builtin_memcpy(to, from.part, sizeof from.part); }

// One number or eight: of as many nodes, along one axis.
template <class Number>
struct Axis {
  Number x, v, pull, dt;

  void begin(const double* place, const double* speed, double gain, double step) {
    read(place, x);
    read(speed, v);
    pull = Number(gain), dt = Number(step);
  }
  template <bool gravity>
  void step() {
    if (gravity) v = v + pull;
    x = x + dt * v;
  }
  void end(double* place, double* speed) const {
    write(place, x);
    write(speed, v);
  }
};

template <bool gravity, class Number>
inline void fly(const NodeArguments& g, std::ptrdiff_t i, Index steps) {
  Axis<Number> x, y, z;
  x.begin(g.x + i, g.vx + i, g.gravity[0], g.dt);
  y.begin(g.y + i, g.vy + i, g.gravity[1], g.dt);
  z.begin(g.z + i, g.vz + i, g.gravity[2], g.dt);
  for (Index s = 0; s < steps; ++s) {
    x.template step<gravity>();
    y.template step<gravity>();
    z.template step<gravity>();
  }
  x.end(g.x + i, g.vx + i);
  y.end(g.y + i, g.vy + i);
  z.end(g.z + i, g.vz + i);
}

template <bool gravity>
void fly_freely(const NodeArguments& g, Index nodes, Index steps) {
  std::ptrdiff_t i = 0;
  for (; i + lanes <= nodes; i += lanes) fly<gravity, Eight>(g, i, steps);
  for (; i < nodes; ++i) fly<gravity, double>(g, i, steps);
}

}  // namespace

void fill_free_flight(KernelTable& table) {
  table.time_to_pull = time_to_pull;
  table.fly_freely[0] = fly_freely<false>;
  table.fly_freely[1] = fly_freely<true>;
}

}  // namespace cinch::CINCH_ISA
