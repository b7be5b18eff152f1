#include "statics/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cinch::statics {
namespace {

constexpr int most_steps = 200;  // the trust region goes on from wherever these end

class InteriorPoint {
 public:
  explicit InteriorPoint(Workspace& work)
      : w_(work), net_(work.net), x_(work.net.position), count_(work.net.elements.size()) {
    for (auto* values : {&tension_, &slack_, &stretch_, &constant_, &d_tension_, &d_slack_})
      values->resize(count_);
  }

  Points solve() {
    start();
    double best_gap = std::numeric_limits<double>::infinity();
    for (int i = 0, stalled = 0; i < most_steps && stalled < 8 && w_.iterations < w_.max_iterations; ++i) {
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
  // never zero: T / l and de stay finite when both ends of an element meet
  double length(std::size_t e) const { return std::max(span(net_, x_, e).norm(), 1e-12 * w_.length); }

  // s + T / k, by which a and c are divided
  double compliance(std::size_t e) const { return slack_[e] + tension_[e] / net_.stiffness[e]; }

  // Springs of rest length zero and equal force density have a linear equilibrium: a start that no first
  // guess can spoil, with all members taut and all forces balanced.
  void start() {
    const double density = w_.weight / w_.length;
    const auto block = [&](std::size_t) { return Block(density * Block::Identity()); };
    const auto equal = [&](std::size_t) { return density; };
    w_.factorise(w_.freedom.assemble(net_, block), shift());
    const Vector to_start = w_.solve(w_.freedom.project(nodal_force(net_, x_, equal)));
    if (to_start.allFinite()) x_ = w_.freedom.move(x_, to_start);
    refresh();
    for (std::size_t e = 0; e < count_; ++e) {
      tension_[e] = std::max(density * length(e), 1e-3 * w_.node_weight);
      slack_[e] = std::max(tension_[e] / net_.stiffness[e] - stretch_[e], 0.1 * net_.rest_length[e]);
    }
  }

  // keeps the factorisation regular where a piece can drift, as along a level guide
  double shift() const { return 1e-10 * w_.node_weight / w_.length; }

  void refresh() {
    for (std::size_t e = 0; e < count_; ++e) stretch_[e] = elongation(net_, x_, e);
  }

  // mean of T s, J, after a step of which the part `reach` is taken
  double mean_gap(double reach) const {
    double sum = 0;
    for (std::size_t e = 0; e < count_; ++e)
      sum += (tension_[e] + reach * d_tension_[e]) * (slack_[e] + reach * d_slack_[e]);
    return sum / static_cast<double>(count_);
  }

  double largest_tension() const { return *std::max_element(tension_.begin(), tension_.end()); }

  // force(x, T), N, or force(x, T + c)
  Points balance(bool with_constant) const {
    return nodal_force(net_, x_, [&](std::size_t e) {
      return (tension_[e] + (with_constant ? constant_[e] : 0)) / length(e);
    });
  }

  void factorise() {
    const auto block = [&](std::size_t e) {
      return stiffness_block(span(net_, x_, e), tension_[e] / compliance(e), tension_[e] / length(e));
    };
    w_.factorise(w_.freedom.assemble(net_, block), shift());
  }

  // Newton direction towards T s = nu, J; returns how far it can be followed with T and s above zero.
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

  // false, without a step, when there is none to take
  bool advance(double reach) {
    if (!dx_.allFinite() || !(reach > 1e-8)) return false;
    x_ = w_.freedom.move(x_, reach * dx_);
    for (std::size_t e = 0; e < count_; ++e) {
      tension_[e] += reach * d_tension_[e];
      slack_[e] += reach * d_slack_[e];
    }
    return true;
  }

  Workspace& w_;
  const StaticNet& net_;
  Points x_;
  std::size_t count_;
  std::vector<double> tension_, slack_, stretch_;       // T, s, e of each element
  std::vector<double> constant_, d_tension_, d_slack_;  // c, dT, ds
  Vector dx_;
};

}  // namespace

Points interior_point(Workspace& work) { return InteriorPoint(work).solve(); }

}  // namespace cinch::statics
