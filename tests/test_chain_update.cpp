// Kernels that compute and move a chain, in two passes or, where the instruction set has it, in one: the same
// bits in every number that they write as loops over single elements and nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "base/aligned.hpp"
#include "kernels/axial_law.hpp"
#include "kernels/kernel_table.hpp"

namespace {

using namespace cinch;
using kernel::lanes;

constexpr Index groups = 37, nodes = groups * lanes, first = 3 * lanes;  // rows of the ledger begin inside
constexpr Index rows = (first + nodes) / kernel::grain + 1;

// A chain of random elements, a third of them slack, in the first `idle` groups all, and random forces of
// other runs on its nodes. One damper of those that idle has not yet booked its last pull.
struct Chain {
  AlignedVector<double> field[6], scale, load[3], force[3], palette, booked, damper;
  std::vector<Index> parameter;
  static constexpr Index plus = lanes, others = plus + nodes + lanes;

  Chain(bool damped, Index idle) {
    std::mt19937 random(5);
    const auto draw = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (auto& f : field)
      for (Index i = 0; i < nodes + lanes; ++i) f.push_back(draw(-1e-4, 1e-4));
    for (Index i = 0; i < nodes + lanes; ++i) {
      field[0][static_cast<std::size_t>(i)] += 0.005 * i - 0.001 * std::min(i, idle * lanes);
      for (std::size_t f = 3; f < 6; ++f) field[f][static_cast<std::size_t>(i)] *= 1e5;
      scale.push_back(draw(0.01, 0.1));
    }
    for (auto& f : load)
      for (Index i = 0; i < nodes + lanes; ++i) f.push_back(draw(-100, 100));
    for (auto& f : force)
      for (Index i = 0; i < others + 5 * (nodes + lanes); ++i) f.push_back(draw(-100, 100));
    for (int row = 0; row < 4; ++row) {
      for (Index lane = 0; lane < lanes; ++lane) palette.push_back(draw(1e5, 1e6));
      for (Index lane = 0; lane < lanes; ++lane) palette.push_back(damped ? draw(0.1, 1) : 0);
      for (Index lane = 0; lane < lanes; ++lane)
        palette.push_back(row == 3 && lane == 5 ? 1e300 : draw(0.0049, 0.00503));
      for (Index lane = 0; lane < lanes; ++lane) palette.push_back(draw(0, 2e-6));
    }
    for (Index g = 0; g < groups; ++g) parameter.push_back(static_cast<Index>(random() % 4));
    for (Index i = 0; i < rows * lanes; ++i) booked.push_back(draw(0, 1));
    for (Index i = 0; i < nodes; ++i) damper.push_back(i < idle * lanes ? 0 : draw(-1, 1));
    if (idle > 2) damper[2 * lanes + 3] = 0.7;
  }

  kernel::AxialArguments axial() {
    return {field[0].data(), field[1].data(), field[2].data(),  field[3].data(),
            field[4].data(), field[5].data(), parameter.data(), palette.data(),
            force[0].data(), force[1].data(), force[2].data(),  booked.data(),
            damper.data(),   nullptr,         nullptr,          1e-6};
  }
  kernel::NodeArguments node() {
    return {field[0].data(), field[1].data(), field[2].data(),     field[3].data(),
            field[4].data(), field[5].data(), scale.data(),        force[0].data(),
            force[1].data(), force[2].data(), {1e-6, -2e-6, 3e-6}, 1e-6,
            load[0].data(),  load[1].data(),  load[2].data()};
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

struct Update {
  Damping damping;
  bool gravity;
  kernel::Moving::Kind kind;
  Index terms, idle;

  bool damped() const { return damping != Damping::none; }
  bool ledger() const { return damping == Damping::booked; }
};

// The plain reference: element k joins nodes k and k + 1. Returns how many turn taut or slack.
int compute(Chain& c, bool ledger) {
  int switched = 0;
  const kernel::AxialArguments g = c.axial();
  for (Index k = 0; k < nodes; ++k) {
    const Index group = k / lanes, lane = k % lanes;
    const double* const row = g.palette + kernel::palette_fields * lanes * g.parameter[group] + lane;
    const plain::V3 r{g.x[k + 1] - g.x[k], g.y[k + 1] - g.y[k], g.z[k + 1] - g.z[k]};
    const plain::V3 v{g.vx[k + 1] - g.vx[k], g.vy[k + 1] - g.vy[k], g.vz[k + 1] - g.vz[k]};
    const plain::Axial item =
        plain::axial_law(dot(r, r), dot(r, v), row[0], row[lanes], row[2 * lanes], g.dt, row[3 * lanes]);
    g.fx[Chain::plus + k] = item.per_length * r.x;
    g.fy[Chain::plus + k] = item.per_length * r.y;
    g.fz[Chain::plus + k] = item.per_length * r.z;
    switched += item.spare < 0;
    if (!ledger) continue;
    double& before = g.damper[k];
    g.booked[(first + k) / kernel::grain * lanes + lane] += 0.5 * (item.damper + before) * item.rate;
    before = item.damper;
  }
  return switched;
}

// Returns the greatest squared speed.
double move(Chain& c, const kernel::Stretch& s, bool gravity, bool loaded) {
  const kernel::NodeArguments g = c.node();
  double greatest = 0;
  for (Index k = 0; k < nodes; ++k) {
    double squared = 0;
    const auto axis = [&](double* x, double* v, const double* force, const double* load, double pull) {
      double sum = force[s.plus[0] + k] - force[s.minus[0] + k];
      for (Index t = 1; t < s.terms; ++t) sum += force[s.plus[t] + k] - force[s.minus[t] + k];
      if (loaded) sum += load[k];
      const double gain = g.scale[k] * sum;
      v[k] += gravity ? gain + pull : gain;
      x[k] += g.dt * v[k];
      squared += v[k] * v[k];
    };
    axis(g.x, g.vx, g.fx, g.load_x, g.gravity[0]);
    axis(g.y, g.vy, g.fy, g.load_y, g.gravity[1]);
    axis(g.z, g.vz, g.fz, g.load_z, g.gravity[2]);
    greatest = std::max(greatest, squared);
  }
  return greatest;
}

// `forces_from`: the first node whose element's force must have been written.
void expect_same(const Chain& a, const Chain& b, Index forces_from) {
  for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(a.field[f], b.field[f]) << "field " << f;
  EXPECT_EQ(a.booked, b.booked);
  EXPECT_EQ(a.damper, b.damper);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (Index k = forces_from; k < nodes; ++k) {
      const auto i = static_cast<std::size_t>(Chain::plus + k);
      EXPECT_EQ(a.force[axis][i], b.force[axis][i]) << "element " << k;
    }
}

class ChainUpdate
    : public testing::TestWithParam<std::tuple<Damping, bool, kernel::Moving::Kind, Index, Index>> {
 protected:
  Update update() const {
    const auto [damping, gravity, kind, terms, idle] = GetParam();
    return {damping, gravity, kind, terms, idle};
  }
};

TEST_P(ChainUpdate, HasTheBitsOfSingleElementsAndNodes) {
  const Update u = update();
  const kernel::Stretch gathered = stretch(u.terms);
  const auto spans =
      kernels().axial_spans[u.damped()][u.ledger() ? kernel::Book::power : kernel::Book::nothing];
  const auto move_nodes = kernels().move_nodes[u.gravity][u.kind];
  const auto one_pass = kernels().update_chain[u.damped()][u.ledger()][u.gravity][u.kind];
  EXPECT_EQ(one_pass != nullptr, std::string(kernels().isa) == "v4") << "the set that has it";
  const Chain begin(u.damped(), u.idle);
  Chain single = begin, two = begin, one = begin;
  int switched = 0;
  for (int step = 0; step < 3; ++step) {
    switched += compute(single, u.ledger());
    const double greatest = move(single, gathered, u.gravity, u.kind == kernel::Moving::loaded);
    const double watched = u.kind == kernel::Moving::blind ? 0 : greatest;
    spans(two.axial(), &span, 0, 1);
    EXPECT_EQ(move_nodes(two.node(), &gathered, 0, 1), watched);
    if (!one_pass) continue;
    EXPECT_EQ(one_pass(one.axial(), one.node(), span, gathered), watched);
  }
  EXPECT_EQ(switched > 0, u.idle < groups) << "some turn taut or slack";
  EXPECT_NE(single.booked == begin.booked, u.ledger());
  expect_same(single, two, 0);
  if (one_pass) expect_same(single, one, nodes - lanes);  // what the node behind the chain takes
}

INSTANTIATE_TEST_SUITE_P(
    All, ChainUpdate,
    testing::Combine(testing::Values(Damping::none, Damping::unbooked, Damping::booked), testing::Bool(),
                     testing::Values(kernel::Moving::blind, kernel::Moving::watched, kernel::Moving::loaded),
                     testing::Values(1, 2, 3), testing::Values(0, 5, groups)));

}  // namespace
