// The public face of the solver: make one from a scene, advance it, look at it.
#pragma once
#include <memory>

#include "base/result.hpp"
#include "plan/closing.hpp"
#include "plan/health.hpp"
#include "plan/ledger.hpp"
#include "plan/memory.hpp"
#include "plan/overlap.hpp"
#include "plan/preparation.hpp"
#include "plan/thread_choice.hpp"
#include "plan/threading_watch.hpp"
#include "scene/mouth.hpp"

namespace cinch {

/// Where nodes begin beside the places that a scene gives them: along each axis within `most` (m), by chance.
struct Nudge {
  double most = 0;
  unsigned seed = 0;
};

class Simulation {
 public:
  /// Builds everything and stands at t = 0. `threads` 0: as many as pay for this scene, by its size at first
  /// (choose_threads) and then as is measured (ThreadChoice).
  /// Throws CaseError for an impossible scene, NumericalError when no static equilibrium is found.
  explicit Simulation(const Scene& scene, int threads = 0);
  /// From what prepare(scene) has given.
  Simulation(const Scene& scene, Preparation preparation, int threads, const Nudge& nudge = {});
  /// Goes on where the simulation of the same scene stood when save() was called, to the last bit, with any
  /// number of threads. Throws FileError for what does not belong to the scene.
  Simulation(const Scene& scene, Preparation preparation, int threads, Archive& saved);
  void save(Archive& archive) { transfer(archive); }

  /// Advances to `step`; closing happens on the way. Throws NumericalError (node, ring or element, time,
  /// likely cause) and leaves the state of the step that went wrong.
  void advance_to(std::int64_t step) { advance_towards(step, step); }
  /// The same, but stops at `pause` where that comes first. What a run that fails leaves does not hang on
  /// where it pauses: nothing is looked at there. Before such a state is kept: check_health().
  void advance_towards(std::int64_t step, std::int64_t pause);
  /// Throws NumericalError, as advance_to() does, where something has gone wrong.
  void check_health();
  /// From the next step on by so many threads, to the same bits.
  void use_threads(int threads);
  /// After a NumericalError: back to the last state that was found sound, within some thousand steps before.
  void step_back();

  /// How the scene stands now; good until it is advanced or looked at again.
  const Look& look();
  /// Everything a frame holds, closing threads laid on their carriers before the closing time.
  Frame frame(const Look& now);
  Frame frame() { return frame(look()); }
  /// Throws NumericalError when the energy residual is beyond the case's limit; without ledger never.
  void check_energy(const Look& now);
  /// One value for each column of `probe_columns`.
  std::vector<double> probe_row(const Look& now);
  /// Looks at the mouth, at targets and at threads in rings, and notes events; call as often as events should
  /// be resolved. Throws NumericalError for a thread that has left its ring, unless the case allows it.
  void note_events(const Look& now);

  const std::vector<ResultModel::ProbeColumn>& probe_columns() const { return probe_columns_; }
  ResultModel result_model() const;
  /// All but wall time and status.
  Summary summary();
  MemoryUse memory() const;
  /// Of contacts that overlap so much where they begin that they decide how the motion begins; else empty.
  std::string overlap_warning() const { return overlaps_.warning(preparation_); }

  std::int64_t step() const { return state_.step; }
  /// The last one: the case's, or an earlier one as soon as what time.end_when names has come to pass.
  std::int64_t end_step() const;
  double time() const { return preparation_.timeline.time_of(state_.step); }
  /// Its assembly knows all parts by name, but no longer how nodes and elements began.
  const Preparation& preparation() const { return preparation_; }
  const State& state() const { return state_; }
  State& state() { return state_; }
  const Phase& phase() const { return preparation_.phases[phase_]; }
  const Model& model() const { return phase().model; }
  const Stepper& stepper() const { return *stepper_; }
  Stepper& stepper() { return *stepper_; }
  int threads() const { return stepper_->threads(); }  ///< that step it now
  bool closed_phase() const { return phase_ + 1 == preparation_.phases.size(); }

 private:
  void make_ready(int threads);
  void restore(Archive& saved);
  void transfer(Archive& archive);
  void transfer_watch(Archive& archive);
  void transfer_seconds(Archive& archive);
  void find_start();
  void start(const Nudge& nudge);
  void find_mouth();
  void require_mouth() const;
  void find_surfaces();
  void enter_phase(std::size_t phase);
  void advance_with_threads_that_pay(std::int64_t stop);
  void close();
  void lay_threads();
  void take_half_step_back();
  void set_back(double steps);
  std::int64_t steps_into_interval() const;
  void find_faults();
  void note_pace();
  void note_losses(const Look& now);
  void note_drawn_ends(const Look& now);
  void note_mouth(const Look& now, double area);
  void note_targets(const Look& now);
  void remember();
  [[noreturn]] void find_fault();
  std::vector<Event> all_events() const;

  Scene scene_;
  Preparation preparation_;
  int threads_;           ///< to begin with
  int most_threads_ = 1;  ///< to try
  std::size_t phase_ = 0;
  State state_;
  State sound_;  ///< the last state that was looked at and kept; faults are searched for from there
  struct Paced {
    double time;  // s
    Fastest fastest;
  };
  std::vector<Paced> history_;  ///< of the last looks at speeds
  std::unique_ptr<Stepper> stepper_;
  ThreadChoice choice_{1, 1};
  Look look_;
  Ledger ledger_;
  std::vector<ResultModel::ProbeColumn> probe_columns_;
  std::vector<Vec3> ring_start_;  ///< where rings were at t = 0
  std::vector<Vec3> node_start_;  ///< where nodes were at t = 0, if a probe asks for a node's displacement
  std::vector<NetSurface> surfaces_;
  std::array<double, stage_count> seconds_{};  ///< of phases that are over
  double greatest_mouth_ = 0;
  bool has_mouth_ = false, mouth_closed_ = false;
  std::vector<bool> enclosed_;
  ThreadingWatch threadings_;
  std::vector<Event> events_;  ///< those noted here; contacts are kept in the tallies
  OverlapWatch overlaps_;      ///< of the contacts that began last without having moved
};

/// Threads that pay for a scene of this size wherever they run: one for each 8000 elements or so, as below
/// that meetings may cost more than they save (bench/bench_growth.cpp measures both sides on a given
/// machine).
int choose_threads(Index elements, int available);

}  // namespace cinch
