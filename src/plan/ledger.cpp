#include "plan/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace cinch {
namespace {

double stored(const Energies& e) { return e.kinetic + e.elastic + e.contact + e.gravity; }

Vec3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

Momentum reaction_impulse(const State& state) {
  Momentum sum;
  for (const kernel::Reaction& r : state.reactions) {
    sum.linear += vec(r.impulse);
    sum.angular += vec(r.moment);
  }
  return sum;
}

}  // namespace

Momentum half_step_momentum(const Model& model, const State& state) {
  Momentum sum;
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.nodes); ++i) {
    const Vec3 p = model.mass[i] * Vec3(state.vx[i], state.vy[i], state.vz[i]);
    sum.linear += p;
    sum.angular += Vec3(state.x[i], state.y[i], state.z[i]).cross(p);
  }
  return sum;
}

Momentum outside_impulse(const State& state) {
  Momentum sum = reaction_impulse(state);
  for (const auto& ball : state.balls)
    for (const kernel::BallTally& tally : ball) {
      sum.linear += vec(tally.impulse);
      sum.angular += vec(tally.moment);
    }
  for (const kernel::RingTally& ring : state.rings) sum.angular -= vec(ring.couple_impulse);
  return sum;
}

void Ledger::open(const Energies& start, const Model& model, const State& state, double work) {
  gravity_zero_ = start.gravity;
  work_ = work;
  initial_ = stored(start) - gravity_zero_ - work;
  start_ = half_step_momentum(model, state);
}

void Ledger::book_closing(const Energies& before, const State& state_before, const Energies& laid,
                          const Energies& separated, const State& state_after, const Model& model_before,
                          const Model& model_after) {
  booked_activation_ += stored(before) - stored(laid);
  work_ += stored(separated) - stored(laid);
  carried_damper_ += before.dissipated_damper;
  const Momentum reactions = reaction_impulse(state_before);
  carried_outside_.linear += reactions.linear;
  carried_outside_.angular += reactions.angular;
  // angular momentum: laid nodes lie on chords, so this is not exact; laying keeps linear momentum
  booked_.angular += half_step_momentum(model_after, state_after).angular -
                     half_step_momentum(model_before, state_before).angular;
}

void Ledger::book_outside(const Momentum& impulse) {
  carried_outside_.linear += impulse.linear;
  carried_outside_.angular += impulse.angular;
}

Energies Ledger::energies(const Energies& now) {
  Energies e = now;
  e.gravity -= gravity_zero_;
  gravity_change_ = std::max(gravity_change_, std::abs(e.gravity));
  e.dissipated_damper += carried_damper_;
  e.booked_activation = booked_activation_;
  e.work_separation = work_;
  const double accounted = stored(e) + e.dissipated_damper + e.dissipated_contact - e.work_separation +
                           e.booked_activation + e.booked_couple;
  e.residual = initial_ - accounted;
  return e;
}

double Ledger::scale() const { return std::max({std::abs(initial_), std::abs(work_), gravity_change_}); }

Momentum Ledger::drift(const Model& model, const State& state, double time) const {
  Momentum drift = half_step_momentum(model, state);
  const Momentum outside = outside_impulse(state);
  double mass = 0;
  for (const double m : model.mass) mass += m;
  drift.linear -= start_.linear + outside.linear + carried_outside_.linear + mass * time * model.gravity;
  drift.angular -= start_.angular + outside.angular + carried_outside_.angular + booked_.angular;
  return drift;
}

void Ledger::transfer(Archive& archive) {
  archive.value("ledger/initial", initial_);
  archive.value("ledger/gravity_zero", gravity_zero_);
  archive.value("ledger/gravity_change", gravity_change_);
  archive.value("ledger/work", work_);
  archive.value("ledger/booked_activation", booked_activation_);
  archive.value("ledger/carried_damper", carried_damper_);
  const auto momentum = [&](const std::string& name, Momentum& of) {
    archive.values(name + "/linear", std::span(of.linear.data(), 3));
    archive.values(name + "/angular", std::span(of.angular.data(), 3));
  };
  momentum("ledger/start", start_);
  momentum("ledger/carried_outside", carried_outside_);
  momentum("ledger/booked", booked_);
}

}  // namespace cinch
