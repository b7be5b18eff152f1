// Whole groups of a chain: element forces, their sum at each node and the move, in one pass and with eight
// lanes by hand (AVX-512). Every upper end is the next lower one, so that neighbours come out of registers.
//
// The square root and the division of a group take longer than all its other arithmetic, and the core's
// window of instructions is shorter than both together. So a turn of the loop finishes one group, divides for
// the next and takes the root for the one behind: none waits for another. bench/README.md has what that gave.
//
// Groups whose elements are all slack need neither; the chain's first ones are passed by as long as they are
// such, which in a net that flies is all of them.
//
// axial_law.hpp and node_update.cpp are the reference; the operations on each number and their order are
// theirs, and so are the bits.
#include <cstddef>

#include "kernels/axial_lanes.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

using kernel::AxialArguments;
using kernel::lanes;
using kernel::Moving;
using kernel::NodeArguments;
using kernel::Span;
using kernel::Stretch;
/// Lanes 1 to 7 of `here` and the first one of `next`.
CINCH_INLINE Group upper(Group here, Group next) {
  return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(next), _mm512_castpd_si512(here), 1));
}

/// The last lane of `before` and lanes 0 to 6 of `here`.
CINCH_INLINE Group lower(Group before, Group here) {
  return _mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(here), _mm512_castpd_si512(before), 7));
}

/// Each upper end is the next lower one.
CINCH_INLINE Nodes upper(const Nodes& here, const Nodes& next) {
  return {upper(here.x, next.x), upper(here.y, next.y), upper(here.z, next.z),
          upper(here.u, next.u), upper(here.v, next.v), upper(here.w, next.w)};
}

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
  /// Where the upper ends of a group's elements are to the lower ones.
  CINCH_INLINE Axes apart(std::ptrdiff_t group) const {
    const auto along = [i = group * lanes](const double* p) {
      return upper(load(p + i), load(p + i + lanes)) - load(p + i);
    };
    return {along(x), along(y), along(z)};
  }
  CINCH_INLINE const double* row(std::ptrdiff_t group) const {
    return palette + kernel::palette_fields * lanes * static_cast<std::ptrdiff_t>(parameter[group]);
  }
};

/// What adds to the element forces along one axis.
struct Others {
  /// Terms from the second on of the chain's first node, N.
  const double *plus[kernel::max_terms - 1], *minus[kernel::max_terms - 1];
  const double* load;  ///< standing, on that node, N
  Group pull;          ///< dt g, m/s
};

CINCH_INLINE Chain chain(const AxialArguments& g, const NodeArguments& n, const Span& s) {
  return {n.x + s.node,  n.y + s.node,  n.z + s.node,     n.vx + s.node,
          n.vy + s.node, n.vz + s.node, n.scale + s.node, g.parameter + s.parameter,
          g.palette};
}

CINCH_INLINE Others others(const double* force, const Stretch& s, const double* load, double pull) {
  return {{force + s.plus[1], force + s.plus[2], force + s.plus[3]},
          {force + s.minus[1], force + s.minus[2], force + s.minus[3]},
          load,
          _mm512_set1_pd(pull)};
}

/// v += dt F/m, x += dt v along one axis for the nodes from number i on; returns the speeds.
template <bool gravity, bool loaded, int terms>
CINCH_INLINE Group move(double* x, double* v, std::ptrdiff_t i, Group force, const Others& more, Group scale,
                        Group dt) {
  for (int t = 0; t + 1 < terms; ++t) force += load(more.plus[t] + i) - load(more.minus[t] + i);
  if (loaded) force += load(more.load + i);
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

/// A chain on its way through its groups.
template <bool power, bool gravity, Moving::Kind kind, int terms>
struct Walk {
  static constexpr bool loaded = kind == Moving::loaded;
  const Chain c;
  const Others x, y, z;
  const Group dt;
  Forces before;  ///< of the last group
  Group greatest;
  LedgerRow ledger;

  /// Moves the nodes of a group, whose elements' forces are `here`.
  CINCH_INLINE void move_group(std::ptrdiff_t k, const Forces& here, bool more) {
    const std::ptrdiff_t i = k * lanes;
    const Group scale = load(c.scale + i);
    const Group u = move<gravity, loaded, terms>(c.x, c.u, i, here.x - lower(before.x, here.x), x, scale, dt);
    const Group v = move<gravity, loaded, terms>(c.y, c.v, i, here.y - lower(before.y, here.y), y, scale, dt);
    const Group w = move<gravity, loaded, terms>(c.z, c.w, i, here.z - lower(before.z, here.z), z, scale, dt);
    if (kind != Moving::blind) greatest = _mm512_max_pd(u * u + v * v + w * w, greatest);
    if (power) ledger.advance(more);
    before = here;
  }
};

template <bool damped, bool power, bool gravity, Moving::Kind kind, int terms>
double update(const AxialArguments& g, const NodeArguments& n, const Span& span, const Stretch& stretch) {
  const std::ptrdiff_t groups = span.groups;
  const auto load_on = [&](const double* loads) {
    return kind == Moving::loaded ? loads + span.node : nullptr;
  };
  Walk<power, gravity, kind, terms> walk{
      chain(g, n, span),
      others(n.fx, stretch, load_on(n.load_x), n.gravity[0]),
      others(n.fy, stretch, load_on(n.load_y), n.gravity[1]),
      others(n.fz, stretch, load_on(n.load_z), n.gravity[2]),
      _mm512_set1_pd(n.dt),
      {load(n.fx + span.force - lanes), load(n.fy + span.force - lanes), load(n.fz + span.force - lanes)},
      _mm512_setzero_pd(),
      LedgerRow(g.booked, span, power)};
  const Chain& c = walk.c;
  double* const damper = power ? g.damper + span.parameter * lanes : nullptr;
  std::ptrdiff_t k = 0;
  for (; k < groups; ++k) {  // as long as they idle: a flying net does
    const Axes apart = c.apart(k);
    if (!idle(apart, c.row(k), power ? damper + k * lanes : nullptr)) break;
    walk.move_group(k, no_pull(apart), k + 1 < groups);
  }
  if (k < groups) {
    // Nodes can be read up to the group behind the last one; what comes of them there is not used.
    const auto upto = [groups](std::ptrdiff_t group) { return group < groups ? group : groups; };
    const auto row = [&](std::ptrdiff_t group) { return c.row(group < groups ? group : groups - 1); };
    const Nodes first = c.nodes(k), second = c.nodes(k + 1);
    Nodes next = c.nodes(upto(k + 2));
    Taut now = taut(relative(first, upper(first, second)), c.row(k));
    Relative ahead = relative(second, upper(second, next));
    for (; k < groups; ++k) {
      const Nodes far = c.nodes(upto(k + 3));
      const Relative behind = relative(next, upper(next, far));
      const Taut soon = taut(ahead, row(k + 1));
      const Forces here = force<damped, power, power>(now, c.row(k), walk.dt,
                                                      power ? damper + k * lanes : nullptr, walk.ledger.sum);
      walk.move_group(k, here, k + 1 < groups);
      now = soon, ahead = behind, next = far;
    }
  }
  const std::ptrdiff_t last = span.force + (groups - 1) * lanes;  // what the next node's stretch reads
  const Forces& before = walk.before;
  store(g.fx + last, before.x), store(g.fy + last, before.y), store(g.fz + last, before.z);
  return kind != Moving::blind ? _mm512_reduce_max_pd(walk.greatest) : 0;
}

template <bool damped, bool power, bool gravity, Moving::Kind kind>
double update_one(const AxialArguments& g, const NodeArguments& n, const Span& span, const Stretch& stretch) {
  switch (stretch.terms) {
    case 1:
      return update<damped, power, gravity, kind, 1>(g, n, span, stretch);
    case 2:
      return update<damped, power, gravity, kind, 2>(g, n, span, stretch);
    case 3:
      return update<damped, power, gravity, kind, 3>(g, n, span, stretch);
    default:
      return update<damped, power, gravity, kind, kernel::max_terms>(g, n, span, stretch);
  }
}

template <bool damped, bool ledger, bool gravity, Moving::Kind kind>
double update_chain(const AxialArguments& g, const NodeArguments& n, const Span& span,
                    const Stretch& stretch) {
  return ledger && span.row_node >= 0 ? update_one<damped, ledger, gravity, kind>(g, n, span, stretch)
                                      : update_one<damped, false, gravity, kind>(g, n, span, stretch);
}

template <bool damped, bool ledger, Moving::Kind kind>
void fill_kind(KernelTable& table) {
  table.update_chain[damped][ledger][0][kind] = update_chain<damped, ledger, false, kind>;
  table.update_chain[damped][ledger][1][kind] = update_chain<damped, ledger, true, kind>;
}

template <bool damped, bool ledger>
void fill(KernelTable& table) {
  fill_kind<damped, ledger, Moving::blind>(table);
  fill_kind<damped, ledger, Moving::watched>(table);
  fill_kind<damped, ledger, Moving::loaded>(table);
}

}  // namespace

void fill_chain(KernelTable& table);

void fill_chain(KernelTable& table) {
  fill<false, false>(table);
  fill<true, false>(table);
  fill<true, true>(table);
}

}  // namespace cinch::CINCH_ISA
