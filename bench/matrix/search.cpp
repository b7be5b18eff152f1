// Each scene is drawn from its seed alone, so that a counter-example can be drawn again.
#include "search.hpp"

#include <cmath>

#include "plan/preparation.hpp"
#include "spectrum.hpp"

namespace cinch::matrix {
namespace {

struct Drawn {
  Model model;
  std::vector<Vec3> place;
};

// ---- any graph

void join(Dice& dice, bool damped, Index a, Index b, Drawn& to) {
  Model& m = to.model;
  const double length =
      (to.place[static_cast<std::size_t>(b)] - to.place[static_cast<std::size_t>(a)]).norm();
  m.end_a.push_back(a);
  m.end_b.push_back(b);
  m.stiffness.push_back(dice.log_uniform(1e-2, 1e4));
  m.damping.push_back(damped ? dice.log_uniform(1e-4, 10) : 0.0);
  m.rest_length.push_back(length / dice.uniform(1, 3));
  m.elements += 1;
}

Drawn draw_graph(Dice& dice) {
  Drawn out;
  Model& m = out.model;
  m.nodes = dice.whole(2, 12);
  const bool damped = dice.chance(0.5);
  for (Index i = 0; i < m.nodes; ++i) {
    m.mass.push_back(dice.log_uniform(1e-6, 1));
    out.place.push_back(dice.vector());
    const double mass = m.mass.back();
    if (i == 0 || !dice.chance(0.2)) continue;
    const Vec3 axis = dice.chance(0.5) ? Vec3(Vec3::Zero()) : Vec3(dice.vector().normalized());
    m.constraints.push_back({i, axis.x(), axis.y(), axis.z(), mass});
  }
  for (Index i = 1; i < m.nodes; ++i) join(dice, damped, dice.whole(0, i - 1), i, out);
  for (int extra = dice.whole(0, 2 * m.nodes); extra > 0; --extra) {
    const Index a = dice.whole(0, m.nodes - 1), b = dice.whole(0, m.nodes - 1);
    if (a != b) join(dice, damped, a, b, out);
  }
  return out;
}

Drawn draw(Family family, unsigned seed) {
  Dice dice(seed);
  if (family == Family::graph) return draw_graph(dice);
  Scene scene = draw_scene(dice, family);
  scene.time.end = 1e-12;  // some have steps so short that a second of them would be refused
  Preparation p = prepare(scene);
  return {std::move(p.phases.front().model), places(p.assembly)};
}

}  // namespace

Found search(Family family, int trials) {
  Found found;
  for (; found.trials < trials; ++found.trials) {
    const auto seed = static_cast<unsigned>(found.trials + 1);
    const Drawn drawn = draw(family, seed);
    const double step = stable_step(drawn.model).step;
    if (!std::isfinite(step)) continue;  // all its nodes are held
    const double usage = largest_usage(drawn.model, drawn.place, step);
    if (!(usage <= 1 + 1e-9)) ++found.counter_examples;  // rounding of eigenvalues over many decades
    if (!(usage <= found.worst)) found.worst = usage, found.seed = seed;
  }
  return found;
}

}  // namespace cinch::matrix
