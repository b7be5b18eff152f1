// Shares a scene out among threads: whole grains of nodes, so that ledger rows have one writer.
#pragma once
#include <vector>

#include "plan/contact_list.hpp"

namespace cinch {

/// The nodes of each of `pieces` shares, ascending; some may be empty. Cuts the scene into two of equal cost,
/// these again and so on, each time along its numbering or across one of the axes, as it lies now: whichever
/// makes threads need the least of each other. `contacts` may be empty. Results of a run do not depend on it,
/// only its speed does.
std::vector<std::vector<Index>> partition(const Model& model, const State& state, const ContactList& contacts,
                                          int pieces);

}  // namespace cinch
