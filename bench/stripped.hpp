// Programs stripped by hand: they step a net without contacts and hold nothing for features that it lacks.
// What absent features cost the solver is judged against them.
//
// Structure (blocks, spans, stretches), laws and compiler flags are the solver's: its own kernels,
// instantiated and called directly. Without: the stage clock, threads and their meetings, the plan's choices,
// the table of kernels, looks at speeds, supports, contacts.
#pragma once
#include <cstdint>

#include "kernels/arguments.hpp"

namespace cinch::bench {

/// What one block of nodes computes and moves, as stretches of the lists below.
struct StrippedBlock {
  Index patch_begin, patch_end, span_begin, neighbour_begin, span_end, stretch_begin, chain_stretch_end,
      stretch_end;
};

struct StrippedScene {
  kernel::AxialArguments axial;
  kernel::NodeArguments node;
  const StrippedBlock* blocks;
  Index block_count;
  const kernel::Patch* patches;
  const kernel::Span* spans;
  const kernel::Stretch* stretches;
};

/// Steps a scene. One program for each combination of features: [damping][ledger][gravity].
struct StrippedPrograms {
  void (*advance[2][2][2])(const StrippedScene&, std::int64_t steps);
};

/// Those of the instruction set that the solver has chosen.
const StrippedPrograms& stripped_programs();

}  // namespace cinch::bench
