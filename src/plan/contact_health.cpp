#include "plan/contact_health.hpp"

#include <cstdio>

#include "base/error.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <class Tally>
void check_stiffness(const Preparation& preparation, double dt, bool ring, std::size_t number,
                     const Tally& tally) {
  if (!(tally.stiffest > 1)) return;
  char text[500];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s the contact of %s with %s needed %.3g times what the stable step leaves; "
      "likely cause: an impact too hard for the time step %.3g s; a step of %.2g s would carry it",
      tally.stiffest_time, item_label(preparation, tally.stiffest_element).c_str(),
      partner_label(preparation, ring, number).c_str(), tally.stiffest, dt, dt / tally.stiffest * 0.9);
  throw NumericalError(text);
}

// `distance`: at which the thinnest of what touches would be through.
template <class Tally>
void check_depth(const Preparation& preparation, const Phase& phase, const State& state, bool ring,
                 std::size_t number, const Tally& tally, double distance) {
  if (!(tally.max_penetration > pressed_share * distance)) return;
  char text[500];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %s (or a neighbour) is pressed %.3g m into %s, of the %.3g m at which it "
      "would be through; likely cause: a contact too soft for the pull, or a time step too long for "
      "an impact (%.3g s)",
      preparation.timeline.time_of(state.step), item_label(preparation, tally.stiffest_element).c_str(),
      tally.max_penetration, partner_label(preparation, ring, number).c_str(), distance, phase.plan.dt);
  throw NumericalError(text);
}

}  // namespace

std::string item_label(const Preparation& preparation, Index item) {
  return item < 0 ? node_label(preparation.assembly, kernel::sphere_label(item))
                  : element_label(preparation, item);
}

std::string partner_label(const Preparation& preparation, bool ring, std::size_t number) {
  return ring ? "ring '" + preparation.assembly.rings[number].name + "'"
              : "target '" + preparation.assembly.balls[number].name + "'";
}

void check_contacts(const Preparation& preparation, const Phase& phase, const State& state) {
  const Model& model = phase.model;
  for (std::size_t r = 0; r < state.rings.size(); ++r) {
    if (model.slides(r)) continue;
    check_stiffness(preparation, phase.plan.dt, true, r, state.rings[r]);
    check_depth(preparation, phase, state, true, r, state.rings[r],
                model.ring_wire_radius[r] + model.contact_sets[at(model.ring_set[r])].thinnest);
  }
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    for (const kernel::BallTally& tally : state.balls[b]) {
      check_stiffness(preparation, phase.plan.dt, false, b, tally);
      check_depth(preparation, phase, state, false, b, tally, model.balls[b].radius);
    }
}

void report_jump(const Preparation& preparation, const Phase& phase, const State& state, const Jump& jump) {
  const auto with = at(jump.pair.with);
  const std::string name = partner_label(preparation, jump.ring, with);
  const double allowed = jump_share * jump.pair.contact_distance, dt = phase.plan.dt;
  char text[600];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %s comes towards %s by %.3g m in one step, too far to see it touch (allowed: "
      "%.3g m); likely cause: the time step %.3g s is too long for %.3g m/s; a step of %.2g s would do",
      preparation.timeline.time_of(state.step), item_label(preparation, jump.pair.element).c_str(),
      name.c_str(), jump.motion, allowed, dt, jump.motion / dt, 0.9 * allowed / jump.motion * dt);
  throw NumericalError(text);
}

void report_loss(const Preparation& preparation, const Look& now, const ThreadingWatch::Loss& loss) {
  const Vec3 place = now.ring_center(loss.ring);
  char text[600];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %s has left ring '%s' at (%.6g, %.6g, %.6g) m: it passed through it %d time(s), "
      "now %d; likely cause: an end was drawn through the opening, or the thread through the wire (a "
      "contact too soft, a time step too long); contact.leaving = \"event\" goes on",
      now.time(), preparation.assembly.parts[at(loss.part)].reference().c_str(),
      preparation.assembly.rings[at(loss.ring)].name.c_str(), place.x(), place.y(), place.z(), loss.before,
      loss.now);
  throw NumericalError(text);
}

}  // namespace cinch
