// Scenes of hard and awkward motion.
#include "motion_scenes.hpp"

#include <cmath>

namespace cinch::matrix {
namespace {

constexpr double ball_radius = 0.15, thread_radius = 0.001, ring_radius = 0.01, wire_radius = 0.002;
constexpr double gap = 1e-4;  // m, before an impact

/// A mass of 50 g that a slack thread follows; it flies along `way`, at `from` it touches.
Scene striker(const Vec3& touch, const Vec3& way, double speed) {
  Scene scene = plain_scene();
  const Vec3 start = touch - gap * way;
  Thread& thread = add_thread(scene, "main", {start, start - 0.05 * way}, 5);
  thread.length = 0.1;
  thread.start.mass = 0.05;
  thread.velocity = speed * way;
  return scene;
}

/// A thread of 0.1 m along X through `middle`, a mass of 10 g at each end, that moves.
Scene flying_thread(const Vec3& middle, const Vec3& velocity, int elements = 20) {
  Scene scene = plain_scene();
  Thread& thread =
      add_thread(scene, "main", {middle - Vec3(0.05, 0, 0), middle + Vec3(0.05, 0, 0)}, elements);
  thread.velocity = velocity;
  thread.start.mass = thread.end.mass = 0.01;
  return scene;
}

/// The height of the thread's middle, at which it touches the lowest point of the wire from inside.
constexpr double inside = ring_radius - wire_radius - thread_radius;

}  // namespace

Scene mass_on_ball(double speed) {
  Scene scene = striker(Vec3(0, 0, ball_radius + thread_radius), Vec3(0, 0, -1), speed);
  add_ball(scene, Vec3::Zero());
  return scene;
}

Scene thread_on_ball(double speed) {
  Scene scene = flying_thread(Vec3(0.001, 0, ball_radius + thread_radius + gap), Vec3(0, 0, -speed));
  add_ball(scene, Vec3::Zero());
  return scene;
}

Scene mass_on_wire(double speed) {
  Scene scene = striker(Vec3(0, 0, wire_radius + thread_radius), Vec3(0, 0, -1), speed);
  add_ring(scene, "r", Vec3(ring_radius, 0, 0), Vec3::UnitZ());
  return scene;
}

Scene mass_on_rim(double speed) {
  Scene scene = striker(Vec3(-wire_radius - thread_radius, 0, 0), Vec3(1, 0, 0), speed);
  add_ring(scene, "r", Vec3(ring_radius, 0, 0), Vec3::UnitZ());
  return scene;
}

Scene thread_in_ring(double speed) {
  Scene scene = flying_thread(Vec3(0.001, 0, -inside + gap), Vec3(0, 0, -speed));
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  return scene;
}

Scene thread_outside_ring(double speed) {
  Scene scene =
      flying_thread(Vec3(0.001, 0, ring_radius + wire_radius + thread_radius + gap), Vec3(0, 0, -speed));
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  return scene;
}

// ---- places

Scene thread_on_axis() {
  Scene scene = tense_chain(20, 0.106);
  for (auto& [number, node] : scene.threads[0].nodes) node.velocity = Vec3(0.1 * (number % 3 - 1), 0, 0);
  add_ring(scene, "r", Vec3(0.1, 0, 0), Vec3::UnitX());
  return scene;
}

Scene thread_across_ring() {
  Scene scene = flying_thread(Vec3::Zero(), Vec3(0, 0.1, 0));
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitZ());
  return scene;
}

Scene thread_in_plane() {
  Scene scene = flying_thread(Vec3(0, ring_radius + wire_radius + thread_radius + gap, 0), Vec3(0, -0.1, 0));
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitZ());
  return scene;
}

Scene two_rings() {
  Scene scene = flying_thread(Vec3(0, 0, -inside + gap), Vec3(0, 0, -1));
  add_ring(scene, "r", Vec3(0.002, 0, 0), Vec3::UnitX());
  add_ring(scene, "s", Vec3(-0.002, 0, 0), Vec3::UnitX());
  return scene;
}

Scene ring_neighbours() {
  Scene scene = flying_thread(Vec3(0, 0, -inside + gap), Vec3(0, 0, -1));
  add_thread(scene, "host", {Vec3(-0.03, 0, 0), Vec3(0.03, 0, 0)}, 6);
  for (const int element : {2, 3}) {
    Ring& ring = add_ring(scene, "r" + std::to_string(element), Vec3::Zero(), Vec3::UnitX());
    ring.host = RingHost::element;
    ring.element_of = "thread.host";
    ring.element = element;
    ring.threads = {"main"};
  }
  return scene;
}

Scene ring_at_end() {
  Scene scene = flying_thread(Vec3(0.045, 0, -inside + gap), Vec3(0, 0, -1));
  add_thread(scene, "host", {Vec3(-0.1, 0, 0), Vec3(0.05, 0, 0)}, 15);
  Ring& ring = add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  ring.host = RingHost::element;
  ring.element_of = "thread.host";
  ring.element = 14;
  ring.threads = {"main"};
  return scene;
}

Scene short_elements() {
  Scene scene = flying_thread(Vec3(0, 0, -inside + gap), Vec3(0, 0, -1), 500);
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  return scene;
}

Scene long_elements() {
  Scene scene = flying_thread(Vec3(0.01, 0, -inside + gap), Vec3(0, 0, -1), 1);
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  return scene;
}

Scene wire_at_rest() {
  Scene scene = flying_thread(Vec3(0, 0, -inside), Vec3::Zero());
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  return scene;
}

Scene wire_pressed() {
  Scene scene = flying_thread(Vec3(0, 0, -inside - 1e-6), Vec3::Zero());
  add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  return scene;
}

Scene ball_at_rest() {
  Scene scene = striker(Vec3(0, 0, ball_radius + thread_radius - gap), Vec3(0, 0, -1), 0);
  add_ball(scene, Vec3::Zero());
  return scene;
}

Scene idle_thread() {
  Scene scene = plain_scene();
  add_thread(scene, "main", {Vec3::Zero(), Vec3(0.05, 0, 0)}, 10).length = 0.1;
  return scene;
}

Scene folded_net(double factor) {
  Scene scene = plain_scene();
  Net& net = add_net(scene, 5, 5);
  net.stowed_factor = factor;
  net.nodes["top_left"].velocity = Vec3(-5, 5, 3);
  net.nodes["top_right"].velocity = Vec3(5, 5, 3);
  net.nodes["bottom_left"].velocity = Vec3(-5, -5, 3);
  net.nodes["bottom_right"].velocity = Vec3(5, -5, 3);
  for (auto& [place, node] : net.nodes) node.mass = 0.05;
  return scene;
}

Scene folded_ringed_net() {
  Scene scene = folded_net(1e-12);
  for (const int element : {1, 3}) {
    Ring& ring = add_ring(scene, "r" + std::to_string(element), Vec3::Zero(), Vec3::UnitX());
    ring.host = RingHost::element;
    ring.element_of = "net.main.top";
    ring.element = element;
  }
  add_thread(scene, "through", {Vec3(-0.1, 0, 0), Vec3(0.1, 0, 0)}, 40);
  return scene;
}

Scene closing_net(double time) {
  Scene scene = plain_scene();
  scene.gravity = Vec3(0, 0, -gravity);
  Net& net = add_net(scene, 5, 2);
  net.y_axis = Vec3::UnitZ();
  net.nodes["top_left"].support = net.nodes["top_right"].support = Support::fixed;
  for (const int element : {1, 3}) {
    Ring& ring = add_ring(scene, "r" + std::to_string(element), Vec3::Zero(), Vec3::UnitX());
    ring.host = RingHost::element;
    ring.element_of = "net.main.bottom";
    ring.element = element;
  }
  Thread& thread = add_thread(scene, "closing", {}, 120);
  thread.along = {"net.main.bottom"};
  thread.overhang_start = thread.overhang_end = 0.05;
  thread.start.mass = thread.end.mass = 0.05;
  scene.closing.time = time;
  return scene;
}

Scene separating_net(double time) {
  Scene scene = plain_scene();
  Net& net = add_net(scene, 3, 3);
  net.stowed_factor = 0.5;
  Mechanism mechanism;
  mechanism.name = "m1";
  mechanism.corner = "net.main.top_left";
  mechanism.towing_material = "m";
  mechanism.towing_diameter = 0.002;
  mechanism.towing_length = 0.1;
  mechanism.initial_stretch = 0.5;
  mechanism.launcher_mass = mechanism.split_mass = 0.05;
  mechanism.launch_velocity = Vec3(-1, 1, 1);
  mechanism.separation_a = Vec3(-2, -2, 0);
  mechanism.separation_b = Vec3(2, 2, 0.5);
  scene.mechanisms.push_back(mechanism);
  Thread& thread = add_thread(scene, "closing", {}, 60);
  thread.along = {"mechanism.m1", "net.main.top"};
  thread.length = 0.4;
  thread.start.on = "mechanism.m1.b";
  scene.closing.time = time;
  return scene;
}

Scene net_on_ball(double modulus, int elements_per_side, double alpha) {
  Scene scene = plain_scene();
  scene.contact.alpha_target = alpha;
  Net& net = add_net(scene, 4, 4);
  net.elements_per_side = elements_per_side;
  net.center = Vec3(0.01, 0.02, 0.202);
  net.velocity = Vec3(0, 0, -2);
  for (const char* corner : {"top_left", "top_right", "bottom_left", "bottom_right"})
    net.nodes[corner].mass = 1;
  BallTarget& ball = add_ball(scene, Vec3::Zero());
  ball.radius = 0.2;
  ball.youngs_modulus = modulus;
  return scene;
}

// ---- known to win energy

Scene node_beside_rim(double damping, double fraction) {
  Scene scene = plain_scene();
  scene.materials["m"].damping_ratio = damping;
  const double drop = 0.02, beyond = 1e-5;  // m
  Thread& thread = add_thread(scene, "main", {Vec3(-0.1, 0, 0), Vec3(0, 0, -drop), Vec3(0.1, 0, 0)}, 8);
  thread.length = 2 * std::hypot(0.1, drop) / 1.01;
  thread.start.support = thread.end.support = Support::fixed;
  Ring& ring = add_ring(scene, "r", Vec3(beyond, 0, -drop - inside + 0.001), Vec3::UnitX());
  ring.support = Support::fixed;
  ring.joint = RingJoint::sliding;
  return at_fraction(scene, fraction);
}

Scene end_into_ring(double end_mass, double fraction) {
  Scene scene = plain_scene();
  Thread& thread = add_thread(scene, "main", {Vec3(-0.2, 0, 0), Vec3(0.03, 0, 0)}, 10);
  thread.start.mass = 0.1;
  thread.start.velocity = Vec3(-1, 0, -0.5);
  thread.end.mass = end_mass;
  Ring& ring = add_ring(scene, "r", Vec3::Zero(), Vec3::UnitX());
  ring.support = Support::fixed;
  ring.joint = RingJoint::sliding;
  return at_fraction(scene, fraction);
}

}  // namespace cinch::matrix
