// Element forces, group by group and link by link; the law stands in axial_law.hpp.
#include <cstddef>

#include "kernels/axial_law.hpp"
#ifdef __AVX512F__
#include "kernels/axial_lanes.hpp"
#endif
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::Book;
using kernel::lanes;
using kernel::Link;
using kernel::Patch;
using kernel::Span;

constexpr bool with_energy(Book::Sum book) { return book == Book::energy || book == Book::energy_and_power; }
constexpr bool with_power(Book::Sum book) { return book == Book::power || book == Book::energy_and_power; }

// The lower ends of a span's elements and where their forces go. As few addresses as possible: they shall
// stay in registers.
struct SpanView {
  const double* __restrict x, * __restrict y, * __restrict z, * __restrict u, * __restrict v, * __restrict w;
  double* __restrict fx, * __restrict fy, * __restrict fz;
  const Index* __restrict parameter;
  const double* __restrict palette;
  double* __restrict damper;
  std::ptrdiff_t step;
  double dt;
};

inline SpanView view(const AxialArguments& g, const Span& s, bool power) {
  return {g.x + s.node,   g.y + s.node,
          g.z + s.node,   g.vx + s.node,
          g.vy + s.node,  g.vz + s.node,
          g.fx + s.force, g.fy + s.force,
          g.fz + s.force, g.parameter + s.parameter,
          g.palette,      power ? g.damper + s.parameter * lanes : nullptr,
          s.step,         g.dt};
}

// What is summed up goes lane by lane, so that the bits are the same for every vector width.
#ifdef __AVX512F__
struct Sums {
  Group energy, power;
};
CINCH_INLINE void read(const double* from, Group& to) { to = load(from); }
CINCH_INLINE void write(double* to, Group from) { store(to, from); }

CINCH_INLINE Nodes nodes(const SpanView& s, std::ptrdiff_t i) {
  return {load(s.x + i), load(s.y + i), load(s.z + i), load(s.u + i), load(s.v + i), load(s.w + i)};
}

// One group. In a chain each upper end is the next lower one.
template <bool damped, Book::Sum book, bool chain>
CINCH_INLINE void group(const SpanView& s, std::ptrdiff_t number, Sums& sums) {
  const std::ptrdiff_t i = number * lanes;
  const double* const row = s.palette + 3 * lanes * static_cast<std::ptrdiff_t>(s.parameter[number]);
  const Taut item = taut(relative(nodes(s, i), nodes(s, i + (chain ? 1 : s.step))), row);
  const Forces f = force<damped, with_power(book), book == Book::power>(
      item, row, _mm512_set1_pd(s.dt), with_power(book) ? s.damper + i : nullptr, sums.power);
  store(s.fx + i, f.x), store(s.fy + i, f.y), store(s.fz + i, f.z);
  if (with_energy(book)) sums.energy += _mm512_set1_pd(0.5) * load(row) * item.stretch * item.stretch;
}
#else
struct Sums {
  alignas(64) double energy[lanes], power[lanes];
};
inline void read(const double* from, double (&to)[lanes]) {
  for (Index lane = 0; lane < lanes; ++lane) to[lane] = from[lane];
}
inline void write(double* to, const double (&from)[lanes]) {
  for (Index lane = 0; lane < lanes; ++lane) to[lane] = from[lane];
}

// The forces of one group, and what belongs into its sums. In a chain each upper end is the next lower one.
// Returns whether elements of it turn taut or slack.
template <bool damped, bool chain, bool switching>
inline bool forces_of_group(const SpanView& s, std::ptrdiff_t number, Sums& energy_and_rate,
                            double* __restrict damper) {
  const double* __restrict const row =
      s.palette + 3 * lanes * static_cast<std::ptrdiff_t>(s.parameter[number]);
  const std::ptrdiff_t first = number * lanes, step = chain ? 1 : s.step;
  double spare = 0;
#pragma omp simd reduction(min : spare)
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t i = first + lane, j = i + step;
    const double rx = s.x[j] - s.x[i], ry = s.y[j] - s.y[i], rz = s.z[j] - s.z[i];
    const double rr = rx * rx + ry * ry + rz * rz;
    const double rv = rx * (s.u[j] - s.u[i]) + ry * (s.v[j] - s.v[i]) + rz * (s.w[j] - s.w[i]);
    const Axial item = axial_law<switching>(rr, rv, row[lane], damped ? row[lanes + lane] : 0.0,
                                            row[2 * lanes + lane], s.dt);
    s.fx[i] = item.per_length * rx;
    s.fy[i] = item.per_length * ry;
    s.fz[i] = item.per_length * rz;
    energy_and_rate.energy[lane] = item.energy;
    energy_and_rate.power[lane] = item.rate;
    damper[lane] = item.damper;
    spare = item.spare < spare ? item.spare : spare;
  }
  return spare < 0;
}

// Elements that turn taut or slack are few and cost a division: a group that has some is computed anew.
template <bool damped, Book::Sum book, bool chain>
inline void group(const SpanView& s, std::ptrdiff_t number, Sums& sums) {
  Sums item;
  alignas(64) double damper[lanes];
  if (forces_of_group<damped, chain, false>(s, number, item, damper)) [[unlikely]]
    forces_of_group<damped, chain, true>(s, number, item, damper);
  double* __restrict const before = with_power(book) ? s.damper + number * lanes : nullptr;
#pragma omp simd
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    if (with_energy(book)) sums.energy[lane] += item.energy[lane];
    if (with_power(book)) sums.power[lane] += 0.5 * (damper[lane] + before[lane]) * item.power[lane];
    if (book == Book::power) before[lane] = damper[lane];
  }
}
#endif

template <bool damped, bool chain>
inline void groups(const SpanView& s, const Span& span) {
  Sums none;
  for (std::ptrdiff_t i = 0; i < span.groups; ++i) group<damped, Book::nothing, chain>(s, i, none);
}

// Row after row of the ledger, whose numbers begin as what is there.
template <Book::Sum book>
inline void open_row(const AxialArguments& g, Index row, Sums& sums) {
  if (with_energy(book)) read(g.booked + row * lanes, sums.energy);
  if (with_power(book)) read((with_energy(book) ? g.due : g.booked) + row * lanes, sums.power);
}
template <Book::Sum book>
inline void close_row(const AxialArguments& g, Index row, const Sums& sums) {
  if (with_energy(book)) write(g.booked + row * lanes, sums.energy);
  if (with_power(book)) write((with_energy(book) ? g.due : g.booked) + row * lanes, sums.power);
}

// The same with sums added to the rows of the ledger.
template <bool damped, Book::Sum book, bool chain>
inline void booked_groups(const AxialArguments& g, const Span& span) {
  const SpanView s = view(g, span, with_power(book));
  constexpr Index row_groups = kernel::grain / lanes;
  const Index first = span.row_node / lanes;  // number of the first group in the whole scene
  for (Index i = 0; i < span.groups;) {
    const Index row = (first + i) / row_groups;
    const Index row_end = (row + 1) * row_groups - first;
    const Index end = row_end < span.groups ? row_end : span.groups;
    Sums sums;
    open_row<book>(g, row, sums);
    for (; i < end; ++i) group<damped, book, chain>(s, i, sums);
    close_row<book>(g, row, sums);
  }
}

template <bool damped, Book::Sum book, bool chain>
inline void compute(const AxialArguments& g, const Span& span) {
  if (book != Book::nothing && span.row_node >= 0) booked_groups<damped, book, chain>(g, span);
  else groups<damped, chain>(view(g, span, false), span);
}

template <bool damped, Book::Sum book>
void axial_spans(const AxialArguments& g, const Span* spans, Index begin, Index end) {
  for (Index i = begin; i < end; ++i)
    spans[i].step == 1 ? compute<damped, book, true>(g, spans[i]) : compute<damped, book, false>(g, spans[i]);
}

template <Book::Sum book>
inline void book_link(const AxialArguments& g, const Link& l, const Axial& item, double& before) {
  double& row = g.booked[l.row * lanes];
  if (with_energy(book)) row += item.energy;
  if (!with_power(book)) return;
  (book == Book::power ? row : g.due[l.row * lanes]) += 0.5 * (item.damper + before) * item.rate;
  if (book == Book::power) before = item.damper;
}

template <bool damped, Book::Sum book>
void axial_links(const AxialArguments& g, const Link* links, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) {
    const Link& l = links[i];
    const V3 r{g.x[l.b] - g.x[l.a], g.y[l.b] - g.y[l.a], g.z[l.b] - g.z[l.a]};
    const V3 v{g.vx[l.b] - g.vx[l.a], g.vy[l.b] - g.vy[l.a], g.vz[l.b] - g.vz[l.a]};
    const Axial item =
        axial_law(dot(r, r), dot(r, v), l.stiffness, damped ? l.damping : 0.0, l.rest_length, g.dt);
    g.fx[l.force] = item.per_length * r.x;
    g.fy[l.force] = item.per_length * r.y;
    g.fz[l.force] = item.per_length * r.z;
    if (book != Book::nothing && l.row >= 0) book_link<book>(g, l, item, g.link_damper[i]);
  }
}

inline void patch(double* force, const Patch& p) {
  double* const to = force + p.to;
  if (p.from < 0)
    for (Index k = 0; k < p.count; ++k) to[k] = 0;
  else
    for (Index k = 0; k < p.count; ++k) to[k] = force[p.from + k];
}

void patch_forces(const AxialArguments& g, const Patch* patches, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) {
    const Patch& p = patches[i];
    if (p.count == 1 && p.from >= 0) {  // a chain goes on
      g.fx[p.to] = g.fx[p.from], g.fy[p.to] = g.fy[p.from], g.fz[p.to] = g.fz[p.from];
      continue;
    }
    patch(g.fx, p), patch(g.fy, p), patch(g.fz, p);
  }
}

template <bool damped, Book::Sum book>
void fill(KernelTable& table) {
  table.axial_spans[damped][book] = axial_spans<damped, book>;
  table.axial_links[damped][book] = axial_links<damped, book>;
}

}  // namespace

void fill_axial(KernelTable& table) {
  fill<false, Book::nothing>(table);
  fill<false, Book::energy>(table);
  fill<true, Book::nothing>(table);
  fill<true, Book::power>(table);
  fill<true, Book::energy>(table);
  fill<true, Book::energy_and_power>(table);
  table.patch_forces = patch_forces;
}

}  // namespace cinch::CINCH_ISA
