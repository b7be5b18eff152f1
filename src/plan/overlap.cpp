#include "plan/overlap.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "plan/contact_health.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

std::optional<Overlap> find_overlap(const Model& model, const State& state, const ContactList& contacts,
                                    Index first) {
  if (contacts.pairs.empty()) return std::nullopt;
  Overlap deepest;
  const Index rings = contacts.ball_begin.front();
  for (Index i = 0; i < static_cast<Index>(contacts.pairs.size()); ++i) {
    const kernel::Pair& pair = contacts.pairs[at(i)];
    if (first > 0 && pair.element < first) continue;
    const double distance =
        i < rings ? distance_to_ring(state, pair, model.rings[at(pair.with)])
                  : distance_to_element(state, pair.a, pair.b, model.balls[at(pair.with)].center);
    const double depth = pair.contact_distance - distance;
    if (depth > deepest.depth) deepest = {pair, i < rings, depth, state.step, 0};
  }
  if (deepest.depth > 0) return deepest;
  return std::nullopt;
}

std::string describe(const Preparation& preparation, const Overlap& overlap) {
  char depth[48];
  std::snprintf(depth, sizeof depth, " lies %.3g m deep in ", overlap.depth);
  return item_label(preparation, overlap.pair.element) + depth +
         partner_label(preparation, overlap.ring, at(overlap.pair.with));
}

void report_overlap(const Preparation& preparation, const Overlap& overlap, const std::string& what) {
  const std::string prefix = "error: ";
  const std::size_t begin = what.starts_with(prefix) ? prefix.size() : 0;
  char time[64];
  std::snprintf(time, sizeof time, "error: at t = %.9g s ",
                static_cast<double>(overlap.step) * preparation.dt);
  throw NumericalError(
      time + describe(preparation, overlap) + "; likely cause: an overlap at the start" +
      (overlap.step > 0 ? " of closing" : "") +
      ", before anything has moved; place them apart, or make them smaller; what it led to: " +
      what.substr(begin, what.find("; likely cause") - begin));
}

}  // namespace cinch
