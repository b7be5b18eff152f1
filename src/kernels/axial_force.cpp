// Element forces, group by group and link by link; the law stands in axial_law.hpp.
#include <cstddef>

#include "kernels/axial_group.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::Book;
using kernel::lanes;
using kernel::Link;
using kernel::Patch;
using kernel::Span;

template <bool damped, bool chain>
inline void groups(const SpanView& s, const Span& span) {
  Sums none;
  for (std::ptrdiff_t i = 0; i < span.groups; ++i) group<damped, Book::nothing, chain>(s, i, none);
}

// Where a span's sums go: to rows of the ledger, one after the other, whose numbers begin as what is there.
// Addresses of its own: those in the arguments could change with each store, for all that a compiler knows.
template <Book::Sum book>
struct Rows {
  double *energy = nullptr, *power = nullptr;  // null where the kernel has none

  Rows(const AxialArguments& g, Index row) {
    if (with_energy(book)) energy = g.booked + row * lanes;
    if (with_power(book)) power = (with_energy(book) ? g.due : g.booked) + row * lanes;
  }
  void open(Sums& sums) const {
    if (with_energy(book)) read(energy, sums.energy);
    if (with_power(book)) read(power, sums.power);
  }
  void close(const Sums& sums) {
    if (with_energy(book)) write(energy, sums.energy), energy += lanes;
    if (with_power(book)) write(power, sums.power), power += lanes;
  }
};

// The same with sums added to the ledger.
template <bool damped, Book::Sum book, bool chain>
inline void booked_groups(const AxialArguments& g, const Span& span) {
  const SpanView s = view(g, span, with_power(book));
  constexpr Index row_groups = kernel::grain / lanes;
  const Index first = span.row_node / lanes;  // number of the first group in the whole scene
  Rows<book> rows(g, first / row_groups);
  for (std::ptrdiff_t i = 0, end = row_groups - first % row_groups; i < span.groups; end += row_groups) {
    if (end > span.groups) end = span.groups;
    Sums sums;
    rows.open(sums);
    for (; i < end; ++i) group<damped, book, chain>(s, i, sums);
    rows.close(sums);
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
inline void book_link(const AxialArguments& g, const Link& l, const Axial& item, Index i) {
  double& row = g.booked[l.row * lanes];
  if (with_energy(book)) row += item.energy;
  if (!with_power(book)) return;
  double& before = g.link_damper[i];  // there only where there are dampers
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
        axial_law(dot(r, r), dot(r, v), l.stiffness, damped ? l.damping : 0.0, l.rest_length, g.dt, l.give);
    g.fx[l.force] = item.per_length * r.x;
    g.fy[l.force] = item.per_length * r.y;
    g.fz[l.force] = item.per_length * r.z;
    if (book != Book::nothing && l.row >= 0) book_link<book>(g, l, item, i);
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
