// Compiled once for each instruction set, as the kernels are; their files are taken in so that they can be
// inlined.
#include "kernels/axial_force.cpp"
#ifdef __AVX512F__
#include "kernels/chain_update.cpp"
#endif
#include "kernels/node_update.cpp"
#include "stripped.hpp"

namespace cinch::CINCH_ISA {

void fill_stripped(bench::StrippedPrograms& programs);

namespace {

constexpr kernel::Moving::Kind blind = kernel::Moving::blind;

// Elements of a block, and its nodes: where chains are moved in the pass that computes them, with that.
template <bool damped, Book::Sum book, bool gravity>
inline void step_block(const bench::StrippedScene& s, const bench::StrippedBlock& b) {
  patch_forces(s.axial, s.patches, b.patch_begin, b.patch_end);
#ifdef __AVX512F__
  axial_spans<damped, book>(s.axial, s.spans, b.span_begin, b.neighbour_begin);
  for (Index i = b.neighbour_begin; i < b.span_end; ++i) {
    const kernel::Span& span = s.spans[i];
    if (span.stretch < 0) axial_spans<damped, book>(s.axial, s.spans, i, i + 1);
    else
      update_chain<damped, book == Book::power, gravity, blind>(s.axial, s.node, span,
                                                                s.stretches[span.stretch]);
  }
  move_nodes<gravity, blind>(s.node, s.stretches, b.chain_stretch_end, b.stretch_end);
#else
  axial_spans<damped, book>(s.axial, s.spans, b.span_begin, b.span_end);
  move_nodes<gravity, blind>(s.node, s.stretches, b.stretch_begin, b.stretch_end);
#endif
}

template <bool damped, bool ledger, bool gravity>
void advance(const bench::StrippedScene& s, std::int64_t steps) {
  constexpr Book::Sum book = damped && ledger ? Book::power : Book::nothing;
  for (std::int64_t step = 0; step < steps; ++step)
    for (Index i = 0; i < s.block_count; ++i) step_block<damped, book, gravity>(s, s.blocks[i]);
}

template <bool damped, bool ledger>
void fill_both(bench::StrippedPrograms& programs) {
  programs.advance[damped][ledger][0] = advance<damped, ledger, false>;
  programs.advance[damped][ledger][1] = advance<damped, ledger, true>;
}

}  // namespace

void fill_stripped(bench::StrippedPrograms& programs) {
  fill_both<false, false>(programs);
  fill_both<false, true>(programs);
  fill_both<true, false>(programs);
  fill_both<true, true>(programs);
}

}  // namespace cinch::CINCH_ISA
