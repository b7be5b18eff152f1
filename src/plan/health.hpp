// What a run that goes wrong says: the contact, element or node at fault, the time, the likely cause.
#pragma once
#include "plan/preparation.hpp"
#include "store/state.hpp"

namespace cinch {

/// Throws NumericalError when a contact has needed more than the elements leave of the stable step: it would
/// grow without bound.
void check_contacts(const Preparation& preparation, const State& state);

/// Throws NumericalError when more energy has come from nowhere, or gone there, than `limit` times `scale`
/// (J).
void check_energy(const Preparation& preparation, const Model& model, const State& state, double residual,
                  double scale, double limit);

/// True if the speed of every node is finite and within `speed_limit` (m/s).
bool speeds_allowed(const State& state, double speed_limit);

/// Throws NumericalError that names the first node without a finite speed, else the fastest.
[[noreturn]] void report_runaway(const Preparation& preparation, const Model& model, const State& state,
                                 double speed_limit);

}  // namespace cinch
