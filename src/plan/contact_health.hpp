// What a run whose contacts go wrong says: the element, the ring or target, the time, the likely cause.
#pragma once
#include "plan/jumps.hpp"
#include "plan/preparation.hpp"
#include "plan/threading_watch.hpp"

namespace cinch {

/// What touches, by the number that tallies keep: an element, or a mass as a sphere.
std::string item_label(const Preparation& preparation, Index item);

/// What it touches: "ring 'r1'" or "target 'ball'".
std::string partner_label(const Preparation& preparation, bool ring, std::size_t number);

/// Throws NumericalError when a contact has needed more than the elements leave of the stable step: it would
/// grow without bound; and for one that is about to be pressed through what it touches.
void check_contacts(const Preparation& preparation, const Phase& phase, const State& state);

/// A contact deeper than this share of its distance is as good as through the wire.
inline constexpr double pressed_share = 0.7;

/// Throws NumericalError for the jump that ended the last step.
[[noreturn]] void report_jump(const Preparation& preparation, const Phase& phase, const State& state,
                              const Jump& jump);

/// Throws NumericalError for a thread that has left a ring.
[[noreturn]] void report_loss(const Preparation& preparation, const Look& now,
                              const ThreadingWatch::Loss& loss);

}  // namespace cinch
