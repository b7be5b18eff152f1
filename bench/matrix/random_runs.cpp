// Whatever a scene is made of, it must hold or be stopped.
#include "random_runs.hpp"

#include "draw.hpp"
#include "scenes.hpp"
#include "watch.hpp"

namespace cinch::matrix {
namespace {

/// Somewhere on the first thread or net.
Vec3 place_in(Dice& dice, const Scene& scene) {
  if (!scene.nets.empty()) return 0.1 * dice.vector();
  const auto& points = scene.threads[0].points;
  return points[0] + dice.uniform(0, 1) * (points[1] - points[0]);
}

void add_random_ring(Dice& dice, Scene& scene) {
  Ring& ring =
      add_ring(scene, "hoop" + std::to_string(scene.rings.size()), place_in(dice, scene), dice.vector());
  ring.diameter = dice.log_uniform(5e-3, 0.1);
  ring.wire_diameter = ring.diameter * dice.uniform(0.02, 0.3);
  ring.mass = dice.log_uniform(1e-5, 1);
  ring.youngs_modulus = dice.log_uniform(1e5, 1e12);
  ring.support = dice.chance(0.3) ? Support::fixed : Support::free;
  ring.velocity = dice.log_uniform(1e-2, 30) * dice.vector();
}

/// Slack or taut, thrown, with what it may hit.
Scene random_scene(unsigned seed) {
  Dice dice(seed);
  Scene scene = draw_scene(dice, static_cast<Family>(dice.whole(1, 3)));
  scene.contact.alpha_ring = scene.contact.alpha_target = dice.chance(0.3) ? 0 : dice.log_uniform(1e-2, 1);
  if (dice.chance(0.5)) scene.gravity = gravity * dice.vector();
  const bool slack = dice.chance(0.5);
  for (Thread& thread : scene.threads) {
    thread.velocity = dice.log_uniform(1e-2, 30) * dice.vector();
    if (slack) thread.length = 0;
  }
  for (Net& net : scene.nets) {
    net.velocity = dice.log_uniform(1e-2, 30) * dice.vector();
    if (slack) net.stowed_factor = dice.log_uniform(0.01, 1);
  }
  for (int rings = dice.whole(0, 2); rings > 0; --rings) add_random_ring(dice, scene);
  if (!scene.rings.empty() && dice.chance(0.3)) scene.rings.back().joint = RingJoint::sliding;
  if (dice.chance(0.5)) add_ball(scene, 0.3 * dice.vector()).youngs_modulus = dice.log_uniform(1e5, 1e11);
  scene.time.safety = dice.uniform(0.1, 0.99);
  return scene;
}

}  // namespace

Outcome random_runs(int count) {
  int held = 0, stopped = 0, refused = 0;
  Outcome all{Verdict::held, 0, 0, ""};
  for (int run = 1; run <= count; ++run) {
    const Outcome one = watch([run] { return random_scene(static_cast<unsigned>(run)); }, {2000, 20});
    if (one.verdict == Verdict::failed)
      return {one.verdict, one.residual, one.steps, "seed " + std::to_string(run) + ": " + one.message};
    ++(one.verdict == Verdict::held ? held : one.steps > 0 ? stopped : refused);
    all.steps += one.steps;
  }
  all.message = std::to_string(held) + " held, " + std::to_string(stopped) + " stopped, " +
                std::to_string(refused) + " refused before the first step";
  return all;
}

}  // namespace cinch::matrix
