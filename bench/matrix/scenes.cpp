// The scenes that several groups of the matrix share.
#include "scenes.hpp"

#include <cmath>
#include <random>

#include "plan/preparation.hpp"

namespace cinch::matrix {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  return Vec3(any(random), any(random), any(random)).normalized();
}

double wave_speed(const Material& m) { return std::sqrt(m.youngs_modulus / m.density); }

/// A thirtieth of what a strain of 1 % gives: nothing turns slack.
double shake_speed(const Scene& scene) { return 3e-4 * wave_speed(scene.materials.at("m")); }

}  // namespace

Scene plain_scene() {
  Scene scene;
  scene.name = "stability";
  scene.time.end = 1;
  Material m;
  m.name = "m";
  m.youngs_modulus = 1e9;
  m.density = 970;
  scene.materials["m"] = m;
  return scene;
}

Thread& add_thread(Scene& scene, const std::string& name, std::vector<Vec3> points, int elements) {
  Thread thread;
  thread.name = name;
  thread.material = "m";
  thread.diameter = 0.002;
  thread.points = std::move(points);
  thread.elements = elements;
  return scene.threads.emplace_back(thread);
}

Ring& add_ring(Scene& scene, const std::string& name, const Vec3& center, const Vec3& normal) {
  Ring ring;
  ring.name = name;
  ring.diameter = 0.02;
  ring.wire_diameter = 0.004;
  ring.mass = 0.006;
  ring.youngs_modulus = 70e9;
  ring.center = center;
  ring.normal = normal.normalized();
  ring.joint = RingJoint::contact;
  return scene.rings.emplace_back(ring);
}

BallTarget& add_ball(Scene& scene, const Vec3& center) {
  return scene.targets.emplace_back(BallTarget{"ball", center, 0.15, 2.3e9, 0.39, {}, {}});
}

Net& add_net(Scene& scene, int columns, int rows) {
  Net net;
  net.name = "main";
  net.material = "m";
  net.diameter = 0.002;
  net.mesh = 0.1;
  net.width = 0.1 * columns;
  net.height = 0.1 * rows;
  return scene.nets.emplace_back(net);
}

void fix_edges(Net& net) {
  for (int i = 0; i <= net.columns(); ++i)
    for (int j = 0; j <= net.rows(); ++j)
      if (i % net.columns() == 0 || j % net.rows() == 0)
        net.nodes["knot." + std::to_string(i) + "." + std::to_string(j)].support = Support::fixed;
}

Scene at_fraction(Scene scene, double fraction) {
  scene.time.step = 0;
  scene.time.step = fraction * prepare(scene).stable_step;
  scene.time.allow_unstable = fraction > 1;
  return scene;
}

Scene tense_chain(int elements, double damping) {
  Scene scene = plain_scene();
  scene.materials["m"].damping_ratio = damping;
  Thread& thread = add_thread(scene, "main", {Vec3::Zero(), Vec3(0.01 * elements, 0, 0)}, elements);
  thread.length = 0.01 * elements / 1.01;
  thread.start.support = thread.end.support = Support::fixed;
  std::mt19937 random(1);
  for (int i = 1; i < elements; ++i) thread.nodes[i].velocity = shake_speed(scene) * random_direction(random);
  return scene;
}

Scene tense_net(double damping) {
  Scene scene = plain_scene();
  scene.materials["m"].damping_ratio = damping;
  const double speed = shake_speed(scene);
  Net& net = add_net(scene, 4, 3);
  net.stowed_factor = 1.01;
  fix_edges(net);
  std::mt19937 random(2);
  for (int i = 1; i < 4; ++i)
    for (int j = 1; j < 3; ++j)
      net.nodes["knot." + std::to_string(i) + "." + std::to_string(j)].velocity =
          speed * random_direction(random);
  return scene;
}

Scene tense_junction(double damping) {
  Scene scene = plain_scene();
  scene.materials["m"].damping_ratio = damping;
  const double speed = shake_speed(scene);
  std::mt19937 random(3);
  const Vec3 axes[] = {Vec3(1, 0, 0), Vec3(1, 2, 0), Vec3(-0.5, 1, 1)};
  for (const double way : {0.1, -0.1})
    for (const Vec3& axis : axes) {
      Thread& thread = add_thread(scene, "t" + std::to_string(scene.threads.size()),
                                  {Vec3::Zero(), way * axis.normalized()}, 4);
      thread.length = 0.1 / 1.01;
      if (scene.threads.size() > 1) thread.start.on = "thread.t0.start";
      thread.end.support = Support::fixed;
      for (int i = 1; i < 4; ++i) thread.nodes[i].velocity = speed * random_direction(random);
    }
  return scene;
}

}  // namespace cinch::matrix
