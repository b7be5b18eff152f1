#include "plan/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double spare = 1e-9;             ///< of an element's length, left over for what rounds off
constexpr std::int64_t longest = 1 << 20;  ///< steps
constexpr std::int64_t shortest_pause = 6, longest_pause = 256;  ///< steps: a jerk takes a dozen

// Several pieces take the state anew for each look.
std::int64_t pause_factor(std::size_t pieces) { return pieces > 1 ? 8 : 1; }

}  // namespace

FreeFlight::FreeFlight(const Model& model, const StepPlan& plan)
    : plan_(plan),
      nodes_(model.nodes),
      shortest_(model.elements > 0
                    ? *std::min_element(model.rest_length.begin(), model.rest_length.begin() + model.elements)
                    : 0) {}

// The greatest coordinate of any node in the next `time`, m; notes the greatest speed.
double FreeFlight::reach(const State& s, double time) {
  double farthest = 0, greatest = 0;
  for (std::size_t i = 0; i < at(nodes_); ++i) {
    farthest = std::max({farthest, std::fabs(s.x[i]), std::fabs(s.y[i]), std::fabs(s.z[i])});
    greatest = std::max(greatest, s.vx[i] * s.vx[i] + s.vy[i] * s.vy[i] + s.vz[i] * s.vz[i]);
  }
  greatest_ = greatest;
  const double fall = plan_.gravity ? time * plan_.gravity_acceleration.norm() : 0;
  return farthest + time * (std::sqrt(greatest) + fall);
}

void FreeFlight::put_off(const Pieces& pieces) {
  pause_ = pause_length_ =
      std::min(pause_length_ + pause_length_ / 4 + 1, pause_factor(pieces.size()) * longest_pause);
}

Index FreeFlight::look(const State& state, const Pieces& pieces, std::int64_t most) {
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  const auto wanted = static_cast<double>(std::min(most, longest));
  const double enough = (1 + 2 * spare) * wanted * plan_.dt;
  double steps = wanted;
  for (const auto& piece : pieces)
    steps = std::min(steps, (1 - spare) * piece->time_to_pull(spare, enough) / plan_.dt);
  // In each step, places and speeds of both ends round off by half a unit along each axis: after n steps r is
  // off by less than sqrt(3) n eps reach by the places and half as much by the speeds, 0.65 of what is
  // spared.
  if (steps >= worth)
    steps = std::min(steps, 0.25 * spare * shortest_ / (rounding * reach(state, steps * plan_.dt)));
  if (steps < worth) return 0;
  pause_length_ = pause_factor(pieces.size()) * shortest_pause;
  pause_ = steps < wanted ? pause_length_ : 0;
  return static_cast<Index>(steps);
}

}  // namespace cinch
