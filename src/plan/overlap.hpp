// Contacts that overlap where they begin, before anything has moved: at t = 0, or when closing threads are
// laid.
#pragma once
#include <optional>
#include <string>

#include "plan/contact_list.hpp"
#include "plan/preparation.hpp"

namespace cinch {

/// The deepest of those that begin together.
struct Overlap {
  kernel::Pair pair{};
  bool ring = false;      ///< with a ring; else with a target
  double depth = 0;       ///< m
  std::int64_t step = 0;  ///< where they begin
  double share = 0;       ///< of the energy that the scene then holds, gravity's apart: what they all hold
};

/// From this share on they decide how the motion begins.
inline constexpr double great_overlap = 0.1;

/// Among the pairs of elements from `first` on (masses, too, where it is 0).
std::optional<Overlap> find_overlap(const Model& model, const State& state, const ContactList& contacts,
                                    Index first);

/// "element 3 of thread.main (nodes 3 and 4) lies 0.002 m deep in ring 'r1'".
std::string describe(const Preparation& preparation, const Overlap& overlap);

/// Throws NumericalError for the fault `what` that the overlap led to.
[[noreturn]] void report_overlap(const Preparation& preparation, const Overlap& overlap,
                                 const std::string& what);

}  // namespace cinch
