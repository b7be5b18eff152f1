// How many threads step a scene fastest. That hangs on the scene, on which cores share a cache, and on what
// else the machine does, so it is measured while the scene runs: now and then some stretches of steps are
// done with twice or half as many threads, and what is faster stays. The bits are the same for any number.
#pragma once
#include <cstdint>

namespace cinch {

class ThreadChoice {
 public:
  /// Begins with `threads`, which it stays with where `most`, the most to try, are no more than 1.
  ThreadChoice(int threads, int most) : begin_(threads), threads_(threads), most_(most) {}
  /// Whether a scene of this size may gain: steps of smaller ones take less than some hand-overs, and larger
  /// ones take long to be shared out anew.
  static bool worth_it(std::int64_t elements) { return elements >= 600 && elements <= 200'000; }

  /// For the next stretch.
  int threads() const { return trial_ > 0 && stretch_ >= stretches ? trial_ : threads_; }
  /// Steps of that stretch, out of `wanted`.
  std::int64_t steps(std::int64_t wanted) const;
  /// What it took: with changing over to its threads, s. `flown`: steps were done without forces, many at
  /// once (free_flight.hpp).
  void note(std::int64_t steps, double seconds, bool flown);

 private:
  static constexpr int stretches = 3;           ///< of each number of threads that are compared
  static constexpr double stretch_time = 7e-4;  ///< s
  static constexpr double gain = 0.93;          ///< what is to be faster takes less than this share
  static constexpr double first_rest = 0.02;    ///< s
  static constexpr double rest_over_cost = 60;  ///< so that trials take a sixtieth of the time at most

  int next_trial() const;
  void begin_trial();
  void end_trial();
  void give_up();

  int begin_, threads_, most_;
  bool upwards_ = true;               ///< where it looks first
  int trial_ = 0, stretch_ = 0;       ///< threads of the trial that runs, if one does; its stretches so far
  double pace_ = 0;                   ///< of the last stretch, s a step
  double best_ = 0, best_tried_ = 0;  ///< paces of this trial
  double cost_ = 0;                   ///< of this trial: what the other number of threads took, s
  double rest_ = first_rest;          ///< until the next trial, s
  double rests_ = 1;                  ///< grows while trials change nothing
};

}  // namespace cinch
