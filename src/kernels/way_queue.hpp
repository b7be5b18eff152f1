// The ways of all elements with rings, found side by side.
#pragma once
#include "kernels/sliding_way.hpp"
#include "kernels/way_lanes.hpp"

namespace cinch::CINCH_ISA {

static_assert(2 * sizeof(WayLanes) <= kernel::sliding_scratch * sizeof(double));

/// Elements whose ways are found once there are enough of them.
class WayQueue {
 public:
  WayQueue(const SlidingArguments& g, Work* work, WayLanes& lanes) : g_(g), work_(work), lanes_(lanes) {}

  void add(Index thread, const RingGroup& group) {
    if (rest_way(slide(thread), group)) return;
    waiting_[count_++] = {thread, group};
    if (count_ == way_lanes) find();
  }

  void find() {
    if (wide && count_ >= worth_lanes) find_together();
    else
      for (int i = 0; i < count_; ++i) find_alone(i);
    count_ = 0;
  }

 private:
  // measured: one or two are found sooner one after the other, and with narrow registers any number
  static constexpr int worth_lanes = 3;
  static constexpr bool wide = native_lanes > 2;

  struct Waiting {
    Index thread;
    RingGroup group;
  };

  Slide slide(Index thread) const { return {g_, g_.threads[thread], work_}; }

  void find_together() {
    for (int i = 0; i < count_; ++i) put_in(i);
    for (int i = count_; i < way_lanes; ++i) lanes_.rings.put(i, 0);
    find_way_lanes(lanes_);
    for (int i = 0; i < count_; ++i) lanes_.hard[i] > 0 ? find_alone(i) : take_out(i);
  }

  void find_alone(int i) { find_taut_way(slide(waiting_[i].thread), waiting_[i].group); }

  void put_in(int i) {
    const RingGroup& group = waiting_[i].group;
    const Slide s = slide(waiting_[i].thread);
    const V3 a = s.place(group.element), b = s.place(group.element + 1);
    const int rings = group.last - group.first;
    WayLanes& l = lanes_;
    l.rings.put(i, rings);
    put(a, l.place[0], i);
    l.lift2[0].put(i, 0);
    for (int k = 0; k < rings; ++k) {
      const Index j = group.first + k;
      const Opening& o = s.work[j].host.opening;
      put(o.center, l.opening[k].center, i);
      put(o.normal, l.opening[k].normal, i);
      l.opening[k].radius.put(i, o.radius);
      put(vec(s.state(j).offset), l.offset[k], i);
      put(s.waypoint(j), l.place[k + 1], i);
      l.lift2[k + 1].put(i, k + 1 == rings ? 0.0 : s.lift2(j));
    }
    put(b, l.place[rings + 1], i);
    put(b, l.end, i);
  }

  void take_out(int i) {
    const RingGroup& group = waiting_[i].group;
    const Slide s = slide(waiting_[i].thread);
    const WayLanes& l = lanes_;
    Way& first = s.work[group.first].way;
    const int rings = group.last - group.first;
    const auto taken = [i](const LegOf<Eight>& part) { return Leg{at(part.unit, i), part.length[i]}; };
    for (int k = 0; k < rings; ++k) put(at(l.offset[k], i), s.state(group.first + k).offset);
    first.straight = rings == 1 && l.straight[i] > 0;
    first.idle = first.straight && may_idle(s, group);
    if (first.idle) return;
    for (int k = 0; k < rings; ++k) s.work[group.first + k].way.before_it = taken(l.leg[k]);
    set_way(s, group, taken(l.direct), taken(l.leg[rings]), l.length[i]);
  }

  const SlidingArguments& g_;
  Work* work_;
  WayLanes& lanes_;
  int count_ = 0;
  Waiting waiting_[way_lanes];
};

// The ways of all threads of a call. Ways through one ring need no rounds: they do not wait for the others.
inline void find_ways(const SlidingArguments& g, Work* work, WayLanes* lanes) {
  WayQueue alone(g, work, lanes[0]), shared(g, work, lanes[1]);
  for (Index t = 0; t < g.thread_count; ++t) {
    const Slide s{g, g.threads[t], work};
    for (Index j = s.thread.joint_begin; j < s.thread.joint_end; j = s.behind(j)) {
      const RingGroup group = group_of(s, j);
      const Index rings = group.last - group.first;
      if (rings > lane_rings) find_way(s, group);
      else (rings == 1 ? alone : shared).add(t, group);
    }
  }
  alone.find();
  shared.find();
}

}  // namespace cinch::CINCH_ISA
