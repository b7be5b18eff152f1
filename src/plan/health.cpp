#include "plan/health.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct Fastest {
  Index node = 0;
  double speed = -1;  // m/s; not finite if any is not
};

Fastest fastest_node(const Model& model, const State& state) {
  Fastest found;
  for (Index i = 0; i < model.nodes && std::isfinite(found.speed); ++i) {
    const double speed = std::hypot(state.vx[at(i)], state.vy[at(i)], state.vz[at(i)]);
    if (!(speed <= found.speed)) found = {i, speed};
  }
  return found;
}

// What touches, by the number that tallies keep: an element, or a mass as a sphere.
std::string label_of(const Preparation& preparation, Index item) {
  return item < 0 ? node_label(preparation.assembly, kernel::sphere_label(item))
                  : element_label(preparation, item);
}

Vec3 place(const State& state, Index node) {
  return {state.x[at(node)], state.y[at(node)], state.z[at(node)]};
}

// A node that a taut thread draws to a ring in its element.
struct AtRing {
  Index node = -1, joint = -1;
  double share =
      1;  // of the stretch of the element: how far the node is from where the thread meets the ring
};

// The nearest one that is nearer than its element is stretched, on a way over the rim or at a thread's end,
// which cannot pass: its pull turns round within a small part of the element, which the stable step does not
// know.
AtRing nearest_to_ring(const Model& model, const State& state) {
  AtRing found;
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j) {
      const kernel::Joint& joint = model.joints[at(j)];
      const kernel::JointState& now = state.joints[at(j)];
      const Vec3 offset(now.offset[0], now.offset[1], now.offset[2]);
      const Vec3 center = 0.5 * (place(state, joint.host_a) + place(state, joint.host_b));
      const bool over_rim = offset.norm() > 0.999 * joint.opening;
      for (const Index end : {now.element, now.element + 1}) {
        const Index node = model.sliding_nodes[at(thread.node_begin + end)];
        const double share = (place(state, node) - center - offset).norm() * thread.stiffness / now.tension;
        if ((over_rim || end == 0 || end == thread.elements) && share < found.share) found = {node, j, share};
      }
    }
  }
  return found;
}

std::string likely_cause(const Preparation& preparation, const Model& model, const State& state) {
  char text[400];
  const AtRing near = nearest_to_ring(model, state);
  if (near.joint < 0)
    std::snprintf(text, sizeof text,
                  "the time step %.3g s is too large for threads that turn slack and taut or for impacts "
                  "(stable step %.3g s); take half of it, or more damping",
                  preparation.dt, preparation.stable_step);
  else
    std::snprintf(
        text, sizeof text,
        "%s is drawn to ring '%s', nearer than its element is stretched: its pull turns round within "
        "the time step %.3g s (stable step %.3g s); give it a mass, or take a far smaller step",
        node_label(preparation.assembly, near.node).c_str(),
        preparation.assembly.rings[at(model.joints[at(near.joint)].ring)].name.c_str(), preparation.dt,
        preparation.stable_step);
  return text;
}

}  // namespace

void check_energy(const Preparation& preparation, const Model& model, const State& state, double residual,
                  double scale, double limit) {
  if (std::abs(residual) <= limit * scale + least_energy) return;  // not so for what is no number
  const Fastest fastest = fastest_node(model, state);
  const auto i = at(fastest.node);
  char text[1000];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %.3g J have %s, %.3g times what the scene began with and what was put in "
      "(time.residual_limit = %.3g); fastest: %s at (%.6g, %.6g, %.6g) m with %.3g m/s; likely "
      "cause: %s",
      static_cast<double>(state.step) * preparation.dt, std::abs(residual),
      residual < 0 ? "come from nowhere" : "been lost", scale > 0 ? std::abs(residual) / scale : HUGE_VAL,
      limit, node_label(preparation.assembly, fastest.node).c_str(), state.x[i], state.y[i], state.z[i],
      fastest.speed, likely_cause(preparation, model, state).c_str());
  throw NumericalError(text);
}

// Contacts at shared nodes are counted once by taking the node's own off those of its elements. Where a node
// and most of the elements at it sink in side by side, less than nothing is left: the contact draws in, and
// its damping drives.
void check_contact_energy(const Preparation& preparation, const State& state, double scale, double limit) {
  const auto check = [&](const char* kind, const std::string& name, const char* verb, double energy,
                         Index first) {
    if (!(energy < -limit * scale - least_energy)) return;
    char text[700];
    std::snprintf(
        text, sizeof text,
        "error: at t = %.9g s the contacts with %s '%s' %s %.3g J, less than nothing: -%.3g times what the "
        "scene began with and what was put in (time.residual_limit = %.3g); first of all %s; likely cause: "
        "nodes that sink in side by side with the elements that meet there; take longer elements, a harder "
        "%s or contact.shared_node = \"paper\"",
        static_cast<double>(state.step) * preparation.dt, kind, name.c_str(), verb, energy,
        scale > 0 ? -energy / scale : HUGE_VAL, limit, label_of(preparation, first).c_str(), kind);
    throw NumericalError(text);
  };
  const auto check_both = [&](const char* kind, const std::string& name, double potential, double dissipated,
                              Index first) {
    check(kind, name, "hold", potential, first);
    check(kind, name, "have taken", dissipated, first);
  };
  for (std::size_t r = 0; r < state.rings.size(); ++r)
    check_both("ring", preparation.assembly.rings[r].name, state.rings[r].potential,
               state.rings[r].dissipated, state.rings[r].stiffest_element);
  for (std::size_t b = 0; b < state.balls.size(); ++b) {
    double potential = 0, dissipated = 0, least = 0;
    Index first = -1;
    for (const kernel::BallTally& tally : state.balls[b]) {
      potential += tally.potential;
      dissipated += tally.dissipated;
      if (const double own = std::min(tally.potential, tally.dissipated); own < least)
        least = own, first = tally.stiffest_element;
    }
    check_both("target", preparation.assembly.balls[b].name, potential, dissipated, first);
  }
}

namespace {

template <class Tally>
void check_stiffness(const Preparation& preparation, const std::string& with, const Tally& tally) {
  if (!(tally.stiffest > 1)) return;
  char text[500];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s the contact of %s with %s needed %.3g times what the stable step leaves; "
      "likely cause: an impact too hard for the time step %.3g s (or an overlap at the start); a step of "
      "%.2g s would carry it",
      tally.stiffest_time, label_of(preparation, tally.stiffest_element).c_str(), with.c_str(),
      tally.stiffest, preparation.dt, preparation.dt / tally.stiffest * 0.9);
  throw NumericalError(text);
}

// `distance`: at which the thinnest of what touches would be through.
template <class Tally>
void check_depth(const Preparation& preparation, const State& state, const std::string& with,
                 const Tally& tally, double distance) {
  if (!(tally.max_penetration > pressed_share * distance)) return;
  char text[500];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %s (or a neighbour) is pressed %.3g m into %s, of the %.3g m at which it "
      "would be through; likely cause: a contact too soft for the pull, or a time step too long for "
      "an impact (%.3g s)",
      static_cast<double>(state.step) * preparation.dt, label_of(preparation, tally.stiffest_element).c_str(),
      tally.max_penetration, with.c_str(), distance, preparation.dt);
  throw NumericalError(text);
}

}  // namespace

void check_contacts(const Preparation& preparation, const Model& model, const State& state) {
  for (std::size_t r = 0; r < state.rings.size(); ++r) {
    if (model.slides(r)) continue;
    const std::string name = "ring '" + preparation.assembly.rings[r].name + "'";
    check_stiffness(preparation, name, state.rings[r]);
    check_depth(preparation, state, name, state.rings[r],
                model.ring_wire_radius[r] + model.contact_sets[at(model.ring_set[r])].thinnest);
  }
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    for (const kernel::BallTally& tally : state.balls[b]) {
      const std::string name = "target '" + preparation.assembly.balls[b].name + "'";
      check_stiffness(preparation, name, tally);
      check_depth(preparation, state, name, tally, model.balls[b].radius);
    }
}

void report_jump(const Preparation& preparation, const State& state, const Jump& jump) {
  const auto with = at(jump.pair.with);
  const std::string name = jump.ring ? "ring '" + preparation.assembly.rings[with].name + "'"
                                     : "target '" + preparation.assembly.balls[with].name + "'";
  const double allowed = jump_share * jump.pair.contact_distance;
  char text[600];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %s comes towards %s by %.3g m in one step, too far to see it touch (allowed: "
      "%.3g m); likely cause: the time step %.3g s is too long for %.3g m/s; a step of %.2g s would do",
      static_cast<double>(state.step) * preparation.dt, label_of(preparation, jump.pair.element).c_str(),
      name.c_str(), jump.motion, allowed, preparation.dt, jump.motion / preparation.dt,
      0.9 * allowed / jump.motion * preparation.dt);
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

bool speeds_allowed(const State& state, double speed_limit) {
  const double limit = speed_limit * speed_limit;
  bool allowed = true;
  for (std::size_t i = 0; i < state.vx.size(); ++i) {
    const double x = state.vx[i], y = state.vy[i], z = state.vz[i];
    allowed &= x * x + y * y + z * z <= limit;  // false for what is not a number, too
  }
  return allowed;
}

void report_runaway(const Preparation& preparation, const Model& model, const State& state,
                    double speed_limit) {
  const double time = static_cast<double>(state.step) * preparation.dt;
  const auto [worst, fastest] = fastest_node(model, state);
  char text[600];
  std::snprintf(text, sizeof text,
                "error: at t = %.9g s %s at (%.6g, %.6g, %.6g) m moves at %.3g m/s (time.speed_limit_m_s = "
                "%.3g); likely "
                "cause: the time step %.3g s is too large (stable step %.3g s, limited by %s)",
                time, node_label(preparation.assembly, worst).c_str(), state.x[at(worst)], state.y[at(worst)],
                state.z[at(worst)], fastest, speed_limit, preparation.dt, preparation.stable_step,
                preparation.limited_by.c_str());
  throw NumericalError(text);
}

}  // namespace cinch
