#include "plan/stepper.hpp"

#include <omp.h>

#include <chrono>
#include <cmath>

#include "base/error.hpp"

namespace cinch {
namespace {

constexpr std::int64_t timed_every =
    64;  // a clock reading costs as much as a small kernel: time few steps, scale up

// The stretch of `count` items that belongs to `thread` of `threads`.
struct Share {
  Index begin, end;
  Share(std::size_t count, int thread, int threads)
      : begin(
            static_cast<Index>(count * static_cast<std::size_t>(thread) / static_cast<std::size_t>(threads))),
        end(static_cast<Index>(count * (static_cast<std::size_t>(thread) + 1) /
                               static_cast<std::size_t>(threads))) {}
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Adds the time between two ticks to a stage, on timed steps only.
class StageClock {
 public:
  StageClock(bool timed, std::array<double, stage_count>& seconds) : timed_(timed), seconds_(seconds) {
    if (timed_) last_ = now();
  }
  void tick(StageId stage) {
    if (!timed_) return;
    const double t = now();
    seconds_[static_cast<std::size_t>(stage)] += static_cast<double>(timed_every) * (t - last_);
    last_ = t;
  }

 private:
  bool timed_;
  std::array<double, stage_count>& seconds_;
  double last_ = 0;
};

}  // namespace

Stepper::Stepper(const Model& model, const StepPlan& plan, AlignedVector<double> node_share, int threads)
    : model_(&model),
      plan_(plan),
      threads_(threads),
      node_share_(std::move(node_share)),
      contacts_(model, plan.margin),
      watch_(model.node_blocks.size()) {
  for (auto* f : {&fx_, &fy_, &fz_}) f->assign(static_cast<std::size_t>(model.elements), 0.0);
  contacts_.gather.rebuild({}, static_cast<Index>(model.node_blocks.size()));
}

// Points the kernels' arguments at the state and at lists that may have moved.
void Stepper::bind(State& s) {
  const Model& m = *model_;
  axial_ = {s.x.data(),           s.y.data(),  s.z.data(),         s.vx.data(),
            s.vy.data(),          s.vz.data(), m.stiffness.data(), m.damping.data(),
            m.rest_length.data(), fx_.data(),  fy_.data(),         fz_.data(),
            s.dissipated.data(),  plan_.dt};
  const kernel::ContactArguments contact{s.x.data(),
                                         s.y.data(),
                                         s.z.data(),
                                         s.vx.data(),
                                         s.vy.data(),
                                         s.vz.data(),
                                         node_share_.data(),
                                         contacts_.candidates.data(),
                                         contacts_.load_x.data(),
                                         contacts_.load_y.data(),
                                         contacts_.load_z.data(),
                                         plan_.alpha_ring,
                                         0,
                                         plan_.dt,
                                         plan_.dt};
  ring_ = {contact,      m.rings.data(), contacts_.ring_begin.data(), s.rings.data(), contacts_.host_slot,
           plan_.golden, plan_.couple};
  node_ = {s.x.data(),
           s.y.data(),
           s.z.data(),
           s.vx.data(),
           s.vy.data(),
           s.vz.data(),
           m.mass.data(),
           m.inverse_mass.data(),
           fx_.data(),
           fy_.data(),
           fz_.data(),
           m.gather.stretches.data(),
           m.gather.sources.data(),
           contacts_.load_x.data(),
           contacts_.load_y.data(),
           contacts_.load_z.data(),
           contacts_.gather.entries.data(),
           contacts_.gather.begin.data(),
           m.constraints.data(),
           s.reactions.data(),
           {m.gravity.x(), m.gravity.y(), m.gravity.z()},
           plan_.dt};
}

void Stepper::forces(State& state, double time, double booked_dt, int thread) {
  const Model& m = *model_;
  StageClock clock(thread == 0 && booked_dt > 0 && state.step % timed_every == 0, seconds_);
  const Share blocks(m.element_blocks.size(), thread, threads_);
  kernel::AxialArguments axial = axial_;
  axial.dt = booked_dt;
  kernels().axial_forces[plan_.damped][plan_.ledger](axial, m.element_blocks.data(), m.spans.data(),
                                                     blocks.begin, blocks.end);
  clock.tick(StageId::axial_forces);
  if (plan_.rings) {
    const Share rings(m.rings.size(), thread, threads_);
    kernel::RingArguments ring = ring_;
    ring.contact.time = time;
    ring.contact.dt = booked_dt;
    kernels().ring_contacts(ring, rings.begin, rings.end);
    clock.tick(StageId::ring_contact);
  }
  if (plan_.balls) {
    ball_forces(state, time, booked_dt, thread);
    clock.tick(StageId::target_contact);
  }
}

void Stepper::ball_forces(State& state, double time, double booked_dt, int thread) {
  for (std::size_t b = 0; b < model_->balls.size(); ++b) {
    const Model::Ball& ball = model_->balls[b];
    kernel::BallArguments g{
        ring_.contact, {ball.center.x(), ball.center.y(), ball.center.z()}, ball.radius, 0};
    g.contact.alpha = plan_.alpha_target;
    g.contact.time = time;
    g.contact.dt = booked_dt;
    const Index begin = contacts_.ball_begin[b], end = contacts_.ball_begin[b + 1];
    const auto chunks = static_cast<std::size_t>((end - begin + ball_chunk - 1) / ball_chunk);
    const Share mine(chunks, thread, threads_);
    for (Index chunk = mine.begin; chunk < mine.end; ++chunk) {
      const Index first = begin + chunk * ball_chunk;
      kernels().ball_contacts(g, first, std::min(first + ball_chunk, end),
                              state.balls[b][static_cast<std::size_t>(chunk)]);
    }
  }
}

void Stepper::update(int thread) {
  const Share blocks(model_->node_blocks.size(), thread, threads_);
  kernels().update_nodes[plan_.gravity](node_, model_->node_blocks.data(), blocks.begin, blocks.end,
                                        watch_.data());
}

Stepper::Verdict Stepper::watch(double& margin_used) const {
  double greatest = 0, sum = 0;
  for (const kernel::Watch& w : watch_) {
    greatest = w.greatest > greatest ? w.greatest : greatest;
    sum += w.sum;
  }
  if (!std::isfinite(sum) || greatest > plan_.speed_limit * plan_.speed_limit) return Verdict::unhealthy;
  if (!plan_.contacts()) return Verdict::go_on;
  // two items approach each other by at most twice the greatest speed
  margin_used += 2 * plan_.dt * std::sqrt(greatest);
  return margin_used < contacts_.margin() ? Verdict::go_on : Verdict::renew_contacts;
}

void Stepper::meet() const {
  if (threads_ == 1) return;
#pragma omp barrier
}

// The steps of one thread; every thread returns the same number and verdict.
std::int64_t Stepper::run_thread(State& state, std::int64_t steps, int thread, Verdict& verdict) {
  double margin_used = margin_used_;
  const std::int64_t first = state.step;
  std::int64_t done = 0;
  verdict = Verdict::go_on;
  while (done < steps && verdict == Verdict::go_on) {
    forces(state, static_cast<double>(first + done) * plan_.dt, plan_.dt, thread);
    StageClock clock(thread == 0 && (first + done) % timed_every == 0, seconds_);
    meet();
    clock.tick(StageId::meeting);
    update(thread);
    if (thread == 0) state.step = first + done + 1;
    clock.tick(StageId::gather_and_move);
    meet();
    clock.tick(StageId::meeting);
    verdict = watch(margin_used);
    ++done;
  }
  meet();
  if (thread == 0) margin_used_ = margin_used;
  return done;
}

// One parallel region over as many steps as possible.
std::int64_t Stepper::run(State& state, std::int64_t steps, Verdict& verdict) {
  if (threads_ == 1) return run_thread(state, steps, 0, verdict);
  std::int64_t done = 0;
#pragma omp parallel num_threads(threads_)
  {
    Verdict mine = Verdict::go_on;
    // fewer threads than shares would leave work undone; all threads see the same number and none enters the
    // steps
    const bool enough = omp_get_num_threads() == threads_;
    const std::int64_t my_done = enough ? run_thread(state, steps, omp_get_thread_num(), mine) : -1;
    if (omp_get_thread_num() == 0) {
      done = my_done;
      verdict = mine;
    }
  }
  if (done < 0) throw Error(ExitCode::internal, "error: OpenMP gave fewer threads than it did at the start");
  return done;
}

void Stepper::renew_contacts(State& state) {
  const double begin = now();
  contacts_.rebuild(*model_, state);
  margin_used_ = 0;
  contacts_valid_ = true;
  bind(state);
  add_seconds(StageId::broadphase, now() - begin);
}

void Stepper::advance(State& state, std::int64_t steps) {
  bind(state);
  while (steps > 0 && healthy_) {
    if (plan_.contacts() && !contacts_valid_) renew_contacts(state);
    Verdict verdict = Verdict::go_on;
    steps -= run(state, steps, verdict);
    if (verdict == Verdict::unhealthy) healthy_ = false;
    if (verdict == Verdict::renew_contacts) contacts_valid_ = false;
  }
}

void Stepper::evaluate(State& state) {
  bind(state);
  if (plan_.contacts() && !contacts_valid_) renew_contacts(state);
  const int threads = threads_;
  threads_ = 1;  // a single evaluation is not worth a parallel region
  forces(state, static_cast<double>(state.step) * plan_.dt, 0, 0);
  threads_ = threads;
}

}  // namespace cinch
