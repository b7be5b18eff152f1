// What happens at the closing time (paper Secs. 2 and 5.3): closing threads appear where they lie, masses
// separate.
#pragma once
#include "store/state.hpp"

namespace cinch {

/// The state of the whole scene from that before closing: nodes of closing threads lie on their carriers,
/// x = (1 - s) x_a + s x_b + offset, and move with them, v = (1 - s) v_a + s v_b. Where their masses lay on
/// the carrier in other shares than these, all of a thread's nodes but its ends take the same velocity
/// besides, that keeps linear momentum exact. The kinetic energy it costs is about m dv^2 / 12 an element,
/// and what that velocity does. Threads that slide through rings already go on where they are.
State lay_closing_threads(const Model& model_before, const Model& model_after, const Assembly& assembly,
                          const State& before);

/// Adds the separation velocities of split masses (and recoils of launchers whose masses do not balance).
void separate(const Assembly& assembly, State& state);

/// Takes from fixed and guided nodes the velocity that their support does not allow: a closing thread's end
/// that is fixed from the closing time on stops there.
void hold_supports(const Model& model, State& state);

}  // namespace cinch
