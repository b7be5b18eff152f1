#include "plan/simulation.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "plan/health.hpp"
#include "plan/probes.hpp"
#include "statics/equilibrium.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Steps between two looks at speeds and at the contacts' stiffness: a second of a large net's run time at
// most.
std::int64_t health_interval(Index nodes) {
  return std::clamp<std::int64_t>((1 << 22) / std::max(nodes, 1), 256, 4096);
}

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
  std::vector<double> share;
  if (p.plan.contacts()) share = node_share(p.model, p.bound, preparation_.dt);
  stepper_ = std::make_unique<Stepper>(p.model, p.plan, std::move(share), threads_);
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
  drop_negative_zeros(state_);
  remember();
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
  drop_negative_zeros(state_);
  const Momentum held = half_step_momentum(model(), state_);
  const Observation separated = observe(*stepper_, state_);
  ledger_.book_closing(before, after, laid, separated, state_, before_model, model());
  remember();
  ledger_.book_supports(
      {held.linear - free.linear, Vec3::Zero()});  // the angular part is in book_closing's difference
  for (const Mechanism& mechanism : scene_.mechanisms)
    events_.push_back({time(), "separation", mechanism.name});
}

void Simulation::advance_to(std::int64_t target) {
  while (state_.step < target) {
    if (!closed_phase() && state_.step == preparation_.closing_step) close();
    std::int64_t stop = std::min(target, state_.step + health_interval(model().nodes));
    if (!closed_phase()) stop = std::min(stop, preparation_.closing_step);
    stepper_->advance(state_, stop - state_.step);
    check_health();
  }
  if (!closed_phase() && state_.step == preparation_.closing_step) close();
}

void Simulation::check_health() {
  if (!scene_.time.allow_unstable)
    check_contacts(preparation_, state_);  // first: an impact too hard is what makes a node run away
  if (!stepper_->healthy()) report_runaway(preparation_, model(), state_, scene_.time.speed_limit);
  if (!speeds_allowed(state_, scene_.time.speed_limit)) find_fault();
  if (state_.step - sound_.step >= health_interval(model().nodes)) remember();
}

void Simulation::remember() { sound_ = state_; }

// Scenes without contacts do not watch speeds at every step: the step that went wrong is found by doing
// again, one by one, those since the last sound state.
void Simulation::find_fault() {
  const std::int64_t seen = state_.step;
  state_ = sound_;
  stepper_->start_over();
  while (state_.step < seen && speeds_allowed(state_, scene_.time.speed_limit)) stepper_->advance(state_, 1);
  report_runaway(preparation_, model(), state_, scene_.time.speed_limit);
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

}  // namespace cinch
