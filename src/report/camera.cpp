#include "report/camera.hpp"

#include <algorithm>
#include <cmath>

namespace cinch {
namespace {

struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  void add(const Vec3& p, double radius = 0) {
    low = low.cwiseMin(p - Vec3::Constant(radius));
    high = high.cwiseMax(p + Vec3::Constant(radius));
  }
};

Box box_of(const ResultModel& model, const Frame& first, const Frame& last) {
  Box box;
  for (const Frame* frame : {&first, &last}) {
    for (const Vec3& p : frame->position) box.add(p);
    for (const Vec3& p : frame->ring_center) box.add(p);
  }
  for (const auto& ball : model.balls) box.add(ball.center, ball.radius);
  return box;
}

// The axis along which the net is thinnest at the start, `up` excepted: one looks along it.
Vec3 thinnest_axis(const Frame& first, const Vec3& up) {
  Box box;
  for (const Vec3& p : first.position) box.add(p);
  Vec3 best = Vec3::UnitZ();
  double least = 1e300;
  for (const int axis : {2, 0, 1}) {
    if (std::abs(up[axis]) > 0.7) continue;
    const double extent = box.high[axis] - box.low[axis];
    if (extent < least - 1e-9) least = extent, best = Vec3::Unit(axis);
  }
  return best;
}

Vec3 viewpoint(const Frame& first, const ViewHints& hints, const Vec3& up) {
  if (hints.pull_along_y) return {0.92, -0.28, 0.26};
  if (!hints.gravity)
    return {-0.70, 0.42, 0.62};  // the flight along Z runs to the right and towards the viewer
  Vec3 normal = thinnest_axis(first, up);
  if (up.cross(normal).dot(hints.rightwards) < 0) normal = -normal;
  return normal + 0.15 * up;  // nearly from the front, so that heights can be compared
}

}  // namespace

Camera Camera::looking(const Vec3& target, const Vec3& from, const Vec3& above, double distance) {
  Camera camera;
  camera.target = target;
  camera.distance = distance;
  camera.toward = from.normalized();
  camera.right = above.cross(camera.toward).normalized();
  camera.up = camera.toward.cross(camera.right);
  return camera;
}

Seen Camera::see(const Vec3& point) const {
  const Vec3 p = point - target;
  const double depth = p.dot(toward);
  const double size = distance / std::max(distance - depth, 0.05 * distance);
  return {p.dot(right) * size, p.dot(up) * size, depth, size};
}

Camera choose_camera(const ResultModel& model, const Frame& first, const Frame& last,
                     const ViewHints& hints) {
  const Box box = box_of(model, first, last);
  Vec3 up = Vec3::UnitY();
  if (hints.pull_along_y) up = Vec3::UnitZ();
  if (hints.gravity) up = -hints.gravity->normalized();
  const double size = std::max((box.high - box.low).norm(), 1e-6);
  return Camera::looking((box.low + box.high) / 2, viewpoint(first, hints, up), up, 3.2 * size);
}

std::vector<bool> present_nodes(const ResultModel& model, const Frame& frame) {
  std::vector<bool> has_element(frame.position.size(), false), present(frame.position.size(), false);
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    for (const Index node : model.elements[e]) {
      has_element[static_cast<std::size_t>(node)] = true;
      if (frame.active[e]) present[static_cast<std::size_t>(node)] = true;
    }
  for (std::size_t i = 0; i < present.size(); ++i) present[i] = present[i] || !has_element[i];
  return present;
}

}  // namespace cinch
