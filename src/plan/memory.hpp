// What a simulation keeps in memory, summed up over the arrays that grow with the scene.
#pragma once
#include <cstddef>

#include "base/result.hpp"

namespace cinch {

struct Assembly;
struct Model;
struct Preparation;
struct State;

/// Bytes, by what they are for.
struct MemoryUse {
  std::size_t model = 0;     ///< of all phases
  std::size_t state = 0;     ///< the present one, and the last one that was found sound
  std::size_t pieces = 0;    ///< what threads step with
  std::size_t contacts = 0;  ///< boxes and pairs
  std::size_t looks = 0;     ///< forces and energies of an instant, places at the start, nets' surfaces
  std::size_t total() const { return model + state + pieces + contacts + looks; }
};

std::size_t memory_of(const Assembly& assembly);
std::size_t memory_of(const Model& model);
std::size_t memory_of(const State& state);
/// Assembly, models and state before the assembly is left behind.
std::size_t memory_at_start(const Preparation& preparation);
/// What a frame takes while it is written.
std::size_t memory_of_frame(Index nodes, Index elements);

}  // namespace cinch
