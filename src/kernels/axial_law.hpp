// Tension-only spring and damper of one thread element, eq. (1) with model.md's rule:
//   T = S + c dl/dt,   S = k s,   s = l - l0,   where l > l0, never negative; T = 0 otherwise.
// Positive T pulls the ends together. The damper's force is T - S, and its power (T - S) dl/dt is what the
// element dissipates.
//
// Central differences change the energy where an element turns taut or slack within a step. A step takes half
// of the work from the force at its beginning, half from that at its end. Let d be what the length has
// changed by in the step before now, d' in the one after. With S = k s whenever taut, steps between taut ends
// take just what k s^2/2 gains; but where the element was slack, s < d, only S d/2 comes from the step
// before, and both steps take what is stored if
//   S (d + d') = k s (s + d').
// Where it was taut and will be slack, s < -d', that is
//   S (-d - d') = k s (s - d).
// With S = k s instead, k s (d - s)/2 is lost whenever an element turns taut and won whenever it turns slack
// at a constant rate: damped threads turn slack more slowly than taut and lose, undamped ones blow up far
// below the linear bound. The pull itself changes the rate,
//   d' = d - g T,   g = dt^2 (1/m_a + 1/m_b),
// where nothing else does. For an element alone the rule is exact then; in a net a quarter of what d' = d
// gives is left, or less, up to half of the stable step (bench/README.md). Neighbours that hold against the
// pull of a taut element make it a bad guess: -d' counts no further than to 5/4 |d|, so that only elements
// that have moved towards it turn slack.
//
// The damper, too, works only while the element is taut. A force acts from half a step before its instant to
// half a step after; an element that has turned taut s/d steps ago has been so for 1/2 + s/d of a step, with
// what fell to the force before, which was none. So its damper pulls with (1/2 + s/d) c dl/dt, but not so
// hard that it would turn the rate round. With c dl/dt alone a bounce loses the more energy the later in a
// step it begins, of first order in dt: in a net that flies, chance. Where it turns slack there is no such
// rule, as T is zero before s is.
#pragma once
#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

struct Axial {
  double tension;     ///< N
  double per_length;  ///< T / l, N/m: the force on end a is this times (x_b - x_a)
  double rate;        ///< dl/dt, m/s; of a slack element l/l0 times that
  double damper;      ///< T - S, N
  double energy;      ///< stored, J
  double spare;       ///< of a taut element, m: not below zero where it turns neither taut nor slack
};

/// S of an element that was slack, s < d. The smaller root of g k q^2 - b q + c = 0 for q = S/k, between 0
/// and s; none above 0: the damper alone turns it slack again.
inline double spring_turning_taut(double k, double stretch, double change, double drag, double give) {
  const double lost = give * drag, yield = give * k;
  const double b = 2 * change - lost + yield * stretch, c = stretch * (stretch + change - lost);
  const double square = b * b - 4 * yield * c;
  const double root = std::sqrt(square > 0 ? square : 0.0);
  return c > 0 ? k * (2 * c / (b + root)) : 0.0;
}

constexpr double furthest = 1.25;  ///< that an element is taken to shrink in a step, over |d|

/// S of an element that will be slack, s < -d'. The positive root of g k q^2 + b q = c for q = S/k, free of
/// cancellation; without tension d' = d, and -d' counts no further than to `furthest` |d|.
inline double spring_turning_slack(double k, double stretch, double change, double drag, double give) {
  const double yield = give * k, b = give * drag - 2 * change, c = stretch * (stretch - change);
  const double root = std::sqrt(b * b + 4 * yield * c);
  const double spring = k * ((b > 0 ? 2 * c : root - b) / (b > 0 ? b + root : 2 * yield));
  const double by_change = k * (c / std::fabs(change)), loose = 0.5 * by_change;
  const double least = by_change * (change < 0 ? 1 / (furthest + 1) : 1 / (furthest - 1));
  return spring + drag > 0 ? (spring > least ? spring : least) : loose;
}

/// The damper's pull, which is c dl/dt = `steady` while taut.
inline double drag_at_switch(double stretch, double change, double steady, double give) {
  const double share = steady * (0.5 + stretch / change), whole_rate = change / give;
  const double most = steady > whole_rate ? steady : whole_rate;
  return stretch < change ? (share < most ? share : most) : steady;
}

/// S for the stretch s > 0, the change of length d in the step before, the damper's pull and g. Where
/// the element turns neither taut nor slack it is k s to the last bit.
inline double spring_at_switch(double k, double stretch, double change, double drag, double give) {
  const double full = k * stretch, pull = full + drag > 0 ? full + drag : 0.0;
  const double shrinks = give * pull - change, most = furthest * std::fabs(change);
  const double taut = spring_turning_taut(k, stretch, change, drag, give);
  const double slack = spring_turning_slack(k, stretch, change, drag, give);
  return stretch < change ? taut : stretch < (shrinks < most ? shrinks : most) ? slack : full;
}

/// One element from r . r and r . v, r its ends' relative position and v their velocity, in steps of dt; g as
/// above, m/N. Where `switching` is false, S = k s. Takes and gives plain numbers, as loops over small
/// structs are not vectorised by every compiler.
template <bool switching = true>
inline Axial axial_law(double rr, double rv, double k, double c, double l0, double dt, double give) {
  const double length = std::sqrt(rr);
  const double taut = length > l0 ? length : l0;  // a slack element may have length zero, l0 is none
  const double inverse = 1.0 / taut;
  const double stretch = taut - l0;
  const double rate = rv * inverse, change = rate * dt;
  const double full = k * stretch, steady = stretch > 0 ? c * rate : 0.0;
  const double spare = stretch > 0 ? stretch - furthest * std::fabs(change) : 0.0;
  const double drag = switching && spare < 0 ? drag_at_switch(stretch, change, steady, give) : steady;
  const double spring = switching && spare < 0 ? spring_at_switch(k, stretch, change, drag, give) : full;
  const double pull = spring + drag;
  const double tension = pull > 0 ? pull : 0.0;
  return {tension, tension * inverse, rate, tension - spring, 0.5 * full * stretch, spare};
}

}  // namespace cinch::CINCH_ISA
