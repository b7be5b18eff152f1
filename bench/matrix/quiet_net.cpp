// Drift over long rest: errors that add up would show as nodes that creep.
#include "quiet_net.hpp"

#include <algorithm>

#include "plan/simulation.hpp"
#include "scenes.hpp"

namespace cinch::matrix {
namespace {

Scene hanging_net() {
  Scene scene = plain_scene();
  scene.gravity = Vec3(0, 0, -gravity);
  scene.equilibrium = true;
  Net& net = add_net(scene, 3, 2);
  net.y_axis = Vec3::UnitZ();
  net.nodes["top_left"].support = net.nodes["top_right"].support = Support::fixed;
  net.nodes["bottom_left"].mass = 0.05;
  return scene;
}

}  // namespace

Outcome quiet_net(std::int64_t steps) {
  Simulation sim(hanging_net(), 1);
  const std::vector<Vec3> start = sim.look().positions();
  double moved = 0;
  for (int part = 1; part <= 10; ++part) {
    sim.advance_to(steps * part / 10);
    const std::vector<Vec3> now = sim.look().positions();
    for (std::size_t i = 0; i < start.size(); ++i) {
      const double distance = (now[i] - start[i]).norm();
      if (!(distance <= moved)) moved = distance;
    }
  }
  const bool rests = moved <= 1e-9;  // m: what the equilibrium's own residual lets it settle
  return {rests ? Verdict::held : Verdict::failed, sim.summary().relative_residual, sim.step(),
          "moved by " + words(moved) + " m"};
}

}  // namespace cinch::matrix
