// What a run whose energy or speeds go wrong says: the node at fault, the time, the likely cause.
#pragma once
#include "plan/preparation.hpp"
#include "store/state.hpp"

namespace cinch {

/// Energies below are rounding, J: in a scene that has next to none, shares say nothing.
inline constexpr double least_energy = 1e-12;

struct Fastest {
  Index node;
  double speed;  ///< m/s
};

/// The node with the greatest speed, or the first without a finite one.
Fastest fastest_node(const State& state);

/// Throws NumericalError when more energy has come from nowhere, or gone there, than `limit` times `scale`
/// (J).
void check_energy(const Preparation& preparation, const Phase& phase, const State& state, double residual,
                  double scale, double limit);

/// True if the speed of every node is finite and within `speed_limit` (m/s).
bool speeds_allowed(const State& state, double speed_limit);

/// Throws NumericalError that names the first node without a finite speed, else the fastest.
[[noreturn]] void report_runaway(const Preparation& preparation, const Phase& phase, const State& state,
                                 double speed_limit);

}  // namespace cinch
