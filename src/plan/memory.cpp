// Every list whose length is that of the scene, in the order of who owns it. Lists of the few (rings, balls,
// supports, names) are left out where nodes and elements outnumber them.
#include "plan/memory.hpp"

#include "base/bytes.hpp"
#include "plan/simulation.hpp"
#include "store/fields.hpp"

namespace cinch {

std::size_t memory_of(const Assembly& a) {
  std::size_t sum = bytes_of(a.nodes, a.elements, a.lays);
  for (const Part& part : a.parts) sum += bytes_of(part.nodes);
  return sum;
}

std::size_t memory_of(const Model& m) {
  std::size_t sum = bytes_of(m.mass, m.stiffness, m.damping, m.rest_length, m.end_a, m.end_b, m.radius,
                             m.compliance, m.constraints, m.rings, m.sliding_nodes, m.joints, m.topology.runs,
                             m.topology.slot_element, m.topology.links);
  for (const ContactSet& set : m.contact_sets) sum += bytes_of(set.elements, set.fraction_a, set.fraction_b);
  return sum;
}

std::size_t memory_of(const State& s) {
  std::size_t sum = bytes_of(s.x, s.y, s.z, s.vx, s.vy, s.vz, s.dissipated, s.rings, s.joints, s.held.loads,
                             s.held.count, s.reactions);
  for (const auto& ball : s.balls) sum += bytes_of(ball);
  return sum;
}

std::size_t memory_at_start(const Preparation& p) {
  std::size_t sum = memory_of(p.assembly) + static_cast<std::size_t>(p.phases.front().model.nodes) *
                                                std::size(node_fields) * sizeof(double);
  for (const Phase& phase : p.phases) sum += memory_of(phase.model);
  return sum;
}

std::size_t memory_of_frame(Index nodes, Index elements) {
  // three vectors of each node and one of them laid out flat for the file; tension, strain and a mark
  return static_cast<std::size_t>(nodes) * 4 * sizeof(Vec3) +
         static_cast<std::size_t>(elements) * (2 * sizeof(double) + sizeof(std::uint8_t));
}

std::size_t BoxTree::memory() const {
  std::size_t sum = 0;
  for (const auto& level : levels_) sum += bytes_of(level);
  return sum;
}

std::size_t ContactList::memory() const {
  std::size_t sum = bytes_of(pairs, ring_begin, ball_begin, searches_);
  for (const BoxTree& tree : trees_) sum += tree.memory();
  for (const Search& search : searches_) sum += bytes_of(search.positions, search.pairs);
  return sum;
}

std::size_t NearContacts::memory() const {
  return ring_tallies_.memory() + ball_tallies_.memory() +
         bytes_of(contacts_.pairs, lanes_, asleep_, near_, awake_, sleep_, loads_);
}

std::size_t SlidingJoints::memory() const {
  return bytes_of(threads_, nodes_, mobility_, joints_, number_, scene_thread_, states_, tallies_, scratch_,
                  on_threads_, on_hosts_, pushing_, ends_, standing_[0], standing_[1], standing_[2]);
}

std::size_t Piece::memory() const {
  const ForceReduction& r = reduction_;
  std::size_t sum = numbering_.memory() + contacts_.memory() + joints_.memory() +
                    bytes_of(topology_.runs, topology_.slot_element, topology_.links, r.blocks, r.patches,
                             r.spans, r.links, r.stretches, r.kicks, scale_, share_, damper_, link_damper_,
                             ledger_, own_rows_, palette_.rows, palette_.of_group);
  for (const auto& field : own_fields_) sum += bytes_of(field);
  for (const auto& field : force_) sum += bytes_of(field);
  for (const auto& field : glance_fields_) sum += bytes_of(field);
  return sum;
}

std::size_t Stepper::memory_of_pieces() const {
  std::size_t sum = bytes_of(node_share_, owner_);
  for (const auto& piece : pieces_) sum += piece->memory();
  return sum;
}

std::size_t Look::memory() const {
  std::size_t sum = bytes_of(glance_.elastic, glance_.due, glance_.loads);
  for (const auto& gain : glance_.gain) sum += bytes_of(gain);
  return sum;
}

MemoryUse Simulation::memory() const {
  MemoryUse use;
  use.model = memory_of(preparation_.assembly);
  for (const Phase& p : preparation_.phases) use.model += memory_of(p.model);
  use.state = memory_of(state_) + memory_of(sound_);
  use.pieces = stepper_->memory_of_pieces();
  use.contacts = stepper_->contacts().memory();
  use.looks = look_.memory() + bytes_of(ring_start_, node_start_);
  for (const NetSurface& surface : surfaces_) use.looks += surface.memory();
  return use;
}

}  // namespace cinch
