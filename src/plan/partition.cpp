#include "plan/partition.hpp"

#include <algorithm>
#include <numeric>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Costs in units of one element's update, as bench_element.cpp and bench_contact.cpp measure them.
constexpr double node_cost = 0.6, pair_cost = 8, host_cost = 15;

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

// Piece of each grain: the grains in the given order cut into stretches of equal cost.
std::vector<int> cut(const std::vector<double>& cost, const std::vector<std::size_t>& order, int pieces) {
  const double total = std::accumulate(cost.begin(), cost.end(), 0.0);
  std::vector<int> piece(cost.size());
  double before = 0;
  for (const std::size_t g : order) {
    const double middle = before + 0.5 * cost[g];
    piece[g] = std::min(pieces - 1, static_cast<int>(middle / total * pieces));
    before += cost[g];
  }
  return piece;
}

// What is computed by more than one thread, and how uneven the shares are.
double waste(const Model& model, const ContactList& contacts, const std::vector<double>& cost,
             const std::vector<int>& piece, int pieces) {
  const auto piece_of = [&](Index node) { return piece[at(grain_of(node))]; };
  double twice = 0;
  for (std::size_t e = 0; e < at(model.elements); ++e)
    twice += piece_of(model.end_a[e]) != piece_of(model.end_b[e]);
  for (std::size_t r = 0; r + 1 < contacts.ring_begin.size(); ++r)
    for (Index i = contacts.ring_begin[r]; i < contacts.ring_begin[r + 1]; ++i)
      twice += piece_of(contacts.pairs[at(i)].a) != piece_of(model.rings[r].a);
  std::vector<double> share(at(pieces), 0.0);
  for (std::size_t g = 0; g < cost.size(); ++g) share[at(piece[g])] += cost[g];
  return *std::max_element(share.begin(), share.end()) + twice / pieces;
}

}  // namespace

std::vector<std::vector<Index>> partition(const Model& model, const State& state, const ContactList& contacts,
                                          int pieces) {
  const std::vector<double> cost = grain_costs(model, contacts);
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<int> best = cut(cost, order, pieces);
  double least = waste(model, contacts, cost, best, pieces);
  for (const auto* axis : {&state.x, &state.y, &state.z}) {
    const std::vector<double> along = places(*axis, cost.size());
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t l, std::size_t r) { return along[l] < along[r]; });
    const std::vector<int> trial = cut(cost, order, pieces);
    const double wasted = waste(model, contacts, cost, trial, pieces);
    if (wasted < least) best = trial, least = wasted;
  }
  std::vector<std::vector<Index>> shares(at(pieces));
  for (Index i = 0; i < model.nodes; ++i) shares[at(best[at(grain_of(i))])].push_back(i);
  return shares;
}

}  // namespace cinch
