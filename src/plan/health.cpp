#include "plan/health.hpp"

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

}  // namespace

void check_energy(const Preparation& preparation, const Model& model, const State& state, double residual,
                  double scale, double limit) {
  constexpr double least = 1e-12;  // J: rounding in a scene without energy
  if (std::abs(residual) <= limit * scale + least) return;  // not so for what is no number
  const Fastest fastest = fastest_node(model, state);
  const auto i = at(fastest.node);
  char text[700];
  std::snprintf(
      text, sizeof text,
      "error: at t = %.9g s %.3g J have %s, %.3g times what the scene began with and what was put in "
      "(time.residual_limit = %.3g); fastest: %s at (%.6g, %.6g, %.6g) m with %.3g m/s; likely "
      "cause: the time step %.3g s is too large for threads that turn slack and taut or for impacts "
      "(stable step %.3g s); take half of it, or more damping",
      static_cast<double>(state.step) * preparation.dt, std::abs(residual),
      residual < 0 ? "come from nowhere" : "been lost", scale > 0 ? std::abs(residual) / scale : HUGE_VAL,
      limit, node_label(preparation.assembly, fastest.node).c_str(), state.x[i], state.y[i], state.z[i],
      fastest.speed, preparation.dt, preparation.stable_step);
  throw NumericalError(text);
}

void check_contacts(const Preparation& preparation, const State& state) {
  const auto check = [&](const char* kind, const std::string& name, const auto& tally) {
    if (!(tally.stiffest > 1)) return;
    const Index stiffest = tally.stiffest_element;
    const std::string what = stiffest < 0 ? node_label(preparation.assembly, kernel::sphere_label(stiffest))
                                          : element_label(preparation, stiffest);
    char text[500];
    std::snprintf(
        text, sizeof text,
        "error: at t = %.9g s the contact of %s with %s '%s' needed %.3g times what the stable step leaves; "
        "likely cause: an impact too hard for the time step %.3g s (or an overlap at the start); a step of "
        "%.2g s would carry it",
        tally.stiffest_time, what.c_str(), kind, name.c_str(), tally.stiffest, preparation.dt,
        preparation.dt / tally.stiffest * 0.9);
    throw NumericalError(text);
  };
  for (std::size_t r = 0; r < state.rings.size(); ++r)
    check("ring", preparation.assembly.rings[r].name, state.rings[r]);
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    for (const kernel::BallTally& tally : state.balls[b])
      check("target", preparation.assembly.balls[b].name, tally);
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
