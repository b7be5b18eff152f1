// How long a pair with a ring needs no look.
//
// While no node moves by more than w, the element and the ring's centre come closer by at most 2 w. The
// host's vector, of length L, changes by at most 2 w: it turns by an angle a with sin(a) <= 2 w / L, if that
// is below 1. A circle of radius R that has turned about its centre lies within 2 R sin(a/2) of where it was,
// which is at most sqrt(2) R sin(a) up to a right angle; turned further, it is the circle of a smaller angle.
// So with the motion m = 2 w the gap closes by at most
//   m + sqrt(2) R min(1, m / L)
// and nothing touches up to m = gap / (1 + sqrt(2) R / L), nor up to m = gap - sqrt(2) R: the first for
// hosts that are long beside what they may move, the second whatever way the ring turns.
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

/// Motion (m: twice the way of the fastest node) up to which a ring of this radius (m) does not touch what
/// is `gap` (m) away. `inverse_length`: of the host as it is now, 1/m; 0 for a ring that does not turn.
inline double ring_sleep(double gap, double radius, double inverse_length) {
  const double turn = 1.4142135623730951 * radius;
  const double near = gap / (1 + turn * inverse_length);
  const double far = inverse_length > 0 ? gap - turn : near;
  return far > near ? far : near;
}

}  // namespace cinch::CINCH_ISA
