#include "plan/thread_ends.hpp"

#include <algorithm>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// 1 where the ring's normal points to where the thread goes on, from its start to its end.
double side_of(const Look& now, Index ring, Index first_element) {
  const Assembly& assembly = now.assembly();
  const std::vector<Threading>& all = assembly.rings[at(ring)].threadings;
  const auto same = [&](const Threading& t) {
    return assembly.parts[at(t.part)].first_element == first_element;
  };
  return std::find_if(all.begin(), all.end(), same)->side;
}

}  // namespace

std::vector<DrawnEnd> drawn_ends(const Look& now) {
  const Model& model = now.model();
  std::vector<DrawnEnd> found;
  for (std::size_t t = 0; t < model.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model.sliding_threads[t];
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      for (const Index end : {Index{0}, thread.elements}) {
        if (now.joints()[at(j)].element != (end == 0 ? 0 : thread.elements - 1)) continue;
        const kernel::Joint& joint = model.joints[at(j)];
        const Index node = model.sliding_nodes[at(thread.node_begin + end)];
        const Vec3 way = now.position(node) - now.joint_waypoint(model, j);
        const double on =
            side_of(now, joint.ring, model.sliding_first[t]) * now.ring_normal(joint.ring).dot(way);
        const bool through = (end == 0 ? on : -on) > 0 && way.norm() < 0.25 * thread.rest_length;
        if (through || way.norm() < joint.opening) found.push_back({j, node});
      }
  }
  return found;
}

}  // namespace cinch
