#include "film.hpp"

#include <cmath>

namespace cinch::bench {
namespace {

void put(Simulation& simulation, const State& state) {
  simulation.state() = state;
  simulation.stepper().start_over();
}

}  // namespace

Film::Film(const Scene& scene, const std::vector<double>& times) {
  Simulation simulation(scene, 1);
  dt_ = simulation.preparation().dt;
  const auto keep = [&](std::int64_t step) {
    simulation.advance_to(step);
    states_.insert_or_assign(step, simulation.state());
  };
  const std::int64_t before_closing = simulation.preparation().closing_step - 1;
  for (const double time : times) {
    if (before_closing > simulation.step() && step_at(time) > before_closing) keep(before_closing);
    keep(step_at(time));
  }
}

std::int64_t Film::step_at(double time) const { return std::llround(time / dt_); }

void Film::wind(Simulation& simulation, double time) const {
  const std::int64_t closing = simulation.preparation().closing_step;
  if (!simulation.closed_phase() && step_at(time) >= closing) {
    put(simulation, states_.at(closing - 1));
    simulation.advance_to(closing);
  }
  put(simulation, states_.at(step_at(time)));
}

}  // namespace cinch::bench
