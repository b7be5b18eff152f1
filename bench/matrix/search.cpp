// Each scene is drawn from its seed alone, so that a counter-example can be drawn again.
#include "search.hpp"

#include <cmath>
#include <random>

#include "scenes.hpp"
#include "spectrum.hpp"

namespace cinch::matrix {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool chance(double share) { return uniform(0, 1) < share; }
  Vec3 vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

 private:
  std::mt19937 engine_;
};

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

// ---- scenes, through the solver's own assembly

void draw_material(Dice& dice, Scene& scene, const std::string& name) {
  Material m = scene.materials.at("m");
  m.name = name;
  m.youngs_modulus = dice.log_uniform(1e6, 1e12);
  m.damping_ratio = dice.chance(0.3) ? 0 : dice.log_uniform(1e-3, 10);
  m.damping_rule = dice.chance(0.5) ? DampingRule::element : DampingRule::stiffness;
  m.damping_frequency = dice.log_uniform(1, 1e5);
  scene.materials[name] = m;
}

NodeSpec draw_node(Dice& dice) {
  NodeSpec node;
  if (dice.chance(0.3)) node.mass = dice.log_uniform(1e-6, 10);
  if (dice.chance(0.2)) node.support = dice.chance(0.5) ? Support::fixed : Support::guided;
  node.axis = dice.vector().normalized();
  return node;
}

/// A taut thread of a material of its own from a place to a random one; returns where it ends.
Vec3 draw_thread(Dice& dice, Scene& scene, const Vec3& from, const std::string& on) {
  const std::string name = "t" + std::to_string(scene.threads.size());
  draw_material(dice, scene, name);
  const Vec3 to = from + dice.log_uniform(1e-3, 1) * dice.vector().normalized();
  Thread& thread = add_thread(scene, name, {from, to}, dice.whole(1, 4));
  thread.material = name;
  thread.diameter = dice.log_uniform(1e-4, 1e-2);
  thread.length = (to - from).norm() / dice.uniform(1, 2);
  for (int i = 1; i < thread.elements; ++i) thread.nodes[i] = draw_node(dice);
  thread.start = thread.end = draw_node(dice);
  if (!on.empty()) thread.start = {}, thread.start.on = on;
  return to;
}

Scene draw_chain(Dice& dice) {
  Scene scene = plain_scene();
  Vec3 end = Vec3::Zero();
  for (int k = dice.whole(1, 4); k > 0; --k)
    end = draw_thread(dice, scene, end,
                      scene.threads.empty() ? "" : "thread." + scene.threads.back().name + ".end");
  return scene;
}

Scene draw_junction(Dice& dice) {
  Scene scene = plain_scene();
  for (int k = dice.whole(2, 6); k > 0; --k)
    draw_thread(dice, scene, Vec3::Zero(), scene.threads.empty() ? "" : "thread.t0.start");
  return scene;
}

Scene draw_net(Dice& dice) {
  Scene scene = plain_scene();
  draw_material(dice, scene, "m");
  Net& net = add_net(scene, dice.whole(1, 3), dice.whole(1, 3));
  net.diameter = dice.log_uniform(1e-4, 1e-2);
  net.stowed_factor = dice.uniform(1, 2);
  for (int i = 0; i <= net.columns(); ++i)
    for (int j = 0; j <= net.rows(); ++j)
      net.nodes["knot." + std::to_string(i) + "." + std::to_string(j)] = draw_node(dice);
  if (dice.chance(0.5)) {
    Ring& ring = add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
    ring.host = RingHost::element;
    ring.element_of = "net.main.top";
    ring.mass = dice.log_uniform(1e-5, 1);
  }
  if (dice.chance(0.5)) draw_thread(dice, scene, net.center, "net.main.bottom_left");
  return scene;
}

Drawn draw(Family family, unsigned seed) {
  Dice dice(seed);
  if (family == Family::graph) return draw_graph(dice);
  const Scene scene = family == Family::chain      ? draw_chain(dice)
                      : family == Family::junction ? draw_junction(dice)
                                                   : draw_net(dice);
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

std::string name(Family family) {
  switch (family) {
    case Family::graph:
      return "graph";
    case Family::chain:
      return "chain";
    case Family::junction:
      return "junction";
    default:
      return "net";
  }
}

}  // namespace cinch::matrix
