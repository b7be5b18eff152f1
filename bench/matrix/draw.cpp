// Masses, stiffnesses, dampers, supports and places at random.
#include "draw.hpp"

#include "scenes.hpp"

namespace cinch::matrix {
namespace {

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

}  // namespace

Scene draw_scene(Dice& dice, Family family) {
  return family == Family::chain      ? draw_chain(dice)
         : family == Family::junction ? draw_junction(dice)
                                      : draw_net(dice);
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
