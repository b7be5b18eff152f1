#include "plan/look.hpp"

#include <numeric>

#include "kernels/axial_law.hpp"
#include "plan/palette.hpp"
#include "scene/mouth.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

plain::V3 plain_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

double sum(const AlignedVector<double>& list) { return std::accumulate(list.begin(), list.end(), 0.0); }

double contact_energy(const State& state) {
  double energy = 0;
  for (const kernel::RingTally& ring : state.rings) energy += ring.potential;
  for (const auto& ball : state.balls)
    for (const kernel::BallTally& tally : ball) energy += tally.potential;
  return energy;
}

}  // namespace

double dissipated_by_dampers(const State& state, double dt) {
  double energy = dt * sum(state.dissipated);
  for (const kernel::JointState& joint : state.joints) energy += joint.dissipated;
  return energy;
}

double dissipated_by_contacts(const State& state) {
  double energy = 0;
  for (const kernel::RingTally& ring : state.rings) energy += ring.dissipated;
  for (const auto& ball : state.balls)
    for (const kernel::BallTally& tally : ball) energy += tally.dissipated;
  return energy;
}

// By dampers since what `state` has booked, J.
double dissipation_due(const Glance& glance, const State& state, double dt) {
  double energy = dt * sum(glance.due);
  for (const kernel::JointState& joint : state.joints) energy += joint.due;
  return energy;
}

double couple_work(const State& state) {
  double work = 0;
  for (const kernel::RingTally& ring : state.rings) work += ring.couple_work;
  return work;
}

void Look::take(Stepper& stepper, State& state, const Assembly& assembly, bool half_step) {
  model_ = &stepper.model();
  state_ = &state;
  assembly_ = &assembly;
  dt_ = stepper.plan().dt;
  time_ = stepper.plan().timeline.time_of(state.step);
  share_ = half_step ? 0.5 : 0.0;
  stepper.glance(state, glance_);
  sum_energies();
  mouth_area_.reset();
}

double Look::mouth_area() const {
  if (!mouth_area_) mouth_area_ = cinch::mouth_area(ring_centers());
  return *mouth_area_;
}

void Look::sum_energies() {
  const State& s = *state_;
  const Vec3& g = model_->gravity;
  const kernel::NodeEnergies nodes = kernels().node_energies({s.x.data(),
                                                              s.y.data(),
                                                              s.z.data(),
                                                              s.vx.data(),
                                                              s.vy.data(),
                                                              s.vz.data(),
                                                              glance_.gain[0].data(),
                                                              glance_.gain[1].data(),
                                                              glance_.gain[2].data(),
                                                              share_,
                                                              model_->mass.data(),
                                                              {g.x(), g.y(), g.z()},
                                                              model_->nodes});
  energy_ = {};
  energy_.kinetic = nodes.kinetic;
  energy_.gravity = nodes.gravity;
  energy_.elastic = sum(glance_.elastic);
  for (const kernel::JointState& joint : s.joints) energy_.elastic += joint.energy;
  energy_.contact = contact_energy(s);
  energy_.dissipated_damper = dissipated_by_dampers(s, dt_);
  if (share_ > 0) energy_.dissipated_damper += dissipation_due(glance_, s, dt_);
  energy_.dissipated_contact = dissipated_by_contacts(s);
  energy_.booked_couple = couple_work(s);
}

namespace {

// What holds at s between the ends of what carries a node of a closing thread, before that is there.
template <class Value>
Vec3 carried(const Lay& lay, Value&& value) {
  return (1 - lay.s) * value(lay.a) + lay.s * value(lay.b);
}

}  // namespace

Vec3 Look::position(Index node) const {
  if (node < model_->nodes) return {state_->x[at(node)], state_->y[at(node)], state_->z[at(node)]};
  const Lay& lay = assembly_->lays[at(node - assembly_->nodes_before)];
  return carried(lay, [&](Index end) { return position(end); }) + lay.offset;
}

Vec3 Look::velocity(Index node) const {
  if (node < model_->nodes) return speed(node) + share_ * gain(node);
  return carried(assembly_->lays[at(node - assembly_->nodes_before)],
                 [&](Index end) { return velocity(end); });
}

// Half a step back while running: what the forces of this instant feel.
Vec3 Look::speed(Index node) const {
  return {state_->vx[at(node)], state_->vy[at(node)], state_->vz[at(node)]};
}

Vec3 Look::gain(Index node) const {
  return {glance_.gain[0][at(node)], glance_.gain[1][at(node)], glance_.gain[2][at(node)]};
}

Vec3 Look::contact_force(Index node) const {
  Vec3 force = Vec3::Zero();
  for (const kernel::Load& load : glance_.loads)
    if (load.node == node) force += Vec3(load.x, load.y, load.z);
  return force;
}

const kernel::JointState* Look::joint_in(Index element) const {
  for (std::size_t t = 0; t < model_->sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = model_->sliding_threads[t];
    if (!model_->slides_on(t, element)) continue;
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      if (model_->sliding_first[t] + state_->joints[at(j)].element == element) return &state_->joints[at(j)];
  }
  return nullptr;
}

// From the definition, in the user's numbering: the kernels only give the forces' sums.
Look::Pull Look::pull(Index element) const {
  if (!present(element)) return {0, 0};
  if (const kernel::JointState* joint = joint_in(element)) {
    const double rest = model_->rest_length[at(element)];
    return {joint->tension, (joint->length - rest) / rest};
  }
  const auto e = at(element);
  const Index a = model_->end_a[e], b = model_->end_b[e];
  const Vec3 r = position(b) - position(a);
  const plain::V3 along = plain_vector(r), moving = plain_vector(speed(b) - speed(a));
  const double rest = model_->rest_length[e];
  const plain::Axial item =
      plain::axial_law(plain::dot(along, along), plain::dot(along, moving), model_->stiffness[e],
                       model_->damping[e], rest, dt_, element_give(*model_, e, dt_));
  return {item.tension, (r.norm() - rest) / rest};
}

Vec3 Look::ring_center(Index ring) const {
  const AssemblyRing& r = assembly_->rings[at(ring)];
  if (r.element < 0) return position(r.node);
  return 0.5 * (position(r.host_a) + position(r.host_b));
}

Vec3 Look::ring_normal(Index ring) const {
  const AssemblyRing& r = assembly_->rings[at(ring)];
  if (r.element < 0) return r.normal;
  return (position(r.host_b) - position(r.host_a)).normalized();
}

Vec3 Look::ring_force(Index ring) const {
  if (at(ring) >= state_->rings.size()) return Vec3::Zero();
  const double* const f = state_->rings[at(ring)].force;
  return {f[0], f[1], f[2]};
}

Index Look::joint_element(const Model& whole, Index joint) const {
  std::size_t t = 0;
  while (whole.sliding_threads[t].joint_end <= joint) ++t;
  const bool there = at(joint) < state_->joints.size();
  return whole.sliding_first[t] +
         (there ? state_->joints[at(joint)].element : whole.joint_element[at(joint)]);
}

Vec3 Look::joint_waypoint(const Model& whole, Index joint) const {
  const Vec3 center = ring_center(whole.joints[at(joint)].ring);
  if (at(joint) >= state_->joints.size()) return center;
  const double* const offset = state_->joints[at(joint)].offset;
  return center + Vec3(offset[0], offset[1], offset[2]);
}

std::vector<Vec3> Look::positions() const {
  std::vector<Vec3> all(at(assembly_->node_count()));
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = position(static_cast<Index>(i));
  return all;
}

std::vector<Vec3> Look::ring_centers() const {
  std::vector<Vec3> all(assembly_->rings.size());
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = ring_center(static_cast<Index>(r));
  return all;
}

std::vector<Vec3> Look::contact_forces() const {
  std::vector<Vec3> all(at(assembly_->node_count()), Vec3::Zero());
  for (const kernel::Load& load : glance_.loads) all[at(load.node)] += Vec3(load.x, load.y, load.z);
  return all;
}

}  // namespace cinch
