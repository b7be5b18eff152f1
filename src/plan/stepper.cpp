#include "plan/stepper.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "base/caught.hpp"
#include "base/error.hpp"
#include "plan/contact_shares.hpp"
#include "plan/core_binding.hpp"
#include "plan/partition.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Stepper::Stepper(const Model& model, const StepPlan& plan, std::vector<double> node_share, int threads)
    : model_(&model),
      plan_(plan),
      threads_(threads),
      node_share_(std::move(node_share)),
      contacts_(model, plan.margin, threads) {
  if (threads_ == 1) make_whole_piece();
  if (plan_.fly && plan_.flight_obstacle(model).empty()) flight_.emplace(model, plan_);
}

void Stepper::make_whole_piece() {
  pieces_.clear();
  pieces_.push_back(std::make_unique<Piece>(*model_, plan_, node_share_));
}

void Stepper::use_threads(int threads, State& state) {
  if (threads == threads_) return;
  if (dampers_.empty() && !(plan_.damped && plan_.ledger && gather_dampers())) dampers_ = {};
  threads_ = threads;
  contacts_.use_threads(threads);
  pieces_.clear();  // of several threads they are made at the next advance
  if (threads_ > 1) return;
  make_whole_piece();
  if (contacts_valid_) hand_out_contacts(state);
  if (!dampers_.empty()) hand_out_dampers();
}

// Calls visit(p) for each piece p, from the thread that steps it.
template <class Visit>
void Stepper::each_by_its_thread(Visit visit) const {
  if (threads_ == 1) return visit(0);  // a region of one thread takes a microsecond, too
  Caught caught;
#pragma omp parallel for num_threads(threads_) schedule(static, 1)
  for (int p = 0; p < threads_; ++p)
    caught.run([&] {
      const CoreBinding bound(bind_, p, threads_);
      visit(p);
    });
  caught.rethrow();
}

// Deeper ghosts let threads meet less often, as long as they are few beside a thread's own nodes.
int Stepper::sweep_depth(const std::vector<std::vector<Index>>& shares) const {
  if (plan_.contacts()) return 1;
  for (int depth = 4; depth > 1; depth /= 2) {
    bool few = true;
    for (const auto& own : shares)
      few = few && 8 * Numbering::of(own, model_->topology, model_->nodes, depth).ghosts() <=
                       static_cast<Index>(own.size());
    if (few) return depth;
  }
  return 1;
}

void Stepper::make_pieces(const std::vector<std::vector<Index>>& shares) {
  const int depth = sweep_depth(shares);
  owner_.assign(at(model_->nodes), 0);
  for (std::size_t p = 0; p < shares.size(); ++p)
    for (const Index node : shares[p]) owner_[at(node)] = static_cast<int>(p);
  pieces_.resize(shares.size());
  // each thread makes its own piece: memory lies with who touches it first
  each_by_its_thread([&](int p) {
    pieces_[at(p)] = std::make_unique<Piece>(*model_, plan_, node_share_, shares[at(p)], depth);
  });
}

void Stepper::share_out(State& state) {
  if (plan_.contacts() && !contacts_valid_) renew_contacts(state);
  make_pieces(partition(*model_, state, contacts_, threads_));
  if (plan_.contacts()) hand_out_contacts(state);
  else exchange_.set_up(pieces_, owner_, false, plan_.dt);
  if (!dampers_.empty()) hand_out_dampers();
}

void Stepper::start_over() {
  contacts_valid_ = false;
  healthy_ = true;
  jump_.reset();
  for (const auto& piece : pieces_) piece->forget_dampers();
}

void Stepper::hand_out_dampers() {
  for (const auto& piece : pieces_) piece->set_dampers(dampers_);
  dampers_ = {};
}

// False where there are none.
bool Stepper::gather_dampers() {
  dampers_.assign(at(model_->elements), 0.0);
  bool known = false;
  for (const auto& piece : pieces_) known = piece->tell_dampers(dampers_) || known;
  return known;
}

void Stepper::transfer_dampers(Archive& archive) {
  const bool waiting = !dampers_.empty();  // restored, and no step since
  bool known = waiting || (!archive.restoring() && gather_dampers());
  archive.flag("dampers/known", known);
  if (known) {
    dampers_.resize(at(model_->elements));
    archive.values("dampers/force", std::span(dampers_));
  }
  if (archive.restoring() && known && !pieces_.empty()) hand_out_dampers();
  if (!archive.restoring() && !waiting) dampers_ = {};
}

void Stepper::transfer(Archive& archive, State& state) {
  if (plan_.damped && plan_.ledger) transfer_dampers(archive);
  if (!plan_.contacts()) return;
  archive.flag("contacts/valid", contacts_valid_);
  archive.value("contacts/motion", motion_);
  if (!contacts_valid_) return;
  contacts_.transfer(archive, *model_);
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    if (static_cast<Index>(state.balls[b].size()) !=
        1 + contacts_.ball_begin[b + 1] - contacts_.ball_begin[b])
      archive.refuse("targets", "does not fit the pairs of contacts");
  if (!archive.restoring()) return;
  contacts_.measure_hosts(*model_, state, motion_);
  if (!pieces_.empty()) hand_out_contacts(state);
}

void Stepper::hand_out_contacts(State& state) {
  if (threads_ == 1)
    return pieces_[0]->contacts().renew(all_contacts(*model_, contacts_, state), contacts_.margin(),
                                        node_share_.data());
  each_by_its_thread(
      [&](int p) { hand_out(*model_, contacts_, state, owner_, p, node_share_, *pieces_[at(p)]); });
  exchange_.set_up(pieces_, owner_, true, plan_.dt);
}

void Stepper::renew_contacts(State& state) {
  const double begin = clock_seconds();
  contacts_.rebuild(*model_, state);
  release_lonely_rings(*model_, contacts_, state);
  motion_ = 0;
  contacts_valid_ = true;
  if (!pieces_.empty()) hand_out_contacts(state);
  search_ += clock_seconds() - begin;
}

// By which two nodes come closer in one step, at most, m.
double Stepper::approach(double greatest) const { return 2 * plan_.dt * std::sqrt(greatest); }

void Stepper::judge(double greatest, Progress& p) const {
  const double approached = approach(greatest);
  p.motion += approached;
  if (!(p.motion < contacts_.margin())) p.verdict = Verdict::renew_contacts;
  if (contacts_.may_jump(approached, p.motion)) p.verdict = Verdict::look_closer;
  if (greatest > plan_.speed_limit * plan_.speed_limit) p.verdict = Verdict::unhealthy;
}

// Of all pieces; they have taken the state.
double Stepper::asleep_until() const {
  double until = HUGE_VAL;
  for (const auto& piece : pieces_) until = std::min(until, piece->contacts().asleep_until());
  return until;
}

// Free flight, as many steps at once as elements and contacts allow; returns whether that was tried. Where
// the list of pairs is used up at once, it is renewed and no step is done.
bool Stepper::fly(State& state, std::int64_t most, Progress& p) {
  const double wakes = plan_.contacts() ? asleep_until() : HUGE_VAL;
  std::int64_t steps = p.motion < wakes ? flight_->look(state, pieces_, most) : 0;
  const double greatest = flight_->greatest(), approached = approach(greatest);
  const auto may_jump = [&] { return contacts_.may_jump(approached, p.motion + approached); };
  if (plan_.contacts() && may_jump()) contacts_.measure_hosts(*model_, state, p.motion);
  const bool fast = plan_.contacts() && (may_jump() || greatest > plan_.speed_limit * plan_.speed_limit);
  if (steps == 0 || fast) {  // single steps find what touches or is too fast
    flight_->put_off(pieces_);
    return false;
  }
  if (plan_.contacts()) {
    std::int64_t done = 0;
    for (; done < steps && p.motion < wakes && p.motion < contacts_.margin() && !may_jump(); ++done)
      p.motion += approached;
    if (!(p.motion < contacts_.margin())) p.verdict = Verdict::renew_contacts;
    steps = done;
  }
  each_by_its_thread([&](int t) { pieces_[at(t)]->fly(static_cast<Index>(steps)); });
  flown_ += steps;
  p.done += steps;
  return true;
}

// The steps of one thread, whose piece has taken the state; every thread returns the same. `from` is what the
// run begins with.
Stepper::Progress Stepper::run_thread(State& state, std::int64_t steps, int thread, Progress from) {
  const bool alone = threads_ == 1, flies = alone && flight_, contacts = plan_.contacts();
  Piece& piece = *pieces_[at(thread)];
  const std::int64_t first = state.step, levels = piece.levels();
  StageSeconds unread{};  // of the other threads
  StageSeconds& seconds = thread == 0 ? sampled_ : unread;
  while (from.done < steps && from.verdict == Verdict::go_on) {
    StageClock clock(from.windows++, seconds);
    if (flies && flight_->due(steps - from.done) && fly(state, steps - from.done, from)) {
      clock.tick(StageId::gather_and_move);
      continue;
    }
    const std::int64_t stretch = std::min(levels, steps - from.done);
    double greatest = 0;
    if (contacts) greatest = piece.step(first + from.done, from.motion, clock);
    else piece.sweep(static_cast<int>(stretch), clock);
    from.done += stretch;
    if (!alone) {
      exchange_.post(thread, piece, greatest);
      greatest = exchange_.meet(thread, piece, greatest);
      clock.tick(StageId::meeting);
    }
    if (contacts) judge(greatest, from);
    if (flies) flight_->pass(stretch);
  }
  piece.give(state);
  return from;
}

// Several threads look for free flight before they set out, and come back when the next look is due.
Stepper::Progress Stepper::run(State& state, std::int64_t steps) {
  Progress from{0, windows_, motion_, Verdict::go_on};
  if (threads_ == 1) {
    pieces_[0]->take(state);
    return run_thread(state, steps, 0, from);
  }
  if (!flight_) return run_threads(state, steps, from);
  if (flight_->due(steps)) {
    StageClock clock(from.windows++, sampled_);
    each_by_its_thread([&](int t) { pieces_[at(t)]->take(state); });
    const bool flew = fly(state, steps, from);
    for (const auto& piece : pieces_)
      if (flew) piece->give(state);
    clock.tick(StageId::gather_and_move);
    if (flew) return from;
  }
  const Progress reached = run_threads(state, std::min(flight_->pause(), steps), from);
  flight_->pass(reached.done);
  return reached;
}

// One parallel region over as many steps as possible. To take the state may need memory, the steps do not: a
// thread that left them would keep the others waiting.
Stepper::Progress Stepper::run_threads(State& state, std::int64_t steps, const Progress& from) {
  Progress reached = from;
  Caught caught;
#pragma omp parallel num_threads(threads_)
  {
    const int thread = omp_get_thread_num();
    const CoreBinding bound(bind_, thread, threads_);
    caught.run([&] { pieces_[at(thread)]->take(state); });
#pragma omp barrier
    // fewer threads than pieces would wait for ever; all see the same number and none enters the steps
    const bool enough = omp_get_num_threads() == threads_ && !caught.any();
    const Progress mine = enough ? run_thread(state, steps, thread, from) : from;
    if (thread == 0) reached = mine;
  }
  caught.rethrow();
  if (reached.done == 0)
    throw Error(ExitCode::internal, "error: OpenMP gave fewer threads than it did at the start");
  return reached;
}

void Stepper::advance(State& state, std::int64_t steps) {
  if (steps > 0 && pieces_.empty()) share_out(state);
  while (steps > 0 && healthy_) {
    if (plan_.contacts() && !contacts_valid_) renew_contacts(state);
    const double begin = clock_seconds();
    const Progress reached = run(state, steps);
    stepping_ += clock_seconds() - begin;
    state.step += reached.done;
    steps -= reached.done;
    windows_ = reached.windows;
    motion_ = reached.motion;
    if (reached.verdict == Verdict::unhealthy) healthy_ = false;
    if (reached.verdict == Verdict::look_closer) look_closer(state);
    if (!(motion_ < contacts_.margin())) contacts_valid_ = false;
  }
}

// Some node moves fast, or some host may have become short: whether one near a ring or ball does or has.
void Stepper::look_closer(const State& state) {
  contacts_.measure_hosts(*model_, state, motion_);
  if (plan_.allow_unstable) return;
  jump_ = find_jump(*model_, state, contacts_, plan_.dt);
  if (jump_) healthy_ = false;
}

StageSeconds Stepper::seconds() const {
  StageSeconds seconds = cinch::share_out(sampled_, stepping_);
  seconds[static_cast<std::size_t>(StageId::broadphase)] += search_;
  return seconds;
}

void Stepper::glance(State& state, Glance& out) {
  if (pieces_.empty()) share_out(state);
  if (plan_.contacts() && !contacts_valid_) renew_contacts(state);
  for (auto& gain : out.gain) gain.resize(at(model_->nodes));
  const std::size_t rows = at(model_->ledger_rows() * kernel::lanes);
  out.elastic.assign(rows, 0.0);
  out.due.assign(plan_.damped && plan_.ledger ? rows : 0, 0.0);
  each_by_its_thread([&](int p) { pieces_[at(p)]->glance(state, motion_, out); });
  out.loads.clear();
  for (const auto& piece : pieces_) {
    piece->tell_joints(state);
    piece->append_loads(out.loads);
  }
}

}  // namespace cinch
