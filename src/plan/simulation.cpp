#include "plan/simulation.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "base/error.hpp"
#include "plan/contact_health.hpp"
#include "plan/health.hpp"
#include "plan/probes.hpp"
#include "plan/thread_ends.hpp"
#include "scene/fault.hpp"
#include "statics/equilibrium.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// Steps between two looks at speeds and at the contacts' stiffness: a second of a large net's run time at
// most.
std::int64_t health_interval(Index nodes) {
  return std::clamp<std::int64_t>((1 << 22) / std::max(nodes, 1), 256, 4096);
}

constexpr std::size_t history_length = 8;  ///< looks at speeds that a run which fails tells of

EquilibriumResult equilibrium_of(const StaticNet& net, const Assembly& assembly, const SourceRef& source) {
  try {
    return find_equilibrium(net);
  } catch (const CanFall& fall) {
    const Vec3& place = net.position[fall.node];
    char text[300];
    std::snprintf(text, sizeof text,
                  "start.equilibrium: found true, but %s at (%.6g, %.6g, %.6g) m and what is tied to it (%zu "
                  "nodes) can fall: no fixed node and no guide holds them; allowed: false, or a support for "
                  "each piece",
                  node_label(assembly, static_cast<Index>(fall.node)).c_str(), place.x(), place.y(),
                  place.z(), fall.nodes);
    fail(source, text);
  }
}

// What is sought knows elements, weights and supports: a thread would hang beside the rings that it slides
// through, and be drawn back to them at once.
void require_no_sliding_thread(const Assembly& assembly, const SourceRef& source) {
  for (const AssemblyRing& ring : assembly.rings)
    for (const Threading& threading : ring.threadings)
      if (const Part& part = assembly.parts[at(threading.part)]; !part.closing)
        fail(source, "start.equilibrium: found true, but " + part.reference() + " slides through ring '" +
                         ring.name +
                         "', which the equilibrium does not know; allowed: false, rings on closing threads "
                         "alone, or joint = \"contact\" for rings that the thread hangs clear of");
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
  require_no_sliding_thread(assembly, scene.equilibrium_source);
  const EquilibriumResult found = equilibrium_of(net, assembly, scene.equilibrium_source);
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

void move_nodes(State& state, const Nudge& nudge) {
  std::mt19937 generator(nudge.seed);
  const auto next = [&] { return nudge.most * (static_cast<double>(generator()) / 2147483648.0 - 1); };
  for (std::size_t i = 0; i < state.x.size(); ++i)
    state.x[i] += next(), state.y[i] += next(), state.z[i] += next();
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

Simulation::Simulation(const Scene& scene, int threads) : Simulation(scene, prepare(scene), threads) {}

Simulation::Simulation(const Scene& scene, Preparation preparation, int threads, const Nudge& nudge)
    : scene_(scene), preparation_(std::move(preparation)) {
  make_ready(threads);
  find_start();
  start(nudge);
}

Simulation::Simulation(const Scene& scene, Preparation preparation, int threads, Archive& saved)
    : scene_(scene), preparation_(std::move(preparation)) {
  make_ready(threads);
  restore(saved);
}

void Simulation::make_ready(int threads) {
  kernels();  // throws where CINCH_ISA is wrong: not within a region of threads
  omp_set_dynamic(0);
  const Index elements = preparation_.whole().elements;
  const bool tries = threads == 0 && ThreadChoice::worth_it(elements);
  const int wanted = threads > 0 ? threads : choose_threads(elements, omp_get_max_threads());
  const int given = available_threads(tries ? omp_get_max_threads() : wanted);
  threads_ = std::min(wanted, given);
  if (tries) most_threads_ = given;
  probe_columns_ = cinch::probe_columns(scene_, preparation_.assembly);
  enclosed_.assign(preparation_.assembly.balls.size(), false);
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
  if (p.plan.contacts()) share = node_share(p.model, p.plan.dt, p.plan.joint_steps);
  stepper_ = std::make_unique<Stepper>(p.model, p.plan, std::move(share), threads_);
  choice_ = {threads_, ThreadChoice::worth_it(p.model.elements) ? most_threads_ : 1};
  // a run that tries how many threads pay takes what others leave free
  if (most_threads_ == 1) stepper_->bind_threads();
}

// Central differences begin with velocities half a step back: v(-1/2) = v(0) - dt/2 a(0).
void Simulation::start(const Nudge& nudge) {
  state_ = initial_state(model(), preparation_.assembly);
  if (nudge.most > 0) move_nodes(state_, nudge);
  preparation_.assembly.forget_start();
  enter_phase(0);
  const Model& m = model();
  double work = 0;
  if (preparation_.closing_step == 0) {
    const double before = kinetic_energy(m, state_);
    separate(preparation_.assembly, state_);
    hold_supports(m, state_);
    work = kinetic_energy(m, state_) - before;
    for (const Mechanism& mechanism : scene_.mechanisms) events_.push_back({0, "separation", mechanism.name});
  }
  take_half_step_back();
  drop_negative_zeros(state_);
  remember();
  look();
  ledger_.open(look_.energy(), m, state_, work);
  overlaps_.begin(m, state_, stepper_->contacts(), 0, look_.energy().contact, look_.energy());
  ring_start_ = look_.ring_centers();
  threadings_.begin(look_, stepper_->contacts());
  if (needs_node_start(scene_)) node_start_ = look_.positions();
  find_mouth();
  note_events(look_);
}

// Rings along one straight edge are no mouth: their hull has next to no area.
void Simulation::find_mouth() {
  const double spread = mouth_spread(ring_start_);
  has_mouth_ = mouth_area(ring_start_) > 0.01 * spread * spread;
  if (has_mouth_) find_surfaces();
  require_mouth();
}

// Where the run ends when it has closed.
void Simulation::require_mouth() const {
  if (scene_.time.end_when == EndWhen::never || (has_mouth_ && preparation_.closing_step >= 0)) return;
  fail(scene_.time.end_when_source,
       "time.end_when = \"mouth_closed\", but the case has no mouth that closes; it needs closing.time_s and "
       "three rings or more that do not lie along one line");
}

// Velocities by so many steps, by what the last look saw.
void Simulation::set_back(double steps) {
  for (Index i = 0; i < model().nodes; ++i) {
    const Vec3 gain = steps * look_.gain(i);
    state_.vx[at(i)] -= gain.x();
    state_.vy[at(i)] -= gain.y();
    state_.vz[at(i)] -= gain.z();
  }
}

// From velocities of the state's own time to those of half a step back.
void Simulation::take_half_step_back() {
  look_.take(*stepper_, state_, preparation_.assembly, false);
  set_back(0.5);
}

// The nets that can enclose a target when their mouth closes.
void Simulation::find_surfaces() {
  if (enclosed_.empty() || preparation_.closing_step < 0) return;
  for (const Net& net : scene_.nets)
    for (const Part& part : preparation_.assembly.parts)
      if (part.kind == PartKind::net && part.name == net.name)
        surfaces_.emplace_back(net, part.nodes.front());
}

// Where the step changes, threads are laid with the velocities of the closing time itself: half a step back
// is elsewhere then.
void Simulation::lay_threads() {
  const Timeline& timeline = preparation_.timeline;
  const bool other_step = timeline.before() != timeline.after();
  const Momentum old = half_step_momentum(model(), state_);
  if (other_step) set_back(-0.5);
  state_ = lay_closing_threads(preparation_.phases[0].model, preparation_.phases[1].model,
                               preparation_.assembly, state_);
  enter_phase(1);
  if (!other_step) return;
  take_half_step_back();
  // what acts from outside has pushed between the two instants; the angular part is in book_closing's
  // difference
  const Momentum now = half_step_momentum(model(), state_);
  ledger_.book_outside({now.linear - old.linear, Vec3::Zero()});
}

void Simulation::close() {
  const Model& before_model = model();
  const Energies before = look().energy();
  const State old = state_;
  lay_threads();
  const Energies laid = look().energy();
  separate(preparation_.assembly, state_);
  const Momentum free = half_step_momentum(model(), state_);
  hold_supports(model(), state_);
  drop_negative_zeros(state_);
  const Momentum held = half_step_momentum(model(), state_);
  const Energies separated = look().energy();
  ledger_.book_closing(before, old, laid, separated, state_, before_model, model());
  remember();
  threadings_.begin(look(), stepper_->contacts());
  overlaps_.begin(model(), state_, stepper_->contacts(), preparation_.assembly.elements_before,
                  laid.contact - before.contact, look_.energy());
  ledger_.book_outside({held.linear - free.linear, Vec3::Zero()});  // angular: as above
  for (const Mechanism& mechanism : scene_.mechanisms)
    events_.push_back({time(), "separation", mechanism.name});
}

// Steps at which speeds are looked at and states kept, counted from where the phase began: the same after a
// restart and however a run was told to go on, so that what a run that fails leaves does not hang on that.
std::int64_t Simulation::steps_into_interval() const {
  const std::int64_t begin = closed_phase() ? std::max<std::int64_t>(preparation_.closing_step, 0) : 0;
  return (state_.step - begin) % health_interval(model().nodes);
}

void Simulation::advance_towards(std::int64_t target, std::int64_t pause) {
  while (state_.step < std::min(target, pause)) {
    if (!closed_phase() && state_.step == preparation_.closing_step) close();
    const std::int64_t next = state_.step + health_interval(model().nodes) - steps_into_interval();
    std::int64_t stop = std::min(target, next);
    if (!closed_phase()) stop = std::min(stop, preparation_.closing_step);
    advance_with_threads_that_pay(std::min(stop, pause));
    if (state_.step < stop && stepper_->healthy()) return;  // a pause
    check_health();
    if (state_.step < next) continue;
    note_pace();
    remember();
  }
  if (!closed_phase() && state_.step == preparation_.closing_step) close();
}

void Simulation::use_threads(int threads) {
  threads_ = available_threads(threads);
  most_threads_ = 1;
  choice_ = {threads_, 1};
  stepper_->bind_threads();
}

// Or to where something is wrong.
void Simulation::advance_with_threads_that_pay(std::int64_t stop) {
  while (state_.step < stop && stepper_->healthy()) {
    const std::int64_t from = state_.step, flown = stepper_->flown();
    const double begin = clock_seconds();
    stepper_->use_threads(choice_.threads(), state_);
    stepper_->advance(state_, choice_.steps(stop - from));
    choice_.note(state_.step - from, clock_seconds() - begin, stepper_->flown() > flown);
  }
}

void Simulation::check_health() {
  overlaps_.blame(preparation_, state_, [this] { find_faults(); });
}

void Simulation::find_faults() {
  if (!scene_.time.allow_unstable)
    check_contacts(preparation_, phase(), state_);  // first: an impact too hard is what makes a node run away
  if (stepper_->jump()) report_jump(preparation_, phase(), state_, *stepper_->jump());
  if (!stepper_->healthy()) report_runaway(preparation_, phase(), state_, scene_.time.speed_limit);
  if (!speeds_allowed(state_, scene_.time.speed_limit)) find_fault();
}

void Simulation::note_pace() {
  if (history_.size() == history_length) history_.erase(history_.begin());
  history_.push_back({time(), fastest_node(state_)});
}

void Simulation::remember() { sound_ = state_; }

void Simulation::step_back() {
  note_pace();  // of what went wrong
  state_ = sound_;
  stepper_->start_over();
}

// Scenes without contacts do not watch speeds at every step: the step that went wrong is found by doing
// again, one by one, those since the last sound state.
void Simulation::find_fault() {
  const std::int64_t seen = state_.step;
  step_back();
  while (state_.step < seen && speeds_allowed(state_, scene_.time.speed_limit)) stepper_->advance(state_, 1);
  report_runaway(preparation_, phase(), state_, scene_.time.speed_limit);
}

const Look& Simulation::look() {
  look_.take(*stepper_, state_, preparation_.assembly);
  return look_;
}

Frame Simulation::frame(const Look& now) {
  const Index nodes = preparation_.assembly.node_count(), elements = preparation_.whole().elements;
  if (state_.step > sound_.step) remember();  // a run that fails later goes back no further
  Frame out;
  out.time = now.time();
  out.step = now.step();
  out.energy = ledger_.energies(now.energy());
  out.position = now.positions();
  out.contact_force = now.contact_forces();
  out.velocity.reserve(at(nodes));
  for (Index i = 0; i < nodes; ++i) out.velocity.push_back(now.velocity(i));
  for (auto* field : {&out.tension, &out.strain}) field->reserve(at(elements));
  out.active.reserve(at(elements));
  for (Index e = 0; e < elements; ++e) {
    const Look::Pull pull = now.pull(e);
    out.tension.push_back(pull.tension);
    out.strain.push_back(pull.strain);
    out.active.push_back(now.present(e));
  }
  out.ring_center = now.ring_centers();
  for (Index r = 0; r < static_cast<Index>(out.ring_center.size()); ++r) {
    out.ring_normal.push_back(now.ring_normal(r));
    out.ring_force.push_back(now.ring_force(r));
  }
  const Model& whole = preparation_.whole();
  for (Index j = 0; j < static_cast<Index>(whole.joints.size()); ++j) {
    out.joint_element.push_back(now.joint_element(whole, j));
    out.joint_waypoint.push_back(now.joint_waypoint(whole, j));
  }
  return out;
}

void Simulation::check_energy(const Look& now) {
  const double limit = scene_.time.residual_limit, residual = ledger_.energies(now.energy()).residual;
  if (scene_.output.ledger && !scene_.time.allow_unstable)
    overlaps_.blame(preparation_, state_, [&] {
      cinch::check_energy(preparation_, phase(), state_, residual, ledger_.scale(), limit);
    });
  overlaps_.note_sound(now.step());
}

std::vector<double> Simulation::probe_row(const Look& now) {
  return probe_values(scene_, now, ledger_.energies(now.energy()), node_start_, ring_start_);
}

// All that have been lost are noted before one stops the run.
void Simulation::note_losses(const Look& now) {
  const std::vector<ThreadingWatch::Loss> losses = threadings_.losses(now, stepper_->contacts());
  for (const ThreadingWatch::Loss& loss : losses)
    events_.push_back({now.time(), "thread_left",
                       preparation_.assembly.rings[at(loss.ring)].name + ": " +
                           preparation_.assembly.parts[at(loss.part)].reference()});
  if (!losses.empty() && scene_.contact.leaving == Leaving::stop)
    overlaps_.blame(preparation_, state_, [&] { report_loss(preparation_, now, losses.front()); });
}

// Each once.
void Simulation::note_drawn_ends(const Look& now) {
  for (const DrawnEnd& end : drawn_ends(now)) {
    const std::string name = preparation_.assembly.rings[at(now.model().joints[at(end.joint)].ring)].name +
                             ": " + node_label(preparation_.assembly, end.node);
    const auto same = [&](const Event& event) { return event.kind == "thread_end" && event.name == name; };
    if (std::none_of(events_.begin(), events_.end(), same))
      events_.push_back({now.time(), "thread_end", name});
  }
}

std::int64_t Simulation::end_step() const {
  if (scene_.time.end_when == EndWhen::never) return preparation_.end_step;
  const auto closed = std::find_if(events_.begin(), events_.end(),
                                   [](const Event& event) { return event.kind == "mouth_closed"; });
  if (closed == events_.end()) return preparation_.end_step;
  return std::min(preparation_.end_step, preparation_.timeline.step_at(closed->time + scene_.time.end_delay));
}

// Shares of the greatest area that the mouth ever had: below the first it is closed (model.md), beyond the
// second it is open again.
void Simulation::note_mouth(const Look& now, double area) {
  constexpr double closed = 0.05, open_again = 0.1;
  if (mouth_closed_ ? !(area > open_again * greatest_mouth_) : !(area < closed * greatest_mouth_)) return;
  mouth_closed_ = !mouth_closed_;
  events_.push_back({now.time(), mouth_closed_ ? "mouth_closed" : "mouth_reopened", "mouth"});
}

// An open mouth catches none, but what is inside when it opens is lost only when it is outside.
void Simulation::note_targets(const Look& now) {
  for (std::size_t b = 0; b < enclosed_.size(); ++b) {
    if (!enclosed_[b] && !mouth_closed_) continue;
    const AssemblyBall& ball = preparation_.assembly.balls[b];
    const bool inside = std::any_of(surfaces_.begin(), surfaces_.end(), [&](const NetSurface& surface) {
      return surface.encloses(now.positions(), ball.center);
    });
    if (inside == enclosed_[b]) continue;
    enclosed_[b] = inside;
    events_.push_back({now.time(), inside ? "target_enclosed" : "target_lost", ball.name});
  }
}

void Simulation::note_events(const Look& now) {
  if (!threadings_.empty()) note_losses(now);
  note_drawn_ends(now);
  if (!has_mouth_ || preparation_.closing_step < 0) return;
  const double area = now.mouth_area();
  greatest_mouth_ = std::max(greatest_mouth_, area);
  if (!closed_phase() || now.step() <= preparation_.closing_step) return;
  note_mouth(now, area);
  note_targets(now);
}

}  // namespace cinch
