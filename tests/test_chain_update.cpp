// The pass that computes and moves a chain at once, where this machine has one, beside the two passes that it
// stands for: the same bits in every number that they write.
#include <gtest/gtest.h>

#include <random>

#include "base/aligned.hpp"
#include "kernels/kernel_table.hpp"

namespace {

using namespace cinch;
using kernel::lanes;

constexpr Index groups = 37, nodes = groups * lanes, first = 3 * lanes;  // rows of the ledger begin inside

// A chain of random elements, a third of them slack, and random forces of other runs on its nodes.
struct Chain {
  AlignedVector<double> field[6], scale, force[3], palette, booked;
  std::vector<Index> parameter;
  static constexpr Index plus = lanes, others = plus + nodes + lanes;

  explicit Chain(bool damped) {
    std::mt19937 random(5);
    const auto draw = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (auto& f : field)
      for (Index i = 0; i < nodes + lanes; ++i) f.push_back(draw(-1e-4, 1e-4));
    for (Index i = 0; i < nodes + lanes; ++i) {
      field[0][static_cast<std::size_t>(i)] += 0.005 * i;
      for (std::size_t f = 3; f < 6; ++f) field[f][static_cast<std::size_t>(i)] *= 1e5;
      scale.push_back(draw(0.01, 0.1));
    }
    for (auto& f : force)
      for (Index i = 0; i < others + 5 * (nodes + lanes); ++i) f.push_back(draw(-100, 100));
    for (int row = 0; row < 4; ++row) {
      for (Index lane = 0; lane < lanes; ++lane) palette.push_back(draw(1e5, 1e6));
      for (Index lane = 0; lane < lanes; ++lane) palette.push_back(damped ? draw(0.1, 1) : 0);
      for (Index lane = 0; lane < lanes; ++lane)
        palette.push_back(row == 3 && lane == 5 ? 1e300 : draw(0.0049, 0.00503));
    }
    for (Index g = 0; g < groups; ++g) parameter.push_back(static_cast<Index>(random() % 4));
    for (Index i = 0; i < 4 * lanes; ++i) booked.push_back(draw(0, 1));
  }

  kernel::AxialArguments axial() {
    return {field[0].data(), field[1].data(), field[2].data(),  field[3].data(),
            field[4].data(), field[5].data(), parameter.data(), palette.data(),
            force[0].data(), force[1].data(), force[2].data(),  booked.data()};
  }
  kernel::NodeArguments node() {
    return {field[0].data(), field[1].data(), field[2].data(),     field[3].data(),
            field[4].data(), field[5].data(), scale.data(),        force[0].data(),
            force[1].data(), force[2].data(), {1e-6, -2e-6, 3e-6}, 1e-6};
  }
};

constexpr kernel::Span span{0, groups, 1, 0, Chain::plus, first, 0};

kernel::Stretch stretch(Index terms) {
  kernel::Stretch s{0, nodes, terms, {Chain::plus}, {Chain::plus - 1}};
  for (Index t = 1; t < terms; ++t) {
    s.plus[t] = Chain::others + 2 * t * (nodes + lanes) - 11;
    s.minus[t] = s.plus[t] - (nodes + lanes);
  }
  return s;
}

enum class Damping { none, unbooked, booked };  // without damping there is no power to book
using Update = std::tuple<Damping, bool, bool, Index>;
class ChainUpdate : public testing::TestWithParam<Update> {};

TEST_P(ChainUpdate, HasTheBitsOfTheTwoPasses) {
  const auto [damping, gravity, watch, terms] = GetParam();
  const bool damped = damping != Damping::none, ledger = damping == Damping::booked;
  const auto one_pass = kernels().update_chain[damped][ledger][gravity][watch];
  if (one_pass == nullptr) GTEST_SKIP() << "instruction set " << kernels().isa << " has no such pass";
  Chain a(damped), b(damped);
  const kernel::Stretch gathered = stretch(terms);
  const auto book = ledger ? kernel::Book::power : kernel::Book::nothing;
  for (int step = 0; step < 3; ++step) {
    kernels().axial_spans[damped][book](a.axial(), &span, 0, 1);
    const double greatest = kernels().move_nodes[gravity][watch](a.node(), &gathered, 0, 1);
    EXPECT_EQ(one_pass(b.axial(), b.node(), span, gathered), greatest);
    EXPECT_EQ(watch, greatest > 0);
  }
  for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(a.field[f], b.field[f]) << "field " << f;
  EXPECT_EQ(a.booked, b.booked);
  EXPECT_NE(a.booked == Chain(damped).booked, ledger);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index k = nodes - lanes; k < nodes; ++k) {
      const auto i = static_cast<std::size_t>(Chain::plus + k);
      EXPECT_EQ(a.force[axis][i], b.force[axis][i]) << "what the node behind the chain takes";
    }
}

INSTANTIATE_TEST_SUITE_P(All, ChainUpdate,
                         testing::Combine(testing::Values(Damping::none, Damping::unbooked, Damping::booked),
                                          testing::Bool(), testing::Bool(), testing::Values(1, 2, 3)));

}  // namespace
