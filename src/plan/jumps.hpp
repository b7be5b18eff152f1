// Steps so long, or threads so fast, that contact could be missed: a thread on one side of a ring's wire at a
// step and on the other side at the next.
#pragma once
#include <optional>

#include "plan/contact_list.hpp"

namespace cinch {

struct Jump {
  kernel::Pair pair;
  bool ring;      ///< the pair is one with a ring, else with a ball
  double motion;  ///< m, in one step
};

/// Of the pair's element from the wire's centre line, m.
double distance_to_ring(const State& state, const kernel::Pair& pair, const kernel::RingGeometry& ring);

/// The first pair that came closer by more than jump_share of its contact distance in the step that led to
/// `state`, and was near enough to touch on its way. Motion along the thread itself does not count.
std::optional<Jump> find_jump(const Model& model, const State& state, const ContactList& contacts, double dt);

}  // namespace cinch
