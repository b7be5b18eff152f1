#include "plan/broadphase.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cinch {
namespace {

// A region of threads costs as much as some thousand elements.
constexpr std::size_t worth_sharing = 500;  ///< boxes

constexpr Box empty_box() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

void grow(Box& box, const Box& other) {
  for (int d = 0; d < 3; ++d) {
    box.low[d] = std::min(box.low[d], other.low[d]);
    box.high[d] = std::max(box.high[d], other.high[d]);
  }
}

void grow(double place, double& low, double& high) {
  low = place < low ? place : low;
  high = place > high ? place : high;
}

void grow(Box& box, const State& state, Index node) {
  const auto i = static_cast<std::size_t>(node);
  grow(state.x[i], box.low[0], box.high[0]);
  grow(state.y[i], box.low[1], box.high[1]);
  grow(state.z[i], box.low[2], box.high[2]);
}

Box box_around(const Model& model, const ContactSet& set, const State& state, std::size_t begin,
               std::size_t end) {
  Box box = empty_box();
  Index last = -1;  // elements of a thread share nodes
  for (std::size_t i = begin; i < end; ++i) {
    const auto e = static_cast<std::size_t>(set.elements[i]);
    if (model.end_a[e] != last) grow(box, state, model.end_a[e]);
    grow(box, state, last = model.end_b[e]);
  }
  return box;
}

double squared_distance_to_box(const Box& box, const Vec3& point) {
  double squared = 0;
  for (int d = 0; d < 3; ++d) {
    const double outside = std::max({box.low[d] - point[d], 0.0, point[d] - box.high[d]});
    squared += outside * outside;
  }
  return squared;
}

Vec3 place(const State& state, Index node) {
  const auto i = static_cast<std::size_t>(node);
  return {state.x[i], state.y[i], state.z[i]};
}

}  // namespace

double distance_to_element(const State& state, Index a, Index b, const Vec3& center) {
  const Vec3 start = place(state, a), along = place(state, b) - start;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((center - start).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (start + t * along - center).norm();
}

void BoxTree::build(const Model& model, const ContactSet& set, const State& state, int threads) {
  levels_.clear();
  const std::size_t count = set.elements.size();
  if (count == 0) return;
  std::vector<Box> boxes((count + leaf_size - 1) / leaf_size);
  const bool shared = threads > 1 && boxes.size() > worth_sharing;
#pragma omp parallel for num_threads(threads) schedule(static) if (shared)
  for (std::size_t b = 0; b < boxes.size(); ++b)
    boxes[b] = box_around(model, set, state, b * leaf_size, std::min((b + 1) * leaf_size, count));
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> above((below.size() + 1) / 2, empty_box());
    for (std::size_t b = 0; b < below.size(); ++b) grow(above[b / 2], below[b]);
    levels_.push_back(std::move(above));
  }
}

void BoxTree::query(const Model& model, const ContactSet& set, const State& state, const Vec3& center,
                    double distance, std::vector<Index>& found, std::int64_t& pairs_tested) const {
  if (levels_.empty()) return;
  struct Visit {
    std::size_t level, box;
  };
  std::array<Visit, 64> open;  // one more than levels are enough
  std::size_t count = 0;
  open[count++] = {levels_.size() - 1, 0};
  while (count > 0) {
    const auto [level, box] = open[--count];
    ++pairs_tested;
    if (squared_distance_to_box(levels_[level][box], center) > distance * distance) continue;
    if (level > 0) {  // the later child first onto the stack, so that elements come out in ascending order
      if (2 * box + 1 < levels_[level - 1].size()) open[count++] = {level - 1, 2 * box + 1};
      open[count++] = {level - 1, 2 * box};
      continue;
    }
    const std::size_t end = std::min((box + 1) * leaf_size, set.elements.size());
    for (std::size_t i = box * leaf_size; i < end; ++i) {
      const auto e = static_cast<std::size_t>(set.elements[i]);
      ++pairs_tested;
      if (distance_to_element(state, model.end_a[e], model.end_b[e], center) <= distance)
        found.push_back(static_cast<Index>(i));
    }
  }
}

}  // namespace cinch
