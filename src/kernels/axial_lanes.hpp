// The law of axial_law.hpp for eight elements at once, by hand (AVX-512): the operations on each number and
// their order are the same, and so are the bits.
//
// Elements that turn taut or slack in a step are few, and cost roots and divisions: these are done only for a
// group that has some. Compilers do not see that.
#pragma once
#pragma GCC diagnostic push  // false alarms, GCC bug 105593
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop

#include "kernels/arguments.hpp"
#include "kernels/axial_law.hpp"

namespace cinch::CINCH_ISA {

using Group = __m512d;

// Inlined always: values that go through memory to a function would undo what the pass is for.
#define CINCH_INLINE [[gnu::always_inline]] inline

CINCH_INLINE Group load(const double* p) { return _mm512_loadu_pd(p); }
CINCH_INLINE void store(double* p, Group v) { _mm512_storeu_pd(p, v); }

struct Nodes {
  Group x, y, z, u, v, w;
};

/// Where an element's ends are to each other.
struct Relative {
  Group rx, ry, rz, rv, length;
};

struct Taut {
  Group rx, ry, rz, rv, stretch, inverse;
};

/// Along the three axes.
struct Axes {
  Group x, y, z;
};
using Forces = Axes;

/// Whether no element of a group pulls and, with the last forces of its dampers at `damper`, none has power
/// to book: then it needs no root and no division. The root of fl(rest^2) is `rest`: what is not longer by
/// its square is not longer.
CINCH_INLINE bool idle(const Axes& apart, const double* palette, const double* damper) {
  const Group rest = load(palette + 2 * kernel::lanes);
  const Group square = apart.x * apart.x + apart.y * apart.y + apart.z * apart.z;
  if (_mm512_cmp_pd_mask(square, rest * rest, _CMP_NLE_UQ) != 0) return false;
  const __m512i bits = damper ? _mm512_castpd_si512(load(damper)) : _mm512_setzero_si512();
  return _mm512_test_epi64_mask(bits, bits) == 0;
}

/// The forces of such a group, to the last bit.
CINCH_INLINE Forces no_pull(const Axes& apart) {
  const Group zero = _mm512_setzero_pd();
  return {zero * apart.x, zero * apart.y, zero * apart.z};
}

CINCH_INLINE Relative relative(const Nodes& a, const Nodes& b) {
  Relative r;
  r.rx = b.x - a.x, r.ry = b.y - a.y, r.rz = b.z - a.z;
  r.length = _mm512_sqrt_pd(r.rx * r.rx + r.ry * r.ry + r.rz * r.rz);
  r.rv = r.rx * (b.u - a.u) + r.ry * (b.v - a.v) + r.rz * (b.w - a.w);
  return r;
}

CINCH_INLINE Taut taut(const Relative& r, const double* palette) {
  const Group rest = load(palette + 2 * kernel::lanes);
  const Group length = _mm512_max_pd(r.length, rest);
  return {r.rx, r.ry, r.rz, r.rv, length - rest, _mm512_set1_pd(1.0) / length};
}

/// As the scalar one of axial_law.hpp.
CINCH_INLINE Group spring_turning_taut(Group k, Group stretch, Group change, Group drag, Group give) {
  const Group zero = _mm512_setzero_pd(), two = _mm512_set1_pd(2.0), four = _mm512_set1_pd(4.0);
  const Group lost = give * drag, yield = give * k;
  const Group b = two * change - lost + yield * stretch, c = stretch * (stretch + change - lost);
  const Group root = _mm512_sqrt_pd(_mm512_max_pd(b * b - four * yield * c, zero));
  return _mm512_maskz_mul_pd(_mm512_cmp_pd_mask(c, zero, _CMP_GT_OQ), k, two * c / (b + root));
}

/// As the scalar one of axial_law.hpp.
CINCH_INLINE Group spring_turning_slack(Group k, Group stretch, Group change, Group drag, Group give) {
  const Group zero = _mm512_setzero_pd(), two = _mm512_set1_pd(2.0), four = _mm512_set1_pd(4.0);
  const Group yield = give * k, b = give * drag - two * change, c = stretch * (stretch - change);
  const Group root = _mm512_sqrt_pd(b * b + four * yield * c);
  const __mmask8 plus = _mm512_cmp_pd_mask(b, zero, _CMP_GT_OQ);
  const Group spring =
      k * (_mm512_mask_blend_pd(plus, root - b, two * c) / _mm512_mask_blend_pd(plus, two * yield, b + root));
  const Group by_change = k * (c / _mm512_abs_pd(change)), loose = _mm512_set1_pd(0.5) * by_change;
  const __mmask8 shrinks = _mm512_cmp_pd_mask(change, zero, _CMP_LT_OQ);
  const Group least = by_change * _mm512_mask_blend_pd(shrinks, _mm512_set1_pd(1 / (furthest - 1)),
                                                       _mm512_set1_pd(1 / (furthest + 1)));
  const __mmask8 pulls = _mm512_cmp_pd_mask(spring + drag, zero, _CMP_GT_OQ);
  return _mm512_mask_blend_pd(pulls, loose, _mm512_max_pd(spring, least));
}

/// As the scalar one of axial_law.hpp, for elements that turn taut.
CINCH_INLINE Group drag_turning_taut(Group stretch, Group change, Group steady, const double* palette) {
  const Group share = steady * (_mm512_set1_pd(0.5) + stretch / change);
  const Group whole_rate = change / load(palette + 3 * kernel::lanes);
  return _mm512_min_pd(share, _mm512_max_pd(steady, whole_rate));
}

/// S of elements of which those in `near`, s < `furthest` |d|, may turn taut or slack; for the others k s.
/// Those in `taut` have turned taut.
CINCH_INLINE Group spring_at_switch(Group full, Group stretch, Group change, Group drag,
                                    const double* palette, __mmask8 near, __mmask8 taut) {
  const Group k = load(palette), give = load(palette + 3 * kernel::lanes), zero = _mm512_setzero_pd();
  const Group shrinks = give * _mm512_max_pd(full + drag, zero) - change;
  const __mmask8 slack = _mm512_mask_cmp_pd_mask(_kandn_mask8(taut, near), stretch, shrinks, _CMP_LT_OQ);
  Group spring = full;
  if (taut) spring = _mm512_mask_mov_pd(spring, taut, spring_turning_taut(k, stretch, change, drag, give));
  if (slack) spring = _mm512_mask_mov_pd(spring, slack, spring_turning_slack(k, stretch, change, drag, give));
  return spring;
}

/// The forces; with `power` adds that of the damper, whose last force stands at `damper`, to `sum`, and with
/// `keep` puts this one there.
template <bool damped, bool power, bool keep>
CINCH_INLINE Forces force(const Taut& t, const double* palette, Group dt, double* damper, Group& sum) {
  const Group zero = _mm512_setzero_pd();
  const __mmask8 stretched = _mm512_cmp_pd_mask(t.stretch, zero, _CMP_GT_OQ);
  const Group rate = t.rv * t.inverse, change = rate * dt;
  Group spring = load(palette) * t.stretch;
  Group drag = damped ? _mm512_maskz_mul_pd(stretched, load(palette + kernel::lanes), rate) : zero;
  Group tension = _mm512_max_pd(damped ? spring + drag : spring, zero);
  const Group far = _mm512_set1_pd(furthest) * _mm512_abs_pd(change);
  const __mmask8 near = _mm512_mask_cmp_pd_mask(stretched, t.stretch, far, _CMP_LT_OQ);
  if (near) [[unlikely]] {
    const __mmask8 taut = _mm512_mask_cmp_pd_mask(near, t.stretch, change, _CMP_LT_OQ);
    if (damped && taut)
      drag = _mm512_mask_mov_pd(drag, taut, drag_turning_taut(t.stretch, change, drag, palette));
    spring = spring_at_switch(spring, t.stretch, change, drag, palette, near, taut);
    tension = _mm512_max_pd(spring + drag, zero);
  }
  if (power) {
    const Group taken = tension - spring;  // the damper's force
    sum += _mm512_set1_pd(0.5) * (taken + load(damper)) * rate;
    if (keep) store(damper, taken);
  }
  const Group per_length = tension * t.inverse;
  return {per_length * t.rx, per_length * t.ry, per_length * t.rz};
}

}  // namespace cinch::CINCH_ISA
