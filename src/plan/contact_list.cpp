#include "plan/contact_list.hpp"

#include <algorithm>
#include <limits>

#include "kernels/contact_law.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

double automatic_margin(const Model& model) {
  double margin = std::numeric_limits<double>::infinity();
  for (const ContactSet& set : model.contact_sets) {
    double sum = 0;
    for (const Index e : set.elements) sum += model.rest_length[at(e)];
    if (!set.elements.empty())
      margin = std::min(margin, 0.5 * sum / static_cast<double>(set.elements.size()));
  }
  return margin;
}

kernel::Candidate candidate(const Model& model, const ContactSet& set, Index position, double other_radius,
                            double curvature_radius, double other_compliance) {
  const Index e = set.elements[at(position)];
  return {model.end_a[at(e)],
          model.end_b[at(e)],
          e,
          model.radius[at(e)] + other_radius,
          plain::contact_stiffness(model.radius[at(e)], curvature_radius, model.compliance[at(e)],
                                   other_compliance),
          set.weight_a[at(position)],
          set.weight_b[at(position)]};
}

// A sphere is an element without length: both ends are its node.
kernel::Candidate candidate(const Model::Sphere& sphere, const Model::Ball& ball) {
  return {sphere.node,
          sphere.node,
          kernel::sphere_label(sphere.node),
          sphere.radius + ball.radius,
          plain::contact_stiffness(sphere.radius, ball.radius, sphere.compliance, ball.compliance),
          0,
          0};
}

Vec3 ring_center(const State& state, const kernel::RingGeometry& ring) {
  const auto a = at(ring.a), b = at(ring.b);
  return 0.5 * Vec3(state.x[a] + state.x[b], state.y[a] + state.y[b], state.z[a] + state.z[b]);
}

// A ring without candidates touches nothing.
void release(kernel::RingTally& tally) {
  tally.force[0] = tally.force[1] = tally.force[2] = 0;
  tally.potential = 0;
  if (tally.state == 1) tally.state = 2;
}

}  // namespace

ContactList::ContactList(const Model& model, double margin)
    : margin_(margin > 0 ? margin : automatic_margin(model)), trees_(model.contact_sets.size()) {}

void ContactList::rebuild(const Model& model, State& state) {
  ++rebuilds_;
  for (std::size_t s = 0; s < trees_.size(); ++s) trees_[s].build(model, model.contact_sets[s], state);
  candidates.clear();
  find_ring_candidates(model, state);
  find_ball_candidates(model, state);
  lay_out_slots(model);
  for (std::size_t b = 0; b < model.balls.size(); ++b) {
    const Index chunks = (ball_begin[b + 1] - ball_begin[b] + ball_chunk - 1) / ball_chunk;
    auto& tallies = state.balls[b];
    kernel::BallTally untouched{};
    untouched.first_time = -1;
    untouched.stiffest_element = -1;
    if (tallies.size() < at(chunks)) tallies.resize(at(chunks), untouched);
    for (auto& tally : tallies) tally.potential = 0;
  }
}

void ContactList::find_ring_candidates(const Model& model, State& state) {
  ring_begin.assign(1, 0);
  for (std::size_t r = 0; r < model.rings.size(); ++r) {
    const auto set_number = at(model.ring_set[r]);
    const ContactSet& set = model.contact_sets[set_number];
    const kernel::RingGeometry& ring = model.rings[r];
    found_.clear();
    trees_[set_number].query(model, set, state, ring_center(state, ring), ring.reach + margin_, found_,
                             pairs_tested_);
    for (const Index position : found_)
      candidates.push_back(candidate(model, set, position, model.ring_wire_radius[r],
                                     model.ring_wire_radius[r], model.ring_compliance[r]));
    ring_begin.push_back(static_cast<Index>(candidates.size()));
    if (found_.empty()) release(state.rings[r]);
  }
}

void ContactList::find_ball_candidates(const Model& model, const State& state) {
  ball_begin.assign(1, static_cast<Index>(candidates.size()));
  for (const Model::Ball& ball : model.balls) {
    const ContactSet& set = model.contact_sets[at(ball.set)];
    found_.clear();
    trees_[at(ball.set)].query(model, set, state, ball.center, ball.radius + set.thickest + margin_, found_,
                               pairs_tested_);
    for (const Index position : found_)
      candidates.push_back(candidate(model, set, position, ball.radius, ball.radius, ball.compliance));
    for (const Model::Sphere& sphere : ball.spheres)
      if (distance_to_element(state, sphere.node, sphere.node, ball.center) <=
          ball.radius + sphere.radius + margin_)
        candidates.push_back(candidate(sphere, ball));
    ball_begin.push_back(static_cast<Index>(candidates.size()));
  }
}

void ContactList::lay_out_slots(const Model& model) {
  host_slot = 2 * static_cast<Index>(candidates.size());
  std::vector<Index> node_of_slot;
  for (const kernel::Candidate& c : candidates) node_of_slot.insert(node_of_slot.end(), {c.a, c.b});
  for (const kernel::RingGeometry& ring : model.rings)
    node_of_slot.insert(node_of_slot.end(), {ring.a, ring.b});
  for (auto* load : {&load_x, &load_y, &load_z}) load->assign(node_of_slot.size(), 0.0);
  gather.rebuild(node_of_slot, static_cast<Index>(model.node_blocks.size()));
}

}  // namespace cinch
