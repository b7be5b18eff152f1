// Compiled once for each instruction set, as the kernels are; their files are taken in so that they can be
// inlined.
#include "kernels/axial_force.cpp"
#include "kernels/node_update.cpp"
#include "stripped.hpp"

namespace cinch::CINCH_ISA {

void fill_stripped(bench::StrippedPrograms& programs);

namespace {

template <bool damped, bool ledger, bool gravity>
void advance(const bench::StrippedScene& s, std::int64_t steps) {
  constexpr Book::Sum book = damped && ledger ? Book::power : Book::nothing;
  for (std::int64_t step = 0; step < steps; ++step)
    for (Index i = 0; i < s.block_count; ++i) {
      const bench::StrippedBlock& b = s.blocks[i];
      patch_forces(s.axial, s.patches, b.patch_begin, b.patch_end);
      axial_spans<damped, book>(s.axial, s.spans, b.span_begin, b.span_end);
      move_nodes<gravity, kernel::Moving::blind>(s.node, s.stretches, b.stretch_begin, b.stretch_end);
    }
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
