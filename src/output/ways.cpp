#include "output/ways.hpp"

#include <algorithm>
#include <map>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Ways::Ways(const ResultModel& model) {
  std::map<int, std::size_t> joints;  // of each part
  for (const ResultModel::Joint& joint : model.joints) ++joints[joint.part];
  for (const auto& [part, count] : joints) {
    Thread thread;
    for (std::size_t e = 0; e < model.elements.size(); ++e) {
      if (model.element_part[e] != part) continue;
      if (thread.nodes.empty()) thread.nodes.push_back(model.elements[e][0]);
      thread.nodes.push_back(model.elements[e][1]);
      thread.elements.push_back(static_cast<Index>(e));
    }
    thread.points = thread.nodes.size() + count;
    points_ += thread.points;
    threads_.push_back(std::move(thread));
  }
}

std::vector<std::int64_t> Ways::connectivity() const {
  std::vector<std::int64_t> pairs;
  std::int64_t first = 0;
  for (const Thread& thread : threads_) {
    const auto last = first + static_cast<std::int64_t>(thread.points) - 1;
    for (; first < last; ++first) pairs.insert(pairs.end(), {first, first + 1});
    ++first;
  }
  return pairs;
}

Ways::Trace Ways::trace(const Frame& frame) const {
  Trace trace;
  for (const Thread& thread : threads_) {
    trace.points.push_back(frame.position[at(thread.nodes[0])]);
    for (std::size_t k = 0; k < thread.elements.size(); ++k) {
      const Index e = thread.elements[k];
      const auto through = waypoints_in(frame, e);
      trace.points.insert(trace.points.end(), through.begin(), through.end());
      trace.points.push_back(frame.position[at(thread.nodes[k + 1])]);
      trace.tension.insert(trace.tension.end(), through.size() + 1, frame.tension[at(e)]);
      trace.active.insert(trace.active.end(), through.size() + 1, frame.active[at(e)]);
    }
  }
  return trace;
}

}  // namespace cinch
