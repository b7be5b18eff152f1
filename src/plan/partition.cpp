#include "plan/partition.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Costs in units of one element's update, as bench_element.cpp and bench_contact.cpp measure them. Nodes cost
// next to nothing: they are moved in the pass that computes their elements, and wait for the same memory.
constexpr double node_cost = 0.1, pair_cost = 8, host_cost = 15;
// What two threads need of each other costs as many: computed twice, and fetched from the other one's cache.
constexpr double border_cost = 6;

Index grain_of(Index node) { return node / kernel::grain; }

std::vector<double> grain_costs(const Model& model, const ContactList& contacts) {
  std::vector<double> cost(at(model.ledger_rows()), 0.0);
  for (Index i = 0; i < model.nodes; ++i) cost[at(grain_of(i))] += node_cost;
  for (std::size_t e = 0; e < at(model.elements); ++e)
    cost[at(grain_of(std::min(model.end_a[e], model.end_b[e])))] += 1;
  // most of a ring's pairs sleep; its contact costs its host and the thread beside it
  for (std::size_t r = 0; r + 1 < contacts.ring_begin.size(); ++r) {
    const Index begin = contacts.ring_begin[r], end = contacts.ring_begin[r + 1];
    if (begin == end) continue;
    cost[at(grain_of(model.rings[r].a))] += host_cost;
    cost[at(grain_of(contacts.pairs[at((begin + end) / 2)].a))] += pair_cost;
  }
  return cost;
}

// Where grains lie along one axis: the mean of their nodes.
std::vector<double> places(const AlignedVector<double>& axis, std::size_t grains) {
  std::vector<double> mean(grains, 0.0), count(grains, 0.0);
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const auto g = at(grain_of(static_cast<Index>(i)));
    mean[g] += axis[i];
    count[g] += 1;
  }
  for (std::size_t g = 0; g < grains; ++g) mean[g] /= count[g];
  return mean;
}

// What two grains cost more if different threads have them.
struct Border {
  std::size_t a, b;
  double cost;
};

std::vector<Border> find_borders(const Model& model, const ContactList& contacts) {
  std::vector<Border> borders;
  const auto add = [&](Index node, Index other) {
    const std::size_t a = at(grain_of(node)), b = at(grain_of(other));
    if (a == b) return;
    if (borders.empty() || borders.back().a != a || borders.back().b != b) borders.push_back({a, b, 0});
    borders.back().cost += border_cost;
  };
  for (std::size_t e = 0; e < at(model.elements); ++e) add(model.end_a[e], model.end_b[e]);
  for (std::size_t r = 0; r + 1 < contacts.ring_begin.size(); ++r)
    for (Index i = contacts.ring_begin[r]; i < contacts.ring_begin[r + 1]; ++i)
      add(contacts.pairs[at(i)].a, model.rings[r].a);
  return borders;
}

struct Grains {
  std::vector<double> cost;
  std::vector<Border> borders;
  std::vector<double> along[4];  ///< ways to line grains up
};

Grains grains_of(const Model& model, const State& state, const ContactList& contacts) {
  Grains grains{grain_costs(model, contacts), find_borders(model, contacts), {}};
  grains.along[0].resize(grains.cost.size());
  std::iota(grains.along[0].begin(), grains.along[0].end(), 0.0);
  const AlignedVector<double>* const axes[3] = {&state.x, &state.y, &state.z};
  for (std::size_t d = 0; d < 3; ++d) grains.along[1 + d] = places(*axes[d], grains.cost.size());
  return grains;
}

// Cuts grains in two again and again, each time across the way that costs least.
class Bisection {
 public:
  explicit Bisection(const Grains& grains) : grains_(grains), piece_(grains.cost.size(), 0) {}

  /// Shares out `some` among pieces number `first` and on.
  void share_out(std::vector<std::size_t> some, int first, int pieces) {
    if (pieces == 1 || some.empty()) return assign(some, first);
    const int left = pieces / 2;
    std::vector<std::size_t> best;
    std::size_t split = 0;
    double least = HUGE_VAL;
    for (const std::vector<double>& along : grains_.along) {
      std::stable_sort(some.begin(), some.end(),
                       [&](std::size_t l, std::size_t r) { return along[l] < along[r]; });
      const std::size_t middle = cut(some, left, pieces);
      if (const double costs = cost_of(some, middle, left, pieces); costs < least)
        best = some, split = middle, least = costs;
    }
    const auto middle = best.begin() + static_cast<std::ptrdiff_t>(split);
    share_out({best.begin(), middle}, first, left);
    share_out({middle, best.end()}, first + left, pieces - left);
  }

  const std::vector<int>& piece() const { return piece_; }  ///< grain

 private:
  void assign(const std::vector<std::size_t>& some, int piece) {
    for (const std::size_t g : some) piece_[g] = piece;
  }

  double sum(const std::vector<std::size_t>& some, std::size_t begin, std::size_t end) const {
    double costs = 0;
    for (std::size_t i = begin; i < end; ++i) costs += grains_.cost[some[i]];
    return costs;
  }

  // How many of the grains, in their order, make up the cost of `left` of `pieces`.
  std::size_t cut(const std::vector<std::size_t>& some, int left, int pieces) const {
    const double wanted = sum(some, 0, some.size()) * left / pieces;
    double before = 0;
    std::size_t count = 0;
    for (; count < some.size(); ++count) {
      const double cost = grains_.cost[some[count]];
      if (before + 0.5 * cost > wanted) break;
      before += cost;
    }
    return count;
  }

  // Of the most expensive piece, as if one had all of the border.
  double cost_of(const std::vector<std::size_t>& some, std::size_t middle, int left, int pieces) {
    side_.assign(grains_.cost.size(), 0);
    for (std::size_t i = 0; i < some.size(); ++i) side_[some[i]] = i < middle ? -1 : 1;
    double border = 0;
    for (const Border& b : grains_.borders)
      if (side_[b.a] * side_[b.b] < 0) border += b.cost;
    return border + std::max(sum(some, 0, middle) / left, sum(some, middle, some.size()) / (pieces - left));
  }

  const Grains& grains_;
  std::vector<int> piece_, side_;  ///< grain
};

}  // namespace

std::vector<std::vector<Index>> partition(const Model& model, const State& state, const ContactList& contacts,
                                          int pieces) {
  const Grains grains = grains_of(model, state, contacts);
  std::vector<std::size_t> all(grains.cost.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Bisection bisection(grains);
  bisection.share_out(all, 0, pieces);
  std::vector<std::vector<Index>> shares(at(pieces));
  for (Index i = 0; i < model.nodes; ++i) shares[at(bisection.piece()[at(grain_of(i))])].push_back(i);
  return shares;
}

}  // namespace cinch
