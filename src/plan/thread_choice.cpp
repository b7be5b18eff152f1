#include "plan/thread_choice.hpp"

#include <algorithm>

namespace cinch {
namespace {

constexpr double longest_rest = 64;       // in rests after a trial that changed something
constexpr std::int64_t fewest_steps = 8;  // of a stretch

}  // namespace

int ThreadChoice::next_trial() const {
  const int up = std::min(2 * threads_, most_), down = threads_ / 2;
  return up > threads_ && (upwards_ || down == 0) ? up : down;
}

std::int64_t ThreadChoice::steps(std::int64_t wanted) const {
  if (most_ <= 1 || pace_ == 0) return wanted;
  const double time = trial_ > 0 ? stretch_time : rest_;  // or until the next trial is due
  return std::min(wanted, std::max(fewest_steps, static_cast<std::int64_t>(time / pace_)));
}

void ThreadChoice::note(std::int64_t steps, double seconds, bool flown) {
  if (most_ <= 1 || steps == 0) return;
  if (flown) return give_up();
  const double pace = seconds / static_cast<double>(steps);
  if (trial_ == 0) {
    pace_ = pace, rest_ -= seconds;
    if (!(rest_ > 0)) begin_trial();
    return;
  }
  const bool tried = stretch_ >= stretches;
  double& best = tried ? best_tried_ : best_;
  best = best == 0 ? pace : std::min(best, pace);
  if (tried) cost_ += seconds;
  else pace_ = pace;
  if (++stretch_ == 2 * stretches) end_trial();
}

void ThreadChoice::begin_trial() {
  trial_ = next_trial();
  stretch_ = 0;
  best_ = best_tried_ = cost_ = 0;
}

void ThreadChoice::end_trial() {
  const bool better = best_tried_ < gain * best_;
  if (better) threads_ = trial_, pace_ = best_tried_;
  else upwards_ = !upwards_;
  rests_ = better ? 1 : std::min(2 * rests_, longest_rest);
  rest_ = better ? 0.0 : rests_ * rest_over_cost * cost_;
  trial_ = 0;
  if (better) begin_trial();  // goes on in that direction
}

// Steps without forces say nothing of threads.
void ThreadChoice::give_up() {
  threads_ = begin_, upwards_ = true;
  trial_ = 0, rest_ = first_rest;
  pace_ = 0;
}

}  // namespace cinch
