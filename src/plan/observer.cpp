#include "plan/observer.hpp"

#include "kernels/axial_law.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

Vec3 position(const State& s, Index i) { return {s.x[at(i)], s.y[at(i)], s.z[at(i)]}; }
Vec3 velocity(const State& s, Index i) { return {s.vx[at(i)], s.vy[at(i)], s.vz[at(i)]}; }

plain::V3 plain_vector(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// Tension, strain and elastic energy of each element; its force joins the nodes' forces.
void observe_elements(const Model& model, const State& state, Observation& out, std::vector<Vec3>& force) {
  out.tension.assign(at(model.elements), 0);
  out.strain.assign(at(model.elements), 0);
  for (Index e = 0; e < model.elements; ++e) {
    const Index a = model.end_a[at(e)], b = model.end_b[at(e)];
    const Vec3 r = position(state, b) - position(state, a);
    const plain::V3 along = plain_vector(r), moving = plain_vector(velocity(state, b) - velocity(state, a));
    const plain::Axial item =
        plain::axial_law(plain::dot(along, along), plain::dot(along, moving), model.stiffness[at(e)],
                         model.damping[at(e)], model.rest_length[at(e)]);
    force[at(a)] += item.per_length * r;
    force[at(b)] -= item.per_length * r;
    const double stretch = r.norm() - model.rest_length[at(e)];
    if (stretch > 0) out.energy.elastic += 0.5 * model.stiffness[at(e)] * stretch * stretch;
    out.tension[at(e)] = item.tension;
    out.strain[at(e)] = stretch / model.rest_length[at(e)];
  }
}

void observe_contacts(const Stepper& stepper, const State& state, Observation& out) {
  for (Index i = 0; i < stepper.load_count(); ++i) {
    const kernel::Load& load = stepper.loads()[i];
    out.contact_force[at(load.node)] += Vec3(load.x, load.y, load.z);
  }
  for (const kernel::RingTally& ring : state.rings) out.energy.contact += ring.potential;
  for (const auto& ball : state.balls)
    for (const kernel::BallTally& tally : ball) out.energy.contact += tally.potential;
}

void observe_rings(const Model& model, const State& state, Observation& out) {
  for (std::size_t r = 0; r < model.rings.size(); ++r) {
    const kernel::RingGeometry& ring = model.rings[r];
    const Vec3 a = position(state, ring.a), b = position(state, ring.b);
    out.ring_center.push_back(0.5 * (a + b));
    out.ring_normal.push_back(ring.a == ring.b ? Vec3(ring.normal[0], ring.normal[1], ring.normal[2])
                                               : Vec3((b - a).normalized()));
    const double* f = state.rings[r].force;
    out.ring_force.emplace_back(f[0], f[1], f[2]);
  }
}

// Accelerations with the supports' share taken off, velocities at the full step, what hangs on them.
void observe_nodes(const Model& model, const State& state, double half_dt, std::vector<Vec3>& force,
                   Observation& out) {
  for (const kernel::Constraint& c : model.constraints) {
    const Vec3 axis(c.ax, c.ay, c.az);
    force[at(c.node)] = axis.dot(force[at(c.node)]) * axis;
  }
  for (Index i = 0; i < model.nodes; ++i) {
    const double mass = model.mass[at(i)];
    out.position.push_back(position(state, i));
    out.acceleration.push_back(force[at(i)] / mass);
    out.velocity.push_back(velocity(state, i) + half_dt * out.acceleration.back());
    const Vec3& x = out.position.back();
    const Vec3& v = out.velocity.back();
    out.energy.kinetic += 0.5 * mass * v.squaredNorm();
    if (model.has_gravity) out.energy.gravity -= mass * model.gravity.dot(x);
    out.momentum.linear += mass * v;
    out.momentum.angular += mass * x.cross(v);
  }
}

}  // namespace

double dissipated_by_dampers(const State& state, double dt) {
  double sum = 0;
  for (const double lane : state.dissipated) sum += lane;
  return dt * sum;
}

double dissipated_by_contacts(const State& state) {
  double sum = 0;
  for (const kernel::RingTally& ring : state.rings) sum += ring.dissipated;
  for (const auto& ball : state.balls)
    for (const kernel::BallTally& tally : ball) sum += tally.dissipated;
  return sum;
}

double couple_work(const State& state) {
  double sum = 0;
  for (const kernel::RingTally& ring : state.rings) sum += ring.couple_work;
  return sum;
}

Observation observe(Stepper& stepper, State& state, bool half_step) {
  const Model& model = stepper.model();
  stepper.evaluate(state);
  Observation out;
  out.time = static_cast<double>(state.step) * stepper.plan().dt;
  std::vector<Vec3> force(at(model.nodes), Vec3::Zero());
  out.contact_force.assign(at(model.nodes), Vec3::Zero());
  observe_elements(model, state, out, force);
  observe_contacts(stepper, state, out);
  for (std::size_t i = 0; i < force.size(); ++i) {
    force[i] += out.contact_force[i];
    if (model.has_gravity) force[i] += model.mass[i] * model.gravity;
  }
  observe_nodes(model, state, half_step ? 0.5 * stepper.plan().dt : 0, force, out);
  observe_rings(model, state, out);
  out.energy.dissipated_damper = dissipated_by_dampers(state, stepper.plan().dt);
  out.energy.dissipated_contact = dissipated_by_contacts(state);
  out.energy.booked_couple = couple_work(state);
  return out;
}

}  // namespace cinch
