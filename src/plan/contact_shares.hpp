// Which of the broadphase's pairs each thread evaluates, and who books what they do.
#pragma once
#include "plan/contact_list.hpp"
#include "plan/piece.hpp"

namespace cinch {

/// All pairs, in the user's numbers.
LocalContacts all_contacts(const Model& model, const ContactList& list, State& state);

/// The pairs and joints that put a force on a node of piece `number`, in its numbers; the piece gets the
/// ghosts that they need. A ring is booked by the owner of its host's first node, a pair with a ball by that
/// of its first end.
void hand_out(const Model& model, const ContactList& list, State& state, const std::vector<int>& owner,
              int number, const std::vector<double>& node_share, Piece& piece);

/// Rings without pairs touch nothing.
void release_lonely_rings(const Model& model, const ContactList& list, State& state);

}  // namespace cinch
