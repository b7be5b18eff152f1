// What a checkpoint holds of a state: all of it, by the table of node fields and by what tallies have felt.
#pragma once
#include "base/archive.hpp"
#include "store/state.hpp"

namespace cinch {

/// Saves `state`, or restores one of `model` in its place (made for it already). Throws FileError for what
/// does not belong to the model or is not finite.
void transfer(Archive& archive, State& state, const Model& model);

}  // namespace cinch
