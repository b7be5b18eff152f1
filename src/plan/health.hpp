// What a run that goes wrong says: the contact, element or node at fault, the time, the likely cause.
#pragma once
#include "plan/jumps.hpp"
#include "plan/preparation.hpp"
#include "plan/threading_watch.hpp"

namespace cinch {

/// Energies below are rounding, J: in a scene that has next to none, shares say nothing.
inline constexpr double least_energy = 1e-12;

/// Throws NumericalError when a contact has needed more than the elements leave of the stable step: it would
/// grow without bound; and for one that is about to be pressed through what it touches.
void check_contacts(const Preparation& preparation, const Model& model, const State& state);

/// Throws NumericalError when more energy has come from nowhere, or gone there, than `limit` times `scale`
/// (J).
void check_energy(const Preparation& preparation, const Model& model, const State& state, double residual,
                  double scale, double limit);

/// Throws NumericalError when the contacts of a ring or target hold less than nothing, or when their damping
/// has given energy in place of taking it: more than `limit` times `scale` (J). The residual shows neither,
/// as both are booked.
void check_contact_energy(const Preparation& preparation, const State& state, double scale, double limit);

/// A contact deeper than this share of its distance is as good as through the wire.
inline constexpr double pressed_share = 0.7;

/// Throws NumericalError for the jump that ended the last step.
[[noreturn]] void report_jump(const Preparation& preparation, const State& state, const Jump& jump);

/// Throws NumericalError for a thread that has left a ring.
[[noreturn]] void report_loss(const Preparation& preparation, const Look& now,
                              const ThreadingWatch::Loss& loss);

/// True if the speed of every node is finite and within `speed_limit` (m/s).
bool speeds_allowed(const State& state, double speed_limit);

/// Throws NumericalError that names the first node without a finite speed, else the fastest.
[[noreturn]] void report_runaway(const Preparation& preparation, const Model& model, const State& state,
                                 double speed_limit);

}  // namespace cinch
