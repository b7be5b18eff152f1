#include "plan/overlap.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "plan/contact_health.hpp"
#include "plan/health.hpp"

namespace cinch {
namespace {

constexpr double great_share = 0.1;  ///< of the energy: from here on they decide how the motion begins
constexpr int first_looks = 3;       ///< whose faults come from there

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// "element 3 of thread.main (nodes 3 and 4) lies 0.002 m deep in ring 'r1'".
std::string describe(const Preparation& preparation, const Overlap& overlap) {
  char depth[48];
  std::snprintf(depth, sizeof depth, " lies %.3g m deep in ", overlap.depth);
  return item_label(preparation, overlap.pair.element) + depth +
         partner_label(preparation, overlap.ring, at(overlap.pair.with));
}

// Whether it is too great to begin with: it holds much of the energy, or needs a shorter step at once.
bool decides(const Overlap& overlap, const Preparation& preparation, const State& state) {
  const double begin = preparation.timeline.time_of(overlap.step);
  const auto with = at(overlap.pair.with);
  const auto at_once = [&](const auto& tally) { return tally.stiffest > 1 && tally.stiffest_time <= begin; };
  if (overlap.share >= great_share) return true;
  if (overlap.ring) return at_once(state.rings[with]);
  return std::any_of(state.balls[with].begin(), state.balls[with].end(), at_once);
}

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

void OverlapWatch::begin(const Model& model, const State& state, const ContactList& contacts, Index first,
                         double energy, const Energies& now) {
  overlap_ = find_overlap(model, state, contacts, first);
  sound_looks_ = 0;
  if (overlap_ && energy > least_energy) overlap_->share = energy / (now.kinetic + now.elastic + now.contact);
}

void OverlapWatch::transfer(Archive& archive, const Model& model) {
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (!archive.holds("overlap/is")) return;
  bool is = overlap_.has_value();
  Overlap one = overlap_.value_or(Overlap{});
  archive.flag("overlap/is", is);
  archive.flag("overlap/ring", one.ring);
  const auto partners = static_cast<std::int64_t>(one.ring ? model.rings.size() : model.balls.size());
  archive.whole("overlap/with", one.pair.with, 0, std::max<std::int64_t>(partners - 1, 0));
  archive.whole("overlap/element", one.pair.element, kernel::sphere_label(model.nodes - 1),
                std::int64_t{model.elements} - 1);
  archive.value("overlap/depth", one.depth);
  archive.value("overlap/share", one.share);
  archive.whole("overlap/step", one.step, 0, std::numeric_limits<std::int64_t>::max());
  archive.whole("overlap/sound_looks", sound_looks_, 0, most);
  if (is && partners == 0) archive.refuse("overlap/is", "tells of what the case does not have");
  overlap_ = is ? std::optional(one) : std::nullopt;
}

bool OverlapWatch::to_blame(const Preparation& preparation, const State& state) const {
  return overlap_ && sound_looks_ < first_looks && decides(*overlap_, preparation, state);
}

std::string OverlapWatch::warning(const Preparation& preparation) const {
  if (!overlap_ || overlap_->share < great_share) return "";
  char text[120];
  std::snprintf(text, sizeof text,
                " where contact begins (t = %.6g s): %.3g %% of the energy comes from overlaps",
                preparation.timeline.time_of(overlap_->step), 100 * overlap_->share);
  return describe(preparation, *overlap_) + text;
}

void OverlapWatch::report(const Preparation& preparation, const std::string& what) const {
  const std::string prefix = "error: ";
  const std::size_t begin = what.starts_with(prefix) ? prefix.size() : 0;
  char time[64];
  std::snprintf(time, sizeof time, "error: at t = %.9g s ", preparation.timeline.time_of(overlap_->step));
  throw NumericalError(
      time + describe(preparation, *overlap_) + "; likely cause: an overlap at the start" +
      (overlap_->step > 0 ? " of closing" : "") +
      ", before anything has moved; place them apart, or make them smaller; what it led to: " +
      what.substr(begin, what.find("; likely cause") - begin));
}

}  // namespace cinch
