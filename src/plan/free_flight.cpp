#include "plan/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double spare = 1e-9;             ///< of an element's length, left over for what rounds off
constexpr std::int64_t longest = 1 << 20;  ///< steps
constexpr std::int64_t shortest_pause = 8, longest_pause = 256;  ///< steps: a jerk takes a dozen

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

// Several pieces take the state anew for each look.
static std::int64_t scale(const std::vector<std::unique_ptr<Piece>>& pieces) {
  return pieces.size() > 1 ? 8 : 1;
}

Index FreeFlight::put_off(const Pieces& pieces) {
  pause_ = pause_length_ = std::min(2 * pause_length_ + 1, scale(pieces) * longest_pause);
  return 0;
}

Index FreeFlight::look(const State& state, const Pieces& pieces, std::int64_t most) {
  if (most < worth) return 0;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  const auto wanted = static_cast<double>(std::min(most, longest));
  const double enough = (1 + 2 * spare) * wanted * plan_.dt;
  double steps = wanted;
  for (const auto& piece : pieces)
    steps = std::min(steps, (1 - spare) * piece->time_to_pull(spare, enough) / plan_.dt);
  // in each step, places and speeds of an element's ends round off by half a unit along each axis
  if (steps >= worth)
    steps = std::min(steps, 0.25 * spare * shortest_ / (rounding * reach(state, steps * plan_.dt)));
  if (steps < worth) return put_off(pieces);
  pause_length_ = scale(pieces) * shortest_pause;
  pause_ = steps < wanted ? pause_length_ : 0;
  return static_cast<Index>(steps);
}

}  // namespace cinch
