#include "scene/mouth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/net_pattern.hpp"

namespace cinch {
namespace {

using Point = std::array<double, 2>;

double turn(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

// Andrew's monotone chain: one half of the convex hull of points sorted along x.
template <class Iterator>
std::vector<Point> half_hull(Iterator begin, Iterator end) {
  std::vector<Point> hull;
  for (; begin != end; ++begin) {
    while (hull.size() >= 2 && turn(hull[hull.size() - 2], hull.back(), *begin) <= 0) hull.pop_back();
    hull.push_back(*begin);
  }
  hull.pop_back();  // the other half begins with it
  return hull;
}

double hull_area(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  std::vector<Point> hull = half_hull(points.begin(), points.end());
  const std::vector<Point> upper = half_hull(points.rbegin(), points.rend());
  hull.insert(hull.end(), upper.begin(), upper.end());
  double area = 0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) area += turn(hull[0], hull[i], hull[i + 1]) / 2;
  return area;
}

// Solid angle of a triangle seen from the origin (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double mouth_area(const std::vector<Vec3>& ring_centers) {
  if (ring_centers.size() < 3) return 0;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& c : ring_centers) mean += c;
  mean /= static_cast<double>(ring_centers.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& c : ring_centers) spread += (c - mean) * (c - mean).transpose();
  // the two directions of greatest spread span the best-fit plane
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  std::vector<Point> flat;
  for (const Vec3& c : ring_centers)
    flat.push_back({axes.eigenvectors().col(2).dot(c - mean), axes.eigenvectors().col(1).dot(c - mean)});
  return hull_area(std::move(flat));
}

double mouth_spread(const std::vector<Vec3>& ring_centers) {
  double greatest = 0;
  for (std::size_t i = 0; i < ring_centers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      greatest = std::max(greatest, (ring_centers[i] - ring_centers[j]).norm());
  return greatest;
}

NetSurface::NetSurface(const Net& net, Index first_node) {
  const NetPattern pattern(net);
  const auto knot = [&](Index i, Index j) { return first_node + pattern.knot(i, j); };
  for (Index j = 0; j < net.rows(); ++j)
    for (Index i = 0; i < net.columns(); ++i) {
      triangles_.push_back({knot(i, j), knot(i + 1, j), knot(i + 1, j + 1)});
      triangles_.push_back({knot(i, j), knot(i + 1, j + 1), knot(i, j + 1)});
    }
  for (Index i = 0; i < net.columns(); ++i) edge_.push_back(knot(i, 0));
  for (Index j = 0; j < net.rows(); ++j) edge_.push_back(knot(net.columns(), j));
  for (Index i = net.columns(); i > 0; --i) edge_.push_back(knot(i, net.rows()));
  for (Index j = net.rows(); j > 0; --j) edge_.push_back(knot(0, j));
}

bool NetSurface::encloses(const std::vector<Vec3>& positions, const Vec3& point) const {
  const auto seen = [&](Index node) { return Vec3(positions[static_cast<std::size_t>(node)] - point); };
  double angle = 0;
  for (const auto& t : triangles_) angle += solid_angle(seen(t[0]), seen(t[1]), seen(t[2]));
  Vec3 center = Vec3::Zero();
  for (const Index node : edge_) center += seen(node) / static_cast<double>(edge_.size());
  for (std::size_t i = 0; i < edge_.size(); ++i)
    angle -= solid_angle(seen(edge_[i]), seen(edge_[(i + 1) % edge_.size()]), center);
  return std::abs(angle) > 2 * std::numbers::pi;  // half of the full 4 pi decides
}

}  // namespace cinch
