#include "plan/simulation.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.hpp"
#include "base/version.hpp"
#include "plan/probes.hpp"
#include "statics/equilibrium.hpp"
#include "store/fields.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr std::int64_t health_interval = 4096;  ///< steps between two looks at the contacts' stiffness

// Positions of the nodes that exist before closing in static equilibrium; closing nodes are laid on them
// again.
void hang(Assembly& assembly, const Scene& scene, bool closes_at_once) {
  StaticNet net;
  for (Index i = 0; i < assembly.nodes_before; ++i) {
    const AssemblyNode& node = assembly.nodes[at(i)];
    net.position.push_back(node.position);
    // a closing thread that starts with the motion is held until then: its mass does not hang on the net
    net.mass.push_back(closes_at_once || !assembly.has_closing() ? node.mass : node.mass_before);
    net.support.push_back(node.support);
    net.axis.push_back(node.axis);
  }
  for (Index e = 0; e < assembly.elements_before; ++e) {
    const AssemblyElement& item = assembly.elements[at(e)];
    net.elements.push_back({item.a, item.b});
    net.stiffness.push_back(item.stiffness);
    net.rest_length.push_back(item.rest_length);
  }
  net.gravity = scene.gravity.value_or(Vec3::Zero());
  const EquilibriumResult found = find_equilibrium(net);
  for (Index i = 0; i < assembly.nodes_before; ++i) assembly.nodes[at(i)].position = found.position[at(i)];
  for (const Lay& lay : assembly.lays)
    assembly.nodes[at(lay.node)].position = (1 - lay.s) * assembly.nodes[at(lay.a)].position +
                                            lay.s * assembly.nodes[at(lay.b)].position + lay.offset;
}

double kinetic_energy(const Model& model, const State& state) {
  double sum = 0;
  for (std::size_t i = 0; i < at(model.nodes); ++i)
    sum += 0.5 * model.mass[i] *
           (state.vx[i] * state.vx[i] + state.vy[i] * state.vy[i] + state.vz[i] * state.vz[i]);
  return sum;
}

}  // namespace

int choose_threads(Index elements, int available) {
  // below this many elements a step is shorter than two meetings of threads that do not share a cache
  constexpr Index elements_per_thread = 8000;
  return std::clamp(elements / elements_per_thread, 1, std::max(available, 1));
}

// What the OpenMP runtime really gives when asked for `wanted` (OMP_THREAD_LIMIT may allow fewer): shares of
// work are cut for that many.
static int available_threads(int wanted) {
  int given = 1;
#pragma omp parallel num_threads(wanted)
  {
#pragma omp single
    given = omp_get_num_threads();
  }
  return given;
}

Simulation::Simulation(const Scene& scene, int threads) : scene_(scene), preparation_(prepare(scene)) {
  omp_set_dynamic(0);
  const auto elements = static_cast<Index>(preparation_.assembly.elements.size());
  threads_ = available_threads(threads > 0 ? threads : choose_threads(elements, omp_get_max_threads()));
  probe_columns_ = cinch::probe_columns(scene_, preparation_.assembly);
  for (const Net& net : scene_.nets)
    for (const Part& part : preparation_.assembly.parts)
      if (part.kind == PartKind::net && part.name == net.name)
        surfaces_.emplace_back(net, part.nodes.front());
  enclosed_.assign(preparation_.assembly.balls.size(), false);
  find_start();
  start();
}

void Simulation::find_start() {
  if (scene_.equilibrium) hang(preparation_.assembly, scene_, preparation_.closing_step == 0);
}

void Simulation::enter_phase(std::size_t number) {
  if (stepper_)
    for (std::size_t s = 0; s < stage_count; ++s) seconds_[s] += stepper_->seconds()[s];
  phase_ = number;
  const Phase& p = phase();
  stepper_ =
      std::make_unique<Stepper>(p.model, p.plan, node_share(p.model, p.bound, preparation_.dt), threads_);
}

// Central differences begin with velocities half a step back: v(-1/2) = v(0) - dt/2 a(0).
void Simulation::start() {
  enter_phase(0);
  const Model& m = model();
  state_ = initial_state(m, preparation_.assembly);
  double work = 0;
  if (preparation_.closing_step == 0) {
    const double before = kinetic_energy(m, state_);
    separate(preparation_.assembly, state_);
    hold_supports(m, state_);
    work = kinetic_energy(m, state_) - before;
    for (const Mechanism& mechanism : scene_.mechanisms) events_.push_back({0, "separation", mechanism.name});
  }
  const Observation begin = observe(*stepper_, state_, false);
  const double half = 0.5 * preparation_.dt;
  for (std::size_t i = 0; i < at(m.nodes); ++i) {
    state_.vx[i] -= half * begin.acceleration[i].x();
    state_.vy[i] -= half * begin.acceleration[i].y();
    state_.vz[i] -= half * begin.acceleration[i].z();
  }
  ledger_.open(begin, m, state_, work);
  const Frame first = frame();
  node_start_ = first.position;
  ring_start_ = first.ring_center;
  // rings along one straight edge are no mouth: their hull has next to no area
  const double spread = mouth_spread(ring_start_);
  has_mouth_ = mouth_area(ring_start_) > 0.01 * spread * spread;
  note_events(first);
}

void Simulation::close() {
  const Model& before_model = model();
  const Observation before = observe(*stepper_, state_);
  State after = lay_closing_threads(preparation_.phases[1].model, preparation_.assembly, state_);
  std::swap(state_, after);  // `after` now holds the state before
  enter_phase(1);
  const Observation laid = observe(*stepper_, state_);
  separate(preparation_.assembly, state_);
  const Momentum free = half_step_momentum(model(), state_);
  hold_supports(model(), state_);
  const Momentum held = half_step_momentum(model(), state_);
  const Observation separated = observe(*stepper_, state_);
  ledger_.book_closing(before, after, laid, separated, state_, before_model, model());
  ledger_.book_supports(
      {held.linear - free.linear, Vec3::Zero()});  // the angular part is in book_closing's difference
  for (const Mechanism& mechanism : scene_.mechanisms)
    events_.push_back({time(), "separation", mechanism.name});
}

void Simulation::advance_to(std::int64_t target) {
  while (state_.step < target) {
    if (!closed_phase() && state_.step == preparation_.closing_step) close();
    std::int64_t stop = std::min(target, state_.step + health_interval);
    if (!closed_phase()) stop = std::min(stop, preparation_.closing_step);
    stepper_->advance(state_, stop - state_.step);
    check_health();
  }
  if (!closed_phase() && state_.step == preparation_.closing_step) close();
}

void Simulation::check_health() {
  if (!scene_.time.allow_unstable)
    check_contacts();  // first: an impact too hard is what makes a node run away
  if (!stepper_->healthy()) report_runaway();
}

// A contact that needs more than the elements leave of the stable step would grow without bound.
void Simulation::check_contacts() const {
  const auto check = [&](const char* kind, const std::string& name, const auto& tally) {
    if (!(tally.stiffest > 1)) return;
    const Index stiffest = tally.stiffest_element;
    const std::string what = stiffest < 0
                                 ? node_label(preparation_.assembly, kernel::sphere_label(stiffest))
                                 : element_label(preparation_.assembly, model().user_element[at(stiffest)]);
    char text[500];
    std::snprintf(
        text, sizeof text,
        "error: at t = %.9g s the contact of %s with %s '%s' needed %.3g times what the stable step leaves; "
        "likely cause: an impact too hard for the time step %.3g s (or an overlap at the start); a step of "
        "%.2g s would carry it",
        tally.stiffest_time, what.c_str(), kind, name.c_str(), tally.stiffest, preparation_.dt,
        preparation_.dt / tally.stiffest * 0.9);
    throw NumericalError(text);
  };
  for (std::size_t r = 0; r < state_.rings.size(); ++r)
    check("ring", preparation_.assembly.rings[r].name, state_.rings[r]);
  for (std::size_t b = 0; b < state_.balls.size(); ++b)
    for (const kernel::BallTally& tally : state_.balls[b])
      check("target", preparation_.assembly.balls[b].name, tally);
}

// Names the first node without a finite speed, else the fastest.
void Simulation::report_runaway() const {
  Index worst = 0;
  double fastest = -1;
  for (Index i = 0; i < model().nodes && std::isfinite(fastest); ++i) {
    const double speed = std::hypot(state_.vx[at(i)], state_.vy[at(i)], state_.vz[at(i)]);
    if (!(speed <= fastest)) {
      worst = i;
      fastest = speed;
    }
  }
  char text[600];
  std::snprintf(text, sizeof text,
                "error: at t = %.9g s %s at (%.6g, %.6g, %.6g) m moves at %.3g m/s (time.speed_limit_m_s = "
                "%.3g); likely "
                "cause: the time step %.3g s is too large (stable step %.3g s, limited by %s)",
                time(), node_label(preparation_.assembly, worst).c_str(), state_.x[at(worst)],
                state_.y[at(worst)], state_.z[at(worst)], fastest, scene_.time.speed_limit, preparation_.dt,
                preparation_.stable_step, preparation_.limited_by.c_str());
  throw NumericalError(text);
}

namespace {

// Ring centres and normals from their hosts, in both phases.
void place_rings(const Assembly& assembly, Frame& out) {
  for (const AssemblyRing& ring : assembly.rings) {
    if (ring.element < 0) {
      out.ring_center.push_back(out.position[at(ring.node)]);
      out.ring_normal.push_back(ring.normal);
      continue;
    }
    const AssemblyElement& host = assembly.elements[at(ring.element)];
    out.ring_center.push_back(0.5 * (out.position[at(host.a)] + out.position[at(host.b)]));
    out.ring_normal.push_back((out.position[at(host.b)] - out.position[at(host.a)]).normalized());
  }
}

}  // namespace

Frame Simulation::frame() {
  const Assembly& assembly = preparation_.assembly;
  Observation now = observe(*stepper_, state_);
  Frame out;
  out.time = time();
  out.step = state_.step;
  out.energy = ledger_.energies(now);
  out.position = std::move(now.position);
  out.velocity = std::move(now.velocity);
  if (out.position.size() < assembly.nodes.size()) append_laid_nodes(assembly, out.position, out.velocity);
  out.contact_force = std::move(now.contact_force);
  out.contact_force.resize(assembly.nodes.size(), Vec3::Zero());
  out.active.assign(now.tension.size(), 1);
  out.active.resize(assembly.elements.size(), 0);
  out.tension = std::move(now.tension);
  out.strain = std::move(now.strain);
  out.tension.resize(assembly.elements.size(), 0);
  out.strain.resize(assembly.elements.size(), 0);
  place_rings(assembly, out);
  out.ring_force = std::move(now.ring_force);
  out.ring_force.resize(assembly.rings.size(), Vec3::Zero());
  return out;
}

std::vector<double> Simulation::probe_row(const Frame& now) const {
  return probe_values(scene_, preparation_.assembly, now, node_start_, ring_start_);
}

void Simulation::note_events(const Frame& now) {
  if (!has_mouth_ || preparation_.closing_step < 0) return;
  const double area = mouth_area(now.ring_center);
  greatest_mouth_ = std::max(greatest_mouth_, area);
  if (!closed_phase() || now.step <= preparation_.closing_step) return;
  if (!mouth_closed_ && area < 0.05 * greatest_mouth_) {  // model.md: mouth closed
    mouth_closed_ = true;
    events_.push_back({now.time, "mouth_closed", "mouth"});
  }
  for (std::size_t b = 0; mouth_closed_ && b < enclosed_.size(); ++b)
    for (const NetSurface& surface : surfaces_)
      if (!enclosed_[b] && surface.encloses(now.position, preparation_.assembly.balls[b].center)) {
        enclosed_[b] = true;
        events_.push_back({now.time, "target_enclosed", preparation_.assembly.balls[b].name});
      }
}

ResultModel Simulation::result_model() const {
  const Assembly& assembly = preparation_.assembly;
  ResultModel m;
  m.case_name = scene_.name;
  m.title = scene_.title;
  m.about = scene_.about;
  m.case_toml = scene_.resolved_toml;
  m.version = cinch::version;
  m.commit = cinch::commit;
  m.compiler = cinch::compiler;
  m.isa = kernels().isa;
  m.threads = threads_;
  m.time_step = preparation_.dt;
  for (const AssemblyElement& e : assembly.elements) {
    m.elements.push_back({e.a, e.b});
    m.rest_length.push_back(e.rest_length);
    m.element_radius.push_back(e.radius);
    m.element_part.push_back(e.part);
  }
  for (const AssemblyNode& node : assembly.nodes) m.node_mass.push_back(node.mass);
  for (const Part& part : assembly.parts) m.parts.push_back({kind_name(part.kind), part.name, part.closing});
  for (const AssemblyRing& ring : assembly.rings)
    m.rings.push_back({ring.name, ring.radius, ring.wire_radius});
  for (const AssemblyBall& ball : assembly.balls) m.balls.push_back({ball.name, ball.center, ball.radius});
  for (const NamedNode& named : assembly.named) m.masses.push_back({named.name, named.node, named.mass});
  if (preparation_.closing_step >= 0)
    m.closing_time = static_cast<double>(preparation_.closing_step) * preparation_.dt;
  m.probes = probe_columns_;
  return m;
}

std::vector<Event> Simulation::all_events() const {
  std::vector<Event> events = events_;
  for (std::size_t r = 0; r < state_.rings.size(); ++r)
    if (state_.rings[r].state > 0)
      events.push_back({state_.rings[r].first_time, "ring_contact", preparation_.assembly.rings[r].name});
  for (std::size_t b = 0; b < state_.balls.size(); ++b) {
    double first = -1;
    for (const kernel::BallTally& tally : state_.balls[b])
      if (tally.first_time >= 0 && (first < 0 || tally.first_time < first)) first = tally.first_time;
    if (first >= 0) events.push_back({first, "target_contact", preparation_.assembly.balls[b].name});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& l, const Event& r) { return l.time < r.time; });
  return events;
}

Summary Simulation::summary() {
  const Assembly& assembly = preparation_.assembly;
  Summary s;
  s.case_name = scene_.name;
  s.version = cinch::version;
  s.commit = cinch::commit;
  s.compiler = cinch::compiler;
  s.isa = kernels().isa;
  s.threads = threads_;
  s.steps = state_.step;
  s.time_step = preparation_.dt;
  s.simulated_seconds = time();
  s.nodes = static_cast<Index>(assembly.nodes.size());
  s.elements = static_cast<Index>(assembly.elements.size());
  s.rings = static_cast<Index>(assembly.rings.size());
  s.stable_step = preparation_.stable_step;
  s.stable_step_limited_by = preparation_.limited_by;
  s.state_hash = state_hash(state_);
  s.energy = ledger_.energies(observe(*stepper_, state_));
  s.energy_initial = ledger_.initial();
  if (!scene_.output.ledger) s.energy.residual = std::numeric_limits<double>::quiet_NaN();  // books not kept
  s.relative_residual = ledger_.scale() > 0 ? std::abs(s.energy.residual) / ledger_.scale() : 0;
  if (s.relative_residual > residual_limit)
    s.warnings.push_back(
        "energy is not conserved (residual above 1 %); a smaller time.step_s or more damping may help");
  const Momentum drift = ledger_.drift(model(), state_, time());
  s.linear_momentum_drift = drift.linear.norm();
  if (!model().has_gravity) s.angular_momentum_drift = drift.angular.norm();
  for (const kernel::RingTally& ring : state_.rings)
    s.max_penetration = std::max(s.max_penetration, ring.max_penetration);
  for (const auto& ball : state_.balls)
    for (const kernel::BallTally& tally : ball)
      s.max_penetration = std::max(s.max_penetration, tally.max_penetration);
  for (std::size_t stage = 0; stage < stage_count; ++stage)
    s.stages.push_back(
        {stage_name(static_cast<StageId>(stage)), seconds_[stage] + stepper_->seconds()[stage]});
  s.events = all_events();
  for (std::size_t r = 0; r < assembly.rings.size(); ++r) {
    RingRecord record;
    record.name = assembly.rings[r].name;
    if (r < state_.rings.size()) {
      const kernel::RingTally& tally = state_.rings[r];
      record.first_contact_time = tally.first_time;
      record.first_contact_force = tally.first_peak;
      record.peak_force = tally.peak_force;
      record.peak_time = tally.peak_time;
    }
    s.ring_records.push_back(record);
  }
  return s;
}

}  // namespace cinch
