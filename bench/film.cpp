#include "film.hpp"

namespace cinch::bench {
namespace {

void put(Simulation& simulation, const State& state) {
  simulation.state() = state;
  simulation.stepper().start_over();
}

}  // namespace

Film::Film(const Scene& scene, const std::vector<double>& times) {
  Simulation simulation(scene, 1);
  timeline_ = simulation.preparation().timeline;
  const auto keep = [&](std::int64_t step) {
    simulation.advance_to(step);
    states_.insert_or_assign(step, simulation.state());
  };
  const std::int64_t before_closing = simulation.preparation().closing_step - 1;
  for (const double time : times) {
    if (before_closing > simulation.step() && timeline_.step_at(time) > before_closing) keep(before_closing);
    keep(timeline_.step_at(time));
  }
}

void Film::wind(Simulation& simulation, double time) const {
  const std::int64_t closing = simulation.preparation().closing_step;
  if (!simulation.closed_phase() && timeline_.step_at(time) >= closing) {
    put(simulation, states_.at(closing - 1));
    simulation.advance_to(closing);
  }
  put(simulation, states_.at(timeline_.step_at(time)));
}

}  // namespace cinch::bench
