// The elastic energy k max(0, |d| - l0)^2 / 2 is a convex function of the element's vector d, gravity is
// linear: the total energy is convex and every stationary point is a global minimum. What makes it hard is
// stiffness (a strain of 1e-6 turns a hanging shape that moves by metres) and the jump of the second
// derivative where a member goes slack. Two methods share the work:
//  1. an interior-point method takes tension and slack as unknowns of their own. It sees neither difficulty,
//  and no
//     first guess, and ends within about 1e-7 of the weight;
//  2. Newton's method in a trust region minimises the true energy from there to rounding.
#include "statics/equilibrium.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace cinch {
namespace {

using Points = std::vector<Vec3>;
using Vector = Eigen::VectorXd;
using Block = Eigen::Matrix3d;
using Sparse = Eigen::SparseMatrix<double>;
using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower>;

constexpr double rounding = std::numeric_limits<double>::epsilon();

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// |d| - l0 = (d.d - l0^2) / (|d| + l0), the numerator with the rounding of every product and sum carried
/// along: at strains of 1e-6 the plain difference would lose six of sixteen digits.
double elongation(const Vec3& d, double rest) {
  double sum = -rest * rest, carried = -std::fma(rest, rest, sum);
  for (const double c : d) {
    const double square = c * c, next = sum + square, part = next - sum;
    carried += std::fma(c, c, -square) + ((sum - (next - part)) + (square - part));
    sum = next;
  }
  return (sum + carried) / (d.norm() + rest);
}

Vec3 span(const StaticNet& net, const Points& x, std::size_t e) {
  return x[at(net.elements[e][1])] - x[at(net.elements[e][0])];
}

double elongation(const StaticNet& net, const Points& x, std::size_t e) {
  return elongation(span(net, x, e), net.rest_length[e]);
}

/// Tension over length of the tension-only law, N/m.
double force_density(const StaticNet& net, const Points& x, std::size_t e) {
  const double stretch = elongation(net, x, e);
  return stretch > 0 ? net.stiffness[e] * stretch / span(net, x, e).norm() : 0;
}

/// With u = d / l: second derivative = axial u u^T + (T / l) (I - u u^T).
Block stiffness_block(const Vec3& d, double axial, double density) {
  const Vec3 u = d.normalized();
  return density * Block::Identity() + (axial - density) * u * u.transpose();
}

Block true_block(const StaticNet& net, const Points& x, std::size_t e) {
  const double density = force_density(net, x, e);
  return stiffness_block(span(net, x, e), density > 0 ? net.stiffness[e] : 0, density);
}

/// Gravity plus the pull of elements that carry force density q(e) = T / l, N.
template <typename Density>
Points nodal_force(const StaticNet& net, const Points& x, const Density& q) {
  Points force(x.size());
  for (std::size_t n = 0; n < x.size(); ++n) force[n] = net.mass[n] * net.gravity;
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const Vec3 pull = q(e) * span(net, x, e);
    force[at(net.elements[e][0])] += pull;
    force[at(net.elements[e][1])] -= pull;
  }
  return force;
}

std::string describe(const StaticNet& net, const Points& x, std::size_t n) {
  const char* kind = net.support[n] == Support::guided ? "guided node" : "node";
  char text[160];
  std::snprintf(text, sizeof text, "%s %zu at (%.6g, %.6g, %.6g) m", kind, n, x[n].x(), x[n].y(), x[n].z());
  return text;
}

/// The movable degrees of freedom: position = start + sum of q[i] * direction[i] at node[i].
class Freedom {
 public:
  explicit Freedom(const StaticNet& net) : first_(1, 0) {
    for (std::size_t n = 0; n < net.position.size(); ++n) {
      if (net.support[n] == Support::free)
        for (int c = 0; c < 3; ++c) add(n, Vec3::Unit(c));
      if (net.support[n] == Support::guided) add(n, net.axis[n].normalized());
      first_.push_back(size());
    }
  }

  Index size() const { return static_cast<Index>(node_.size()); }

  Vector project(const Points& force) const {
    Vector r(size());
    for (Index i = 0; i < size(); ++i) r[i] = direction_[at(i)].dot(force[node_[at(i)]]);
    return r;
  }

  Points move(Points x, const Vector& q) const {
    for (Index i = 0; i < size(); ++i) x[node_[at(i)]] += q[i] * direction_[at(i)];
    return x;
  }

  double nodal_norm(const Vector& r, std::size_t n) const {
    return r.segment(first_[n], first_[n + 1] - first_[n]).norm();
  }

  std::size_t worst_node(const Vector& r) const {
    std::size_t worst = 0;
    for (std::size_t n = 1; n + 1 < first_.size(); ++n)
      if (!(nodal_norm(r, n) <= nodal_norm(r, worst))) worst = n;
    return worst;
  }

  double largest(const Vector& r) const { return r.size() > 0 ? nodal_norm(r, worst_node(r)) : 0; }

  /// Lower triangle of the matrix of element blocks block(e); the pattern never changes.
  template <typename Blocks>
  Sparse assemble(const StaticNet& net, const Blocks& block) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(at(size()) + 21 * net.elements.size());
    for (Index i = 0; i < size(); ++i) entries.emplace_back(i, i, 0.0);
    for (std::size_t e = 0; e < net.elements.size(); ++e) {
      const Block k = block(e);
      const auto [a, b] = net.elements[e];
      add_pair(entries, at(a), at(a), k);
      add_pair(entries, at(b), at(b), k);
      add_pair(entries, at(std::max(a, b)), at(std::min(a, b)), -k);
    }
    Sparse matrix(size(), size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

 private:
  void add(std::size_t n, const Vec3& direction) {
    node_.push_back(n);
    direction_.push_back(direction);
  }

  void add_pair(std::vector<Eigen::Triplet<double>>& entries, std::size_t row, std::size_t column,
                const Block& k) const {
    for (Index i = first_[row]; i < first_[row + 1]; ++i)
      for (Index j = first_[column]; j < first_[column + 1]; ++j)
        if (i >= j) entries.emplace_back(i, j, direction_[at(i)].dot(k * direction_[at(j)]));
  }

  std::vector<Index> first_;
  std::vector<std::size_t> node_;
  Points direction_;
};

/// What both methods share: the problem, its scales, one symbolic factorisation.
struct Work {
  const StaticNet& net;
  const EquilibriumOptions& options;
  Freedom freedom;
  double weight = 0;  // N, of the movable nodes
  double node_weight = 0;
  double length = 0;  // mean rest length, m
  int iterations = 0;
  bool analysed = false;
  Factor factor;

  Work(const StaticNet& given, const EquilibriumOptions& wanted)
      : net(given), options(wanted), freedom(given) {
    for (std::size_t n = 0; n < net.mass.size(); ++n)
      if (net.support[n] != Support::fixed) weight += net.mass[n] * net.gravity.norm();
    if (weight <= 0) weight = freedom.largest(residual(net.position));
    node_weight = 3 * weight / std::max<Index>(1, freedom.size());
    for (const double rest : net.rest_length) length += rest / static_cast<double>(net.rest_length.size());
  }

  Vector residual(const Points& x) const { return freedom.project(static_force(net, x)); }

  void factorise(const Sparse& matrix, double shift) {
    if (!analysed) factor.analyzePattern(matrix);
    analysed = true;
    factor.setShift(shift);
    factor.factorize(matrix);
    ++iterations;
  }

  /// Not a number where the factorisation failed, which both methods take as a step to refuse.
  Vector solve(const Vector& load) const {
    if (factor.info() == Eigen::Success) return factor.solve(load);
    return Vector::Constant(load.size(), std::numeric_limits<double>::quiet_NaN());
  }
};

/// Primal-dual interior point. Minimising the energy is the same as minimising sum T^2 / (2 k) - sum m g.x
/// under e(x) = l - l0 <= T / k. With the slack s = T / k - e >= 0 its conditions are
///     force(x, T) = 0,     s + e(x) - T / k = 0,     T s = nu -> 0,     T, s > 0.
/// A Newton step of these, with de = u.(dx_j - dx_i), has
///     ds = -(s + e - T / k) - de + dT / k,     dT = a de + c,
///     a = T / (s + T / k),     c = (nu + T (e - T / k)) / (s + T / k),
/// and leaves a symmetric system for dx: axial stiffness a, force density T / l, load force(x, T + c).
/// T > 0 keeps it positive definite even where members are slack.
class InteriorPoint {
 public:
  explicit InteriorPoint(Work& work)
      : w_(work), net_(work.net), x_(work.net.position), count_(work.net.elements.size()) {
    for (auto* values : {&tension_, &slack_, &stretch_, &constant_, &d_tension_, &d_slack_})
      values->resize(count_);
  }

  /// Shape close to the equilibrium; whatever it is, the true energy judges it afterwards.
  Points solve() {
    start();
    double best_gap = std::numeric_limits<double>::infinity();
    for (int i = 0, stalled = 0; i < 200 && stalled < 8 && w_.iterations < w_.options.max_iterations; ++i) {
      refresh();
      const double gap = mean_gap(0), scale = std::max(w_.weight, largest_tension());
      const double force = w_.freedom.largest(w_.freedom.project(balance(false)));
      if (gap < 1e-18 * scale * w_.length && force < 1e-8 * scale) break;
      stalled = gap < 0.5 * best_gap || force > 1e-8 * scale ? 0 : stalled + 1;
      if (stalled == 0) best_gap = gap;
      factorise();
      const double reach = direction(0);
      const double left = mean_gap(reach) / gap;
      // Mehrotra's centring; never fully off while the forces are far from balanced.
      const double centring = std::min(1.0, std::max(left * left, force > 0.1 * w_.node_weight ? 0.1 : 0.0));
      if (!advance(direction(centring * gap))) break;
    }
    return x_;
  }

 private:
  double tiny() const { return 1e-12 * w_.length; }
  double length(std::size_t e) const { return std::max(span(net_, x_, e).norm(), tiny()); }
  double compliance(std::size_t e) const { return slack_[e] + tension_[e] / net_.stiffness[e]; }

  // Springs of rest length zero and equal force density have a linear equilibrium: a start that no first
  // guess can spoil, with all members taut and all forces balanced.
  void start() {
    const double density = w_.weight / w_.length;
    w_.factorise(w_.freedom.assemble(net_, [&](std::size_t) { return Block(density * Block::Identity()); }),
                 shift());
    const auto equal = [&](std::size_t) { return density; };
    const Vector to_start = w_.solve(w_.freedom.project(nodal_force(net_, x_, equal)));
    if (to_start.allFinite()) x_ = w_.freedom.move(x_, to_start);
    refresh();
    for (std::size_t e = 0; e < count_; ++e) {
      tension_[e] = std::max(density * length(e), 1e-3 * w_.node_weight);
      slack_[e] = std::max(tension_[e] / net_.stiffness[e] - stretch_[e], 0.1 * net_.rest_length[e]);
    }
  }

  double shift() const { return 1e-10 * w_.node_weight / w_.length; }

  void refresh() {
    for (std::size_t e = 0; e < count_; ++e) stretch_[e] = elongation(net_, x_, e);
  }

  double mean_gap(double reach) const {
    double sum = 0;
    for (std::size_t e = 0; e < count_; ++e)
      sum += (tension_[e] + reach * d_tension_[e]) * (slack_[e] + reach * d_slack_[e]);
    return sum / static_cast<double>(count_);
  }

  double largest_tension() const { return *std::max_element(tension_.begin(), tension_.end()); }

  Points balance(bool with_constant) const {
    return nodal_force(net_, x_, [&](std::size_t e) {
      return (tension_[e] + (with_constant ? constant_[e] : 0)) / length(e);
    });
  }

  void factorise() {
    w_.factorise(w_.freedom.assemble(net_,
                                     [&](std::size_t e) {
                                       return stiffness_block(span(net_, x_, e), tension_[e] / compliance(e),
                                                              tension_[e] / length(e));
                                     }),
                 shift());
  }

  /// Newton direction towards T s = nu; returns how far it can be followed with T and s above zero.
  double direction(double nu) {
    for (std::size_t e = 0; e < count_; ++e)
      constant_[e] = (nu + tension_[e] * (stretch_[e] - tension_[e] / net_.stiffness[e])) / compliance(e);
    dx_ = w_.solve(w_.freedom.project(balance(true)));
    const Points moved = w_.freedom.move(Points(x_.size(), Vec3::Zero()), dx_);
    double reach = 1;
    for (std::size_t e = 0; e < count_; ++e) {
      const double k = net_.stiffness[e], de = span(net_, x_, e).dot(span(net_, moved, e)) / length(e);
      d_tension_[e] = tension_[e] / compliance(e) * de + constant_[e];
      d_slack_[e] = tension_[e] / k - slack_[e] - stretch_[e] - de + d_tension_[e] / k;
      if (d_tension_[e] < 0) reach = std::min(reach, -0.99 * tension_[e] / d_tension_[e]);
      if (d_slack_[e] < 0) reach = std::min(reach, -0.99 * slack_[e] / d_slack_[e]);
    }
    return reach;
  }

  bool advance(double reach) {
    if (!dx_.allFinite() || !(reach > 1e-8)) return false;
    x_ = w_.freedom.move(x_, reach * dx_);
    for (std::size_t e = 0; e < count_; ++e) {
      tension_[e] += reach * d_tension_[e];
      slack_[e] += reach * d_slack_[e];
    }
    return true;
  }

  Work& w_;
  const StaticNet& net_;
  Points x_;
  std::size_t count_;
  std::vector<double> tension_, slack_, stretch_, constant_, d_tension_, d_slack_;
  Vector dx_;
};

/// Energy at x + step less energy at x. Differences of squares and lengths are written as products with the
/// step, so that the result is good to rounding of the step's own work, not of the total energy; and the step
/// is exact along the guides, where a rounded position would do work against the guide's reaction.
double energy_change(const StaticNet& net, const Points& x, const Points& step) {
  double change = 0;
  for (std::size_t n = 0; n < x.size(); ++n) change -= net.mass[n] * net.gravity.dot(step[n]);
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const Vec3 before = span(net, x, e), moved = span(net, step, e), after = before + moved;
    const double lengths = before.norm() + after.norm();
    const double growth = lengths > 0 ? moved.dot(before + after) / lengths : 0;
    const double s = elongation(net, x, e), t = s + growth, both = std::max(s, 0.0) + std::max(t, 0.0);
    const double difference = s > 0 && t > 0 ? growth : std::max(t, 0.0) - std::max(s, 0.0);
    change += 0.5 * net.stiffness[e] * difference * both;
  }
  return change;
}

/// Largest coordinate, m.
double extent(const Points& x) {
  double largest = 0;
  for (const Vec3& point : x) largest = std::max(largest, point.lpNorm<Eigen::Infinity>());
  return largest;
}

/// Residual that rounded coordinates can force on a node, N.
double rounding_force(const StaticNet& net, const Points& x) {
  double stiffest = 0;
  for (const double k : net.stiffness) stiffest = std::max(stiffest, k);
  return 4 * rounding * extent(x) * stiffest;
}

/// Newton steps (H + mu I) q = f on the true energy. H is never indefinite, so each is the minimiser of the
/// quadratic model in a ball whose radius falls as mu rises; the ratio of real to promised gain moves mu.
class TrustRegion {
 public:
  TrustRegion(Work& work, Points start) : w_(work), x_(std::move(start)), best_(x_), f_(work.residual(x_)) {
    residual_ = best_residual_ = w_.freedom.largest(f_);
    least_ = 1e-9 * w_.node_weight / w_.length;
    mu_ = 1e-2 * w_.node_weight / w_.length;
  }

  /// Ends when the residual is within the tolerance, or at rounding and no longer falling.
  Points solve() {
    const double tolerance = w_.options.tolerance * w_.weight;
    while (best_residual_ > tolerance && stalled_ < 6 && w_.iterations < w_.options.max_iterations) iterate();
    return best_;
  }

 private:
  void iterate() {
    w_.factorise(w_.freedom.assemble(w_.net, [&](std::size_t e) { return true_block(w_.net, x_, e); }), mu_);
    const Vector q = w_.solve(f_);
    Points y = w_.freedom.move(x_, q);
    const Points step = w_.freedom.move(Points(x_.size(), Vec3::Zero()), q);
    const double gain = -energy_change(w_.net, x_, step),
                 promised = 0.5 * f_.dot(q) + 0.5 * mu_ * q.squaredNorm();
    const Vector f = w_.residual(y);
    const double residual = w_.freedom.largest(f);
    // Steps of a few last places change the energy by noise alone; there the residual decides.
    const bool at_rounding = q.lpNorm<Eigen::Infinity>() < 16 * rounding * extent(x_);
    const bool accept = at_rounding ? residual < residual_ : gain > 1e-4 * promised;
    adapt(accept, gain / promised);
    if (at_rounding || best_residual_ <= rounding_force(w_.net, x_))
      stalled_ += residual < 0.8 * best_residual_ ? 0 : 1;
    if (residual < best_residual_) {
      best_ = y;
      best_residual_ = residual;
    }
    if (!accept) return;
    x_ = std::move(y);
    f_ = f;
    residual_ = residual;
  }

  void adapt(bool accept, double ratio) {
    if (!accept) {
      mu_ *= growth_;
      growth_ *= 2;
      return;
    }
    growth_ = 4;
    if (ratio > 0.75) mu_ = std::max(0.1 * mu_, least_);
    if (ratio < 0.25) mu_ *= 2;
  }

  Work& w_;
  Points x_, best_;
  Vector f_;
  double residual_ = 0, best_residual_ = 0, least_ = 0, mu_ = 0, growth_ = 4;
  int stalled_ = 0;
};

void check_arrays(const StaticNet& net) {
  const std::size_t nodes = net.position.size(), elements = net.elements.size();
  if (net.mass.size() != nodes || net.support.size() != nodes || net.axis.size() != nodes)
    throw NumericalError("static equilibrium: position, mass, support and axis differ in length");
  if (net.stiffness.size() != elements || net.rest_length.size() != elements)
    throw NumericalError("static equilibrium: elements, stiffness and rest length differ in length");
  for (std::size_t n = 0; n < nodes; ++n)
    if (!net.position[n].allFinite() || !(net.mass[n] >= 0) ||
        (net.support[n] == Support::guided && !(net.axis[n].norm() > 0)))
      throw NumericalError("static equilibrium: bad position, mass or axis of " +
                           describe(net, net.position, n));
  for (std::size_t e = 0; e < elements; ++e) {
    const auto [a, b] = net.elements[e];
    const Index end = static_cast<Index>(nodes);
    if (a < 0 || b < 0 || a >= end || b >= end || a == b || !(net.stiffness[e] > 0) ||
        !(net.rest_length[e] > 0))
      throw NumericalError("static equilibrium: bad nodes, stiffness or rest length of element " +
                           std::to_string(e));
  }
}

/// Nodes of each connected piece.
std::vector<std::vector<std::size_t>> pieces(const StaticNet& net) {
  std::vector<std::vector<std::size_t>> neighbours(net.position.size()), found;
  for (const auto& [a, b] : net.elements) {
    neighbours[at(a)].push_back(at(b));
    neighbours[at(b)].push_back(at(a));
  }
  std::vector<bool> seen(net.position.size(), false);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    if (seen[n]) continue;
    seen[n] = true;
    std::vector<std::size_t> piece{n};
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const std::size_t other : neighbours[piece[i]])
        if (!seen[other]) {
          seen[other] = true;
          piece.push_back(other);
        }
    found.push_back(std::move(piece));
  }
  return found;
}

/// The energy has no minimum only if a piece can be shifted as a whole along its supports with gravity doing
/// work: with nothing fixed, along gravity itself, or along its guides if they are all parallel.
void check_supports(const StaticNet& net) {
  for (const auto& piece : pieces(net)) {
    double mass = 0;
    bool held = false;
    Vec3 way = net.gravity;
    bool guided = false;
    for (const std::size_t n : piece) {
      if (net.support[n] != Support::fixed) mass += net.mass[n];
      if (net.support[n] == Support::fixed) held = true;
      if (net.support[n] != Support::guided) continue;
      const Vec3 axis = net.axis[n].normalized();
      if (guided && axis.cross(way).norm() > 1e-9) held = true;
      way = axis;
      guided = true;
    }
    if (held || mass * std::abs(way.dot(net.gravity)) <= 1e-12 * mass * net.gravity.norm() * way.norm())
      continue;
    throw NumericalError("static equilibrium: the piece of " + std::to_string(piece.size()) + " nodes with " +
                         describe(net, net.position, piece[0]) +
                         " can fall: it is tied to no fixed node, and no guide holds it against gravity");
  }
}

void check_converged(const Work& w, const Points& x) {
  const Vector f = w.residual(x);
  if (f.size() == 0) return;
  const std::size_t worst = w.freedom.worst_node(f);
  const double force = w.freedom.nodal_norm(f, worst);
  const double relative = std::max(w.options.tolerance, 1e-9) * w.weight;
  if (force <= std::max(relative, rounding_force(w.net, x))) return;
  char text[160];
  std::snprintf(text, sizeof text,
                " keeps a residual force of %.3g N (%.3g of the weight) after %d factorisations", force,
                force / w.weight, w.iterations);
  throw NumericalError("static equilibrium not found: " + describe(w.net, x, worst) + text);
}

}  // namespace

double static_energy(const StaticNet& net, const std::vector<Vec3>& position) {
  double energy = 0;
  for (std::size_t n = 0; n < position.size(); ++n) energy -= net.mass[n] * net.gravity.dot(position[n]);
  for (std::size_t e = 0; e < net.elements.size(); ++e) {
    const double stretch = std::max(0.0, elongation(net, position, e));
    energy += 0.5 * net.stiffness[e] * stretch * stretch;
  }
  return energy;
}

std::vector<Vec3> static_force(const StaticNet& net, const std::vector<Vec3>& position) {
  return nodal_force(net, position, [&](std::size_t e) { return force_density(net, position, e); });
}

Eigen::SparseMatrix<double> static_hessian(const StaticNet& net, const std::vector<Vec3>& position) {
  StaticNet unsupported = net;
  unsupported.support.assign(position.size(), Support::free);
  return Freedom(unsupported).assemble(net, [&](std::size_t e) { return true_block(net, position, e); });
}

EquilibriumResult find_equilibrium(const StaticNet& net, const EquilibriumOptions& options) {
  check_arrays(net);
  check_supports(net);
  Work work(net, options);
  EquilibriumResult result;
  result.position = net.position;
  const bool balanced = work.freedom.largest(work.residual(net.position)) <= options.tolerance * work.weight;
  if (!balanced) result.position = TrustRegion(work, InteriorPoint(work).solve()).solve();
  check_converged(work, result.position);
  if (work.weight > 0)
    result.relative_residual = work.freedom.largest(work.residual(result.position)) / work.weight;
  result.iterations = work.iterations;
  for (std::size_t e = 0; e < net.elements.size(); ++e)
    if (elongation(net, result.position, e) <= 0) ++result.slack_elements;
  result.energy = static_energy(net, result.position);
  return result;
}

}  // namespace cinch
