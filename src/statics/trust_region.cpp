#include "statics/trust_region.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cinch::statics {
namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();

// Energy at x + step less energy at x. Differences of squares and lengths are written as products with the
// step, so that the result is good to rounding of the step's own work, not of the total energy; and the step
// is exact along the guides, where a rounded position would do work against the guide's reaction.
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

// Largest coordinate, m.
double extent(const Points& x) {
  double largest = 0;
  for (const Vec3& point : x) largest = std::max(largest, point.lpNorm<Eigen::Infinity>());
  return largest;
}

class TrustRegion {
 public:
  TrustRegion(Workspace& work, Points start)
      : w_(work), x_(std::move(start)), best_(x_), f_(work.residual(x_)) {
    residual_ = best_residual_ = w_.freedom.largest(f_);
    least_ = 1e-9 * w_.node_weight / w_.length;
    mu_ = 1e-2 * w_.node_weight / w_.length;
  }

  Points solve(double tolerance) {
    while (best_residual_ > tolerance && stalled_ < 6 && w_.iterations < w_.max_iterations) iterate();
    return best_;
  }

 private:
  void iterate() {
    const auto block = [&](std::size_t e) { return true_block(w_.net, x_, e); };
    w_.factorise(w_.freedom.assemble(w_.net, block), mu_);
    const Vector q = w_.solve(f_);
    Points y = w_.freedom.move(x_, q);
    const Points step = w_.freedom.move(Points(x_.size(), Vec3::Zero()), q);
    const double gain = -energy_change(w_.net, x_, step);
    const double promised = 0.5 * f_.dot(q) + 0.5 * mu_ * q.squaredNorm();
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

  // mu after a step; refusals in a row raise it ever faster
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

  Workspace& w_;
  Points x_, best_;
  Vector f_;
  double residual_ = 0, best_residual_ = 0;  // largest nodal ones of x_ and best_, N
  double least_ = 0, mu_ = 0, growth_ = 4;   // mu and its lower bound, N/m; factor on the next refusal
  int stalled_ = 0;                          // steps at rounding that did not lower the residual
};

}  // namespace

Points trust_region(Workspace& work, Points start, double tolerance) {
  return TrustRegion(work, std::move(start)).solve(tolerance);
}

double rounding_force(const StaticNet& net, const Points& x) {
  double stiffest = 0;
  for (const double k : net.stiffness) stiffest = std::max(stiffest, k);
  return 4 * rounding * extent(x) * stiffest;
}

}  // namespace cinch::statics
