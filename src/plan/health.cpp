#include "plan/health.hpp"

#include <cmath>
#include <cstdio>

#include "base/error.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

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
  Index worst = 0;
  double fastest = -1;
  for (Index i = 0; i < model.nodes && std::isfinite(fastest); ++i) {
    const double speed = std::hypot(state.vx[at(i)], state.vy[at(i)], state.vz[at(i)]);
    if (!(speed <= fastest)) {
      worst = i;
      fastest = speed;
    }
  }
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
