#include "report/chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cinch {
namespace {

constexpr double kSlack = 1e-6;    // N: less is rounding
constexpr double kStraight = 0.5;  // least cosine between an element and the next one of its chain

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

class Stringer {
 public:
  Stringer(const ResultModel& model, const std::vector<Vec3>& position)
      : model_(model), position_(position), used_(model.elements.size(), false), incident_(position.size()) {
    for (std::size_t e = 0; e < model.elements.size(); ++e)
      for (const Index node : model.elements[e]) incident_[at(node)].push_back(static_cast<Index>(e));
  }

  std::vector<Chain> chains() {
    std::vector<Chain> all;
    for (std::size_t e = 0; e < used_.size(); ++e)
      if (!used_[e]) all.push_back(chain_through(static_cast<Index>(e)));
    return all;
  }

 private:
  Chain chain_through(Index first) {
    used_[at(first)] = true;
    const auto [a, b] = model_.elements[at(first)];
    Chain chain{model_.element_part[at(first)], {a, b}, {first}};
    extend(chain);
    std::reverse(chain.nodes.begin(), chain.nodes.end());
    std::reverse(chain.elements.begin(), chain.elements.end());
    extend(chain);
    std::reverse(chain.nodes.begin(), chain.nodes.end());
    std::reverse(chain.elements.begin(), chain.elements.end());
    return chain;
  }

  void extend(Chain& chain) {
    while (true) {
      const Index tip = chain.nodes.back(), before = chain.nodes[chain.nodes.size() - 2];
      const Vec3 along = (position_[at(tip)] - position_[at(before)]).normalized();
      Index best = -1;
      double straightest = kStraight;
      for (const Index e : incident_[at(tip)]) {
        if (used_[at(e)] || model_.element_part[at(e)] != chain.part) continue;
        const double straight =
            along.dot((position_[at(other_end(e, tip))] - position_[at(tip)]).normalized());
        if (straight > straightest) straightest = straight, best = e;
      }
      if (best < 0) return;
      used_[at(best)] = true;
      chain.nodes.push_back(other_end(best, tip));
      chain.elements.push_back(best);
    }
  }

  Index other_end(Index e, Index node) const {
    const auto& ends = model_.elements[at(e)];
    return ends[0] == node ? ends[1] : ends[0];
  }

  const ResultModel& model_;
  const std::vector<Vec3>& position_;
  std::vector<bool> used_;
  std::vector<std::vector<Index>> incident_;
};

}  // namespace

std::vector<Chain> element_chains(const ResultModel& model, const std::vector<Vec3>& position) {
  return Stringer(model, position).chains();
}

std::vector<Chain> chosen_chains(const std::vector<Chain>& chains, std::size_t most_elements) {
  std::size_t total = 0;
  for (const Chain& chain : chains) total += chain.elements.size();
  if (total <= most_elements) return chains;
  const double share = static_cast<double>(most_elements) / static_cast<double>(total);
  std::vector<Chain> chosen;
  int part = -1;
  double credit = 1;
  for (const Chain& chain : chains) {
    if (chain.part != part) part = chain.part, credit = 1;  // the first chain of each part stays
    if (credit >= 1) {
      chosen.push_back(chain);
      credit -= 1;
    }
    credit += share;
  }
  return chosen;
}

int tension_level(double tension, double reference) {
  if (tension <= kSlack) return 0;
  return tension < 0.1 * reference ? 1 : tension < reference ? 2 : 3;
}

double tension_reference(std::vector<double> greatest) {
  std::erase_if(greatest, [](double value) { return !(value > kSlack); });
  if (greatest.empty()) return 1;
  const auto middle = greatest.begin() + static_cast<std::ptrdiff_t>(greatest.size() / 2);
  std::nth_element(greatest.begin(), middle, greatest.end());
  const double power = std::pow(10.0, std::floor(std::log10(*middle)));
  const double lead = *middle / power;
  return power * (lead < 2 ? 1 : lead < 5 ? 2 : 5);
}

}  // namespace cinch
