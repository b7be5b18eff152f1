#include "plan/jumps.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/segment_circle.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

plain::V3 place(const State& s, Index node) { return {s.x[at(node)], s.y[at(node)], s.z[at(node)]}; }
plain::V3 speed(const State& s, Index node) { return {s.vx[at(node)], s.vy[at(node)], s.vz[at(node)]}; }

plain::V3 unit(plain::V3 v) {
  const double length = plain::norm(v);
  return length > 0 ? (1 / length) * v : plain::V3{0, 0, 0};
}

// Greatest speed at which a point of the element comes towards what moves with `other`, across the element.
double across(const State& s, const kernel::Pair& pair, plain::V3 other) {
  const plain::V3 along = unit(place(s, pair.b) - place(s, pair.a));
  double greatest = 0;
  for (const Index end : {pair.a, pair.b}) {
    const plain::V3 v = speed(s, end) - other;
    greatest = std::max(greatest, plain::norm(v - plain::dot(v, along) * along));
  }
  return greatest;
}

plain::V3 normal_of(const State& s, const kernel::RingGeometry& ring) {
  const plain::V3 host = place(s, ring.b) - place(s, ring.a);
  return plain::norm(host) > 0 ? unit(host) : plain::V3{ring.normal[0], ring.normal[1], ring.normal[2]};
}

// The motion of a pair within a step, if it is one that could jump; else 0.
double motion_at_ring(const State& s, const kernel::Pair& pair, const kernel::RingGeometry& ring, double dt) {
  const plain::V3 host = place(s, ring.b) - place(s, ring.a);
  const plain::V3 turning = speed(s, ring.b) - speed(s, ring.a);
  const double length = plain::norm(host);
  // points of the wire move with the centre and turn with the host
  const double turn = length > 0 ? plain::norm(turning) / length * ring.radius : 0;
  const double motion = dt * (across(s, pair, 0.5 * (speed(s, ring.a) + speed(s, ring.b))) + turn);
  if (!(motion > jump_share * pair.contact_distance)) return 0;
  return distance_to_ring(s, pair, ring) < pair.contact_distance + motion ? motion : 0;
}

double motion_at_ball(const State& s, const kernel::Pair& pair, const Model::Ball& ball, double dt) {
  const double motion = dt * across(s, pair, {0, 0, 0});
  const bool jumps = motion > jump_share * pair.contact_distance &&
                     distance_to_element(s, pair.a, pair.b, ball.center) < pair.contact_distance + motion;
  return jumps ? motion : 0;
}

}  // namespace

double distance_to_ring(const State& state, const kernel::Pair& pair, const kernel::RingGeometry& ring) {
  const plain::V3 center = 0.5 * (place(state, ring.a) + place(state, ring.b));
  return plain::segment_circle_exact(place(state, pair.a), place(state, pair.b), center,
                                     normal_of(state, ring), ring.radius)
      .distance;
}

std::optional<Jump> find_jump(const Model& model, const State& state, const ContactList& contacts,
                              double dt) {
  const Index rings = contacts.ball_begin.front();
  for (Index i = 0; i < static_cast<Index>(contacts.pairs.size()); ++i) {
    const kernel::Pair& pair = contacts.pairs[at(i)];
    const auto with = at(pair.with);
    const double motion = i < rings ? motion_at_ring(state, pair, model.rings[with], dt)
                                    : motion_at_ball(state, pair, model.balls[with], dt);
    if (motion > 0) return Jump{pair, i < rings, motion};
  }
  return std::nullopt;
}

}  // namespace cinch
