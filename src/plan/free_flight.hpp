// Free flight: as long as no element pulls and nothing touches, nodes go straight on, or fall, and many steps
// are done at once. A net that flies to its target is slack in nearly all of its steps.
//
// kernels/free_flight.cpp says how long. With elements a little shorter than they are, by more than what the
// places of their nodes round off meanwhile, no step until then would have found a force: the bits are those
// of single steps.
#pragma once
#include <algorithm>
#include <memory>

#include "plan/piece.hpp"

namespace cinch {

class FreeFlight {
  using Pieces = std::vector<std::unique_ptr<Piece>>;

 public:
  FreeFlight(const Model& model, const StepPlan& plan);

  /// Whether a look may be worth it, with `most` steps to do: looks that find something that pulls grow rare.
  bool due(std::int64_t most) const { return pause_ <= 0 && most >= worth; }
  /// Steps to do one by one before the next look, and that so many were.
  std::int64_t pause() const { return std::max(pause_, worth); }
  void pass(std::int64_t steps) { pause_ -= steps; }
  /// For how many steps, at most `most`, nothing pulls from this state on, which the pieces have taken; 0
  /// where that is too few.
  Index look(const State& state, const Pieces& pieces, std::int64_t most);
  /// No look for a while, longer than the last time.
  void put_off(const Pieces& pieces);
  /// The greatest squared speed, as the last look that found steps met it, m^2/s^2; without gravity it stays.
  double greatest() const { return greatest_; }

 private:
  static constexpr std::int64_t worth = 4;  ///< steps that pay for a look

  double reach(const State& state, double time);

  StepPlan plan_;
  Index nodes_;
  double shortest_;  ///< element, m
  double greatest_ = 0;
  std::int64_t pause_ = 0, pause_length_ = 0;
};

}  // namespace cinch
