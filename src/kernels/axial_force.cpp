// Element forces, group by group and link by link; the law stands in axial_law.hpp.
#include <cstddef>

#include "kernels/axial_law.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::Book;
using kernel::lanes;
using kernel::Link;
using kernel::Patch;
using kernel::Span;

// The lower ends of a span's elements and where their forces go. As few addresses as possible: they shall
// stay in registers.
struct SpanView {
  const double* __restrict x, * __restrict y, * __restrict z, * __restrict u, * __restrict v, * __restrict w;
  double* __restrict fx, * __restrict fy, * __restrict fz;
  const Index* __restrict parameter;
  const double* __restrict palette;
  std::ptrdiff_t step;
};

inline SpanView view(const AxialArguments& g, const Span& s) {
  return {g.x + s.node,  g.y + s.node,   g.z + s.node,   g.vx + s.node,  g.vy + s.node,
          g.vz + s.node, g.fx + s.force, g.fy + s.force, g.fz + s.force, g.parameter + s.parameter,
          g.palette,     s.step};
}

// One group of elements; adds what is booked to `sums`, lane by lane, so that the bits are the same for every
// vector width. In a chain each upper end is the next lower one.
template <bool damped, Book::Sum book, bool chain>
inline void group(const SpanView& s, std::ptrdiff_t number, double* __restrict sums) {
  const double* __restrict const row =
      s.palette + 3 * lanes * static_cast<std::ptrdiff_t>(s.parameter[number]);
  const std::ptrdiff_t first = number * lanes, step = chain ? 1 : s.step;
#pragma omp simd
  for (std::ptrdiff_t lane = 0; lane < lanes; ++lane) {
    const std::ptrdiff_t i = first + lane, j = i + step;
    const double rx = s.x[j] - s.x[i], ry = s.y[j] - s.y[i], rz = s.z[j] - s.z[i];
    const double rr = rx * rx + ry * ry + rz * rz;
    const double rv = damped ? rx * (s.u[j] - s.u[i]) + ry * (s.v[j] - s.v[i]) + rz * (s.w[j] - s.w[i]) : 0.0;
    const Axial item = axial_law(rr, rv, row[lane], damped ? row[lanes + lane] : 0.0, row[2 * lanes + lane]);
    s.fx[i] = item.per_length * rx;
    s.fy[i] = item.per_length * ry;
    s.fz[i] = item.per_length * rz;
    if (book == Book::power) sums[lane] += item.power;
    if (book == Book::energy) sums[lane] += item.energy;
  }
}

template <bool damped, bool chain>
inline void groups(const SpanView& s, const Span& span) {
  for (std::ptrdiff_t i = 0; i < span.groups; ++i) group<damped, Book::nothing, chain>(s, i, nullptr);
}

// The same with sums added to the rows of the ledger.
template <bool damped, Book::Sum book, bool chain>
inline void booked_groups(const SpanView& s, const Span& span, double* booked) {
  constexpr Index row_groups = kernel::grain / lanes;
  const Index first = span.row_node / lanes;  // number of the first group in the whole scene
  for (Index i = 0; i < span.groups;) {
    const Index row_number = (first + i) / row_groups;
    const Index row_end = (row_number + 1) * row_groups - first;
    const Index end = row_end < span.groups ? row_end : span.groups;
    double* __restrict const row = booked + row_number * lanes;
    alignas(64) double sums[lanes];
    for (Index lane = 0; lane < lanes; ++lane) sums[lane] = row[lane];
    for (; i < end; ++i) group<damped, book, chain>(s, i, sums);
    for (Index lane = 0; lane < lanes; ++lane) row[lane] = sums[lane];
  }
}

template <bool damped, Book::Sum book, bool chain>
inline void compute(const AxialArguments& g, const Span& span) {
  if (book != Book::nothing && span.row_node >= 0)
    booked_groups<damped, book, chain>(view(g, span), span, g.booked);
  else groups<damped, chain>(view(g, span), span);
}

template <bool damped, Book::Sum book>
void axial_spans(const AxialArguments& g, const Span* spans, Index begin, Index end) {
  for (Index i = begin; i < end; ++i)
    spans[i].step == 1 ? compute<damped, book, true>(g, spans[i]) : compute<damped, book, false>(g, spans[i]);
}

template <bool damped, Book::Sum book>
void axial_links(const AxialArguments& g, const Link* links, Index begin, Index end) {
  for (Index i = begin; i < end; ++i) {
    const Link& l = links[i];
    const V3 r{g.x[l.b] - g.x[l.a], g.y[l.b] - g.y[l.a], g.z[l.b] - g.z[l.a]};
    const V3 v{g.vx[l.b] - g.vx[l.a], g.vy[l.b] - g.vy[l.a], g.vz[l.b] - g.vz[l.a]};
    const Axial item =
        axial_law(dot(r, r), damped ? dot(r, v) : 0.0, l.stiffness, damped ? l.damping : 0.0, l.rest_length);
    g.fx[l.force] = item.per_length * r.x;
    g.fy[l.force] = item.per_length * r.y;
    g.fz[l.force] = item.per_length * r.z;
    if (book != Book::nothing && l.row >= 0)
      g.booked[l.row * lanes] += book == Book::power ? item.power : item.energy;
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
  table.patch_forces = patch_forces;
}

}  // namespace cinch::CINCH_ISA
