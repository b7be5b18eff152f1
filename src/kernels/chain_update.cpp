// Whole groups of a chain: element forces, their sum at each node and the move, in one pass and with eight
// lanes by hand (AVX-512). Every upper end is the next lower one, so that neighbours come out of registers.
//
// The square root and the division of a group take longer than all its other arithmetic, and the core's
// window of instructions is shorter than both together. So a turn of the loop finishes one group, divides for
// the next and takes the root for the one behind: none waits for another. bench/README.md has what that gave.
//
// axial_force.cpp and node_update.cpp are the reference; the operations on each number and their order are
// theirs, and so are the bits.
#include <immintrin.h>

#include <cstddef>

#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::lanes;
using kernel::NodeArguments;
using kernel::Span;
using kernel::Stretch;
using Group = __m512d;

// Inlined always: values that go through memory to a function would undo what the pass is for.
#define CINCH_INLINE [[gnu::always_inline]] inline

CINCH_INLINE Group load(const double* p) { return _mm512_loadu_pd(p); }
CINCH_INLINE void store(double* p, Group v) { _mm512_storeu_pd(p, v); }

/// Lanes 1 to 7 of `here` and the first one of `next`.
CINCH_INLINE Group upper(Group here, Group next) {
  return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(next), _mm512_castpd_si512(here), 1));
}

/// The last lane of `before` and lanes 0 to 6 of `here`.
CINCH_INLINE Group lower(Group before, Group here) {
  return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(here), _mm512_castpd_si512(before), 7));
}

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

struct Forces {
  Group x, y, z;
};

/// One chain: its arrays from the first node on, by value, as stores may not seem to change them.
struct Chain {
  double* __restrict x, * __restrict y, * __restrict z, * __restrict u, * __restrict v, * __restrict w;
  const double* __restrict scale;
  const Index* __restrict parameter;
  const double* __restrict palette;

  CINCH_INLINE Nodes nodes(std::ptrdiff_t group) const {
    const std::ptrdiff_t i = group * lanes;
    return {load(x + i), load(y + i), load(z + i), load(u + i), load(v + i), load(w + i)};
  }
  CINCH_INLINE const double* row(std::ptrdiff_t group) const {
    return palette + 3 * lanes * static_cast<std::ptrdiff_t>(parameter[group]);
  }
};

/// What adds to the element forces along one axis.
struct Others {
  const double *plus[2], *minus[2];  ///< second and third term of the chain's first node, N
  Group pull;                        ///< dt g, m/s
};

CINCH_INLINE Chain chain(const AxialArguments& g, const NodeArguments& n, const Span& s) {
  return {n.x + s.node,  n.y + s.node,  n.z + s.node,     n.vx + s.node,
          n.vy + s.node, n.vz + s.node, n.scale + s.node, g.parameter + s.parameter,
          g.palette};
}

CINCH_INLINE Others others(const double* force, const Stretch& s, double pull) {
  return {
      {force + s.plus[1], force + s.plus[2]}, {force + s.minus[1], force + s.minus[2]}, _mm512_set1_pd(pull)};
}

template <bool damped>
CINCH_INLINE Relative relative(const Nodes& a, const Nodes& b) {
  Relative r;
  r.rx = upper(a.x, b.x) - a.x, r.ry = upper(a.y, b.y) - a.y, r.rz = upper(a.z, b.z) - a.z;
  r.length = _mm512_sqrt_pd(r.rx * r.rx + r.ry * r.ry + r.rz * r.rz);
  r.rv = _mm512_setzero_pd();
  if (damped)
    r.rv = r.rx * (upper(a.u, b.u) - a.u) + r.ry * (upper(a.v, b.v) - a.v) + r.rz * (upper(a.w, b.w) - a.w);
  return r;
}

CINCH_INLINE Taut taut(const Relative& r, const double* palette) {
  const Group rest = load(palette + 2 * lanes);
  const Group length = _mm512_max_pd(r.length, rest);
  return {r.rx, r.ry, r.rz, r.rv, length - rest, _mm512_set1_pd(1.0) / length};
}

/// axial_law.hpp; adds the damper's power to `sum`.
template <bool damped, bool power>
CINCH_INLINE Forces force(const Taut& t, const double* palette, Group& sum) {
  const Group zero = _mm512_setzero_pd();
  const __mmask8 stretched = _mm512_cmp_pd_mask(t.stretch, zero, _CMP_GT_OQ);
  const Group spring = load(palette) * t.stretch;
  Group pull = spring, rate = zero;
  if (damped) {
    rate = _mm512_maskz_mul_pd(stretched, t.rv, t.inverse);
    pull = spring + load(palette + lanes) * rate;
  }
  const Group tension = _mm512_max_pd(pull, zero);
  if (power) sum += (tension - spring) * rate;
  const Group per_length = tension * t.inverse;
  return {per_length * t.rx, per_length * t.ry, per_length * t.rz};
}

/// v += dt F/m, x += dt v along one axis for the nodes from number i on; returns the speeds.
template <bool gravity, int terms>
CINCH_INLINE Group move(double* x, double* v, std::ptrdiff_t i, Group force, const Others& more, Group scale,
                        Group dt) {
  for (int t = 0; t + 1 < terms; ++t) force += load(more.plus[t] + i) - load(more.minus[t] + i);
  const Group gain = scale * force;
  const Group speed = load(v + i) + (gravity ? gain + more.pull : gain);
  store(v + i, speed);
  store(x + i, load(x + i) + dt * speed);
  return speed;
}

/// The sum of power that goes to the row of the ledger which a group belongs to.
class LedgerRow {
 public:
  CINCH_INLINE LedgerRow(double* booked, const Span& s, bool used)
      : sum(_mm512_setzero_pd()), booked_(booked), group_(s.row_node / lanes) {
    if (used) open();
  }
  Group sum;

  /// Goes on to the next group, if there is one: rows further on are another thread's.
  CINCH_INLINE void advance(bool more) {
    if (++group_ % row_groups != 0 && more) return;
    store(row_, sum);
    if (more) open();
  }

 private:
  static constexpr Index row_groups = kernel::grain / lanes;
  CINCH_INLINE void open() {
    row_ = booked_ + group_ / row_groups * lanes;
    sum = load(row_);
  }
  double* booked_;
  double* row_ = nullptr;
  Index group_;
};

template <bool damped, bool power, bool gravity, bool watch, int terms>
double update(const AxialArguments& g, const NodeArguments& n, const Span& span, const Stretch& stretch) {
  const std::ptrdiff_t groups = span.groups;
  const Chain c = chain(g, n, span);
  const Others x = others(n.fx, stretch, n.gravity[0]), y = others(n.fy, stretch, n.gravity[1]),
               z = others(n.fz, stretch, n.gravity[2]);
  const Group dt = _mm512_set1_pd(n.dt);
  // Nodes can be read up to the group behind the last one; what comes of them there is not used.
  const auto upto = [groups](std::ptrdiff_t group) { return group < groups ? group : groups; };
  const auto row = [&](std::ptrdiff_t group) { return c.row(group < groups ? group : groups - 1); };
  Forces before{load(n.fx + span.force - lanes), load(n.fy + span.force - lanes),
                load(n.fz + span.force - lanes)};
  Group greatest = _mm512_setzero_pd();
  LedgerRow ledger(g.booked, span, power);
  const Nodes second = c.nodes(1);
  Nodes next = c.nodes(upto(2));
  Taut now = taut(relative<damped>(c.nodes(0), second), c.row(0));
  Relative ahead = relative<damped>(second, next);
  for (std::ptrdiff_t k = 0; k < groups; ++k) {
    const Nodes far = c.nodes(upto(k + 3));
    const Relative behind = relative<damped>(next, far);
    const Taut soon = taut(ahead, row(k + 1));
    const Forces here = force<damped, power>(now, c.row(k), ledger.sum);
    const std::ptrdiff_t i = k * lanes;
    const Group scale = load(c.scale + i);
    const Group u = move<gravity, terms>(c.x, c.u, i, here.x - lower(before.x, here.x), x, scale, dt);
    const Group v = move<gravity, terms>(c.y, c.v, i, here.y - lower(before.y, here.y), y, scale, dt);
    const Group w = move<gravity, terms>(c.z, c.w, i, here.z - lower(before.z, here.z), z, scale, dt);
    if (watch) greatest = _mm512_max_pd(u * u + v * v + w * w, greatest);
    if (power) ledger.advance(k + 1 < groups);
    before = here, now = soon, ahead = behind, next = far;
  }
  const std::ptrdiff_t last = span.force + (groups - 1) * lanes;  // what the next node's stretch reads
  store(g.fx + last, before.x), store(g.fy + last, before.y), store(g.fz + last, before.z);
  return watch ? _mm512_reduce_max_pd(greatest) : 0;
}

template <bool damped, bool power, bool gravity, bool watch>
double update_one(const AxialArguments& g, const NodeArguments& n, const Span& span, const Stretch& stretch) {
  switch (stretch.terms) {
    case 1:
      return update<damped, power, gravity, watch, 1>(g, n, span, stretch);
    case 2:
      return update<damped, power, gravity, watch, 2>(g, n, span, stretch);
    default:
      return update<damped, power, gravity, watch, kernel::max_terms>(g, n, span, stretch);
  }
}

template <bool damped, bool ledger, bool gravity, bool watch>
double update_chain(const AxialArguments& g, const NodeArguments& n, const Span& span,
                    const Stretch& stretch) {
  return ledger && span.row_node >= 0 ? update_one<damped, ledger, gravity, watch>(g, n, span, stretch)
                                      : update_one<damped, false, gravity, watch>(g, n, span, stretch);
}

template <bool damped, bool ledger>
void fill(KernelTable& table) {
  table.update_chain[damped][ledger][0][0] = update_chain<damped, ledger, false, false>;
  table.update_chain[damped][ledger][0][1] = update_chain<damped, ledger, false, true>;
  table.update_chain[damped][ledger][1][0] = update_chain<damped, ledger, true, false>;
  table.update_chain[damped][ledger][1][1] = update_chain<damped, ledger, true, true>;
}

}  // namespace

void fill_chain(KernelTable& table);

void fill_chain(KernelTable& table) {
  fill<false, false>(table);
  fill<true, false>(table);
  fill<true, true>(table);
}

}  // namespace cinch::CINCH_ISA
