// What is kept of the force that a ring feels, whatever causes it.
#pragma once
#include "kernels/arguments.hpp"
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

/// Notes peak, first contact and its first release.
inline void note_force(kernel::RingTally& tally, double force, double time) {
  if (force > tally.peak_force) {
    tally.peak_force = force;
    tally.peak_time = time;
  }
  if (tally.state == 2) return;
  if (tally.state == 0 && force > 0) {
    tally.state = 1;
    tally.first_time = time;
  }
  if (tally.state == 1) {
    if (force > tally.first_peak) tally.first_peak = force;
    if (!(force > 0)) tally.state = 2;
  }
}

}  // namespace cinch::CINCH_ISA
