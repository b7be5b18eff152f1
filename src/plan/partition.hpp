// Shares a scene out among threads: whole grains of nodes, so that ledger rows have one writer.
#pragma once
#include <vector>

#include "plan/contact_list.hpp"

namespace cinch {

/// The nodes of each of `pieces` shares, ascending; some may be empty. Of several ways to cut the scene into
/// stretches of equal cost (along its numbering and along each axis, as it lies now) takes the one that makes
/// threads compute the least twice. `contacts` may be empty. Results of a run do not depend on it, only its
/// speed does.
std::vector<std::vector<Index>> partition(const Model& model, const State& state, const ContactList& contacts,
                                          int pieces);

}  // namespace cinch
