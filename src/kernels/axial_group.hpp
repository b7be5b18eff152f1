// One group of elements: their forces, and what the ledger takes of them. In a chain each upper end is the
// next lower one. By hand for AVX-512 (axial_lanes.hpp), else as the compiler makes it of axial_law.hpp; what
// is summed up goes lane by lane, so that the bits are the same for every vector width.
#pragma once
#include <cstddef>

#include "kernels/arguments.hpp"
#include "kernels/axial_law.hpp"
#ifdef __AVX512F__
#include "kernels/axial_lanes.hpp"
#endif

namespace cinch::CINCH_ISA {

using kernel::Book;
using kernel::lanes;

/// What a kernel adds up, see kernel::Book.
constexpr bool with_energy(Book::Sum book) { return book == Book::energy || book == Book::energy_and_power; }
constexpr bool with_power(Book::Sum book) { return book == Book::power || book == Book::energy_and_power; }

/// The lower ends of a span's elements and where their forces go. As few addresses as possible: they shall
/// stay in registers.
struct SpanView {
  const double* __restrict x, * __restrict y, * __restrict z, * __restrict u, * __restrict v, * __restrict w;
  double* __restrict fx, * __restrict fy, * __restrict fz;
  const Index* __restrict parameter;
  const double* __restrict palette;
  double* __restrict damper;
  std::ptrdiff_t step;
  double dt;
};

inline SpanView view(const kernel::AxialArguments& g, const kernel::Span& s, bool power) {
  return {g.x + s.node,   g.y + s.node,
          g.z + s.node,   g.vx + s.node,
          g.vy + s.node,  g.vz + s.node,
          g.fx + s.force, g.fy + s.force,
          g.fz + s.force, g.parameter + s.parameter,
          g.palette,      power ? g.damper + s.parameter * lanes : nullptr,
          s.step,         g.dt};
}

#ifdef __AVX512F__
/// Of a row of the ledger, lane by lane.
struct Sums {
  Group energy, power;
};
CINCH_INLINE void read(const double* from, Group& to) { to = load(from); }
CINCH_INLINE void write(double* to, Group from) { store(to, from); }

CINCH_INLINE Nodes nodes(const SpanView& s, std::ptrdiff_t i) {
  return {load(s.x + i), load(s.y + i), load(s.z + i), load(s.u + i), load(s.v + i), load(s.w + i)};
}

template <bool damped, Book::Sum book, bool chain>
CINCH_INLINE void group(const SpanView& s, std::ptrdiff_t number, Sums& sums) {
  const std::ptrdiff_t i = number * lanes;
  const double* const row =
      s.palette + kernel::palette_fields * lanes * static_cast<std::ptrdiff_t>(s.parameter[number]);
  double* const damper = with_power(book) ? s.damper + i : nullptr;
  const Nodes a = nodes(s, i), b = nodes(s, i + (chain ? 1 : s.step));
  const Axes apart{b.x - a.x, b.y - a.y, b.z - a.z};
  if (idle(apart, row, damper)) {
    const Forces none = no_pull(apart);
    store(s.fx + i, none.x), store(s.fy + i, none.y), store(s.fz + i, none.z);
    return;
  }
  const Taut item = taut(relative(a, b), row);
  const Forces f = force<damped, with_power(book), book == Book::power>(item, row, _mm512_set1_pd(s.dt),
                                                                        damper, sums.power);
  store(s.fx + i, f.x), store(s.fy + i, f.y), store(s.fz + i, f.z);
  if (with_energy(book)) sums.energy += _mm512_set1_pd(0.5) * load(row) * item.stretch * item.stretch;
}
#else
/// A row of the ledger itself, lane by lane: groups add to it in place.
struct Sums {
  double *energy, *power;
};
inline void read(double* from, double*& to) { to = from; }
inline void write(double*, double*) {}

/// What a group gives besides its forces, see Axial.
struct GroupItems {
  alignas(64) double rate[lanes], damper[lanes], energy[lanes];
};

/// The forces of one group; returns whether elements of it may turn taut or slack.
template <bool damped, bool chain, bool switching>
inline bool forces_of_group(const SpanView& s, std::ptrdiff_t number, GroupItems& items) {
  const double* __restrict const row =
      s.palette + kernel::palette_fields * lanes * static_cast<std::ptrdiff_t>(s.parameter[number]);
  const std::ptrdiff_t first = number * lanes, step = chain ? 1 : s.step;
  double spare = 0;
#pragma omp simd reduction(min : spare)
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t i = first + lane, j = i + step;
    const double rx = s.x[j] - s.x[i], ry = s.y[j] - s.y[i], rz = s.z[j] - s.z[i];
    const double rr = rx * rx + ry * ry + rz * rz;
    const double rv = rx * (s.u[j] - s.u[i]) + ry * (s.v[j] - s.v[i]) + rz * (s.w[j] - s.w[i]);
    const Axial item = axial_law<switching>(rr, rv, row[lane], damped ? row[lanes + lane] : 0.0,
                                            row[2 * lanes + lane], s.dt, row[3 * lanes + lane]);
    s.fx[i] = item.per_length * rx;
    s.fy[i] = item.per_length * ry;
    s.fz[i] = item.per_length * rz;
    items.rate[lane] = item.rate;
    items.damper[lane] = item.damper;
    items.energy[lane] = item.energy;
    spare = item.spare < spare ? item.spare : spare;
  }
  return spare < 0;
}

/// As axial_lanes.hpp has it: puts the forces of a group that idles, if it does.
template <bool chain>
inline bool idle(const SpanView& s, std::ptrdiff_t number, const double* damper) {
  const double* __restrict const row =
      s.palette + kernel::palette_fields * lanes * static_cast<std::ptrdiff_t>(s.parameter[number]);
  const std::ptrdiff_t first = number * lanes, step = chain ? 1 : s.step;
  double busy = 0;  // a whole number: its order does not matter
#pragma omp simd reduction(+ : busy)
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t i = first + lane, j = i + step;
    const double rx = s.x[j] - s.x[i], ry = s.y[j] - s.y[i], rz = s.z[j] - s.z[i];
    const double rest = row[2 * lanes + lane], rr = rx * rx + ry * ry + rz * rz;
    busy += rr <= rest * rest ? 0.0 : 1.0;
  }
  if (busy > 0) return false;
  if (damper) {
#pragma omp simd reduction(+ : busy)
    for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) busy += damper[lane] != 0 ? 1.0 : 0.0;
    if (busy > 0) return false;
  }
#pragma omp simd
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t i = first + lane, j = i + step;
    s.fx[i] = 0 * (s.x[j] - s.x[i]), s.fy[i] = 0 * (s.y[j] - s.y[i]), s.fz[i] = 0 * (s.z[j] - s.z[i]);
  }
  return true;
}

// Rarely needed: kept out of the way.
template <bool damped, bool chain>
[[gnu::noinline, gnu::cold]] GroupItems forces_anew(const SpanView& s, std::ptrdiff_t number) {
  GroupItems items;
  forces_of_group<damped, chain, true>(s, number, items);
  return items;
}

/// Elements that turn taut or slack are few and cost roots and divisions: a group that may have some is
/// computed anew.
template <bool damped, Book::Sum book, bool chain>
inline void group(const SpanView& s, std::ptrdiff_t number, Sums& sums) {
  if (idle<chain>(s, number, with_power(book) ? s.damper + number * lanes : nullptr)) return;
  GroupItems items;
  if (forces_of_group<damped, chain, false>(s, number, items)) [[unlikely]]
    items = forces_anew<damped, chain>(s, number);
  double* __restrict const before = with_power(book) ? s.damper + number * lanes : nullptr;
  double *const energy = sums.energy, *const power = sums.power;
#pragma omp simd
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    if (with_energy(book)) energy[lane] += items.energy[lane];
    if (with_power(book)) power[lane] += 0.5 * (items.damper[lane] + before[lane]) * items.rate[lane];
    if (book == Book::power) before[lane] = items.damper[lane];
  }
}
#endif

}  // namespace cinch::CINCH_ISA
