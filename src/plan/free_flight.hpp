// Free flight: as long as no element pulls and nothing touches, nodes go straight on, or fall, and many steps
// are done at once. A net that flies to its target is slack in nearly all of its steps.
//
// kernels/free_flight.cpp says how long. With elements a little shorter than they are, by more than what the
// places of their nodes round off meanwhile, no step until then would have found a force: the bits are those
// of single steps.
#pragma once
#include "plan/piece.hpp"

namespace cinch {

class FreeFlight {
 public:
  FreeFlight(const Model& model, const StepPlan& plan);

  /// Whether a look may be worth it now: looks that find something that pulls grow rare.
  bool due() { return --pause_ < 0; }
  /// For how many steps, at most `most`, nothing of a whole piece pulls from this state on, which it has
  /// taken; 0 where that is too few.
  Index look(const State& state, const Piece& piece, std::int64_t most);
  /// The greatest squared speed, as the look found it, m^2/s^2; without gravity it stays.
  double greatest() const { return greatest_; }

 private:
  double reach(const State& state, double time);

  StepPlan plan_;
  Index nodes_;
  double shortest_;  ///< element, m
  double greatest_ = 0;
  int pause_ = 0, pause_length_ = 0;  ///< steps until the next look
};

}  // namespace cinch
