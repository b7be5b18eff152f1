#include "plan/contact_shares.hpp"

#include <algorithm>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void append_centers(const Model& model, LocalContacts& out) {
  for (const Model::Ball& ball : model.balls)
    out.centers.insert(out.centers.end(), {ball.center.x(), ball.center.y(), ball.center.z()});
}

kernel::BallTally* tally_of(const ContactList& list, State& state, Index pair) {
  const auto ball = at(list.pairs[at(pair)].with);
  return &state.balls[ball][at(1 + pair - list.ball_begin[ball])];
}

}  // namespace

LocalContacts all_contacts(const Model& model, const ContactList& list, State& state) {
  LocalContacts out;
  out.pairs = list.pairs;
  out.ball_begin = list.ball_begin.front();
  out.rings = model.rings;
  for (std::size_t r = 0; r < state.rings.size(); ++r)
    out.ring_tallies.push_back(model.slides(r) ? nullptr : &state.rings[r]);
  append_centers(model, out);
  out.ball_tallies.assign(at(out.ball_begin), nullptr);
  for (Index i = out.ball_begin; i < static_cast<Index>(list.pairs.size()); ++i)
    out.ball_tallies.push_back(tally_of(list, state, i));
  return out;
}

void hand_out(const Model& model, const ContactList& list, State& state, const std::vector<int>& owner,
              int number, const std::vector<double>& node_share, Piece& piece) {
  const auto own = [&](Index node) { return owner[at(node)] == number; };
  LocalContacts out;
  out.shared = true;
  std::vector<Index> needed;  // beside those that elements need
  const auto need = [&](Index node) {
    if (piece.numbering().local(node) < 0) needed.push_back(node);
  };
  const auto take_pair = [&](const kernel::Pair& pair, Index with) {
    out.pairs.push_back(pair);
    out.pairs.back().with = with;
    need(pair.a), need(pair.b);
  };
  for (std::size_t r = 0; r < model.rings.size(); ++r) {
    const kernel::RingGeometry& ring = model.rings[r];
    const bool host = own(ring.a) || own(ring.b);
    const std::size_t before = out.pairs.size();
    for (Index i = list.ring_begin[r]; i < list.ring_begin[r + 1]; ++i) {
      const kernel::Pair& pair = list.pairs[at(i)];
      if (host || own(pair.a) || own(pair.b)) take_pair(pair, static_cast<Index>(out.rings.size()));
    }
    if (out.pairs.size() == before) continue;
    need(ring.a), need(ring.b);
    out.rings.push_back(ring);
    out.ring_tallies.push_back(own(ring.a) ? &state.rings[r] : nullptr);
  }
  out.ball_begin = static_cast<Index>(out.pairs.size());
  out.ball_tallies.assign(out.pairs.size(), nullptr);
  append_centers(model, out);
  for (Index i = list.ball_begin.front(); i < static_cast<Index>(list.pairs.size()); ++i) {
    const kernel::Pair& pair = list.pairs[at(i)];
    if (!own(pair.a) && !own(pair.b)) continue;
    take_pair(pair, pair.with);
    out.ball_tallies.push_back(own(pair.a) ? tally_of(list, state, i) : nullptr);
  }
  SlidingJoints joints;
  joints.take_share(model, own);
  for (const Index node : joints.nodes_needed()) need(node);
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  piece.set_contact_ghosts(std::move(needed), node_share);
  for (kernel::Pair& pair : out.pairs) pair.a = piece.local(pair.a), pair.b = piece.local(pair.b);
  for (kernel::RingGeometry& ring : out.rings) ring.a = piece.local(ring.a), ring.b = piece.local(ring.b);
  joints.renumber([&](Index node) { return piece.local(node); });
  piece.set_joints(std::move(joints));
  piece.contacts().renew(std::move(out), list.margin(), piece.share());
}

void release_lonely_rings(const Model& model, const ContactList& list, State& state) {
  for (std::size_t r = 0; r < state.rings.size(); ++r) {
    if (list.ring_begin[r] < list.ring_begin[r + 1] || model.slides(r)) continue;
    kernel::RingTally& tally = state.rings[r];
    tally.force[0] = tally.force[1] = tally.force[2] = 0;
    tally.potential = 0;
    if (tally.state == 1) tally.state = 2;
  }
}

}  // namespace cinch
