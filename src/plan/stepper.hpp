// Moves a state through time: the one place that knows about threads.
// clang-format off
//
// One step, in order (each thread takes its share of the blocks and rings):
//   forces   axial forces of element blocks, contacts of rings, contacts of balls
//   meet
//   update   gather to node blocks, supports, kick, drift
//   meet
//   watch    every thread reads the blocks' greatest speeds and decides alike: go on, or leave the parallel region
//            because the broadphase margin may be used up or a speed is out of bounds
// Shares are stretches of blocks whose edges the model alone decides, so the bits do not depend on the threads.
// clang-format on
#pragma once
#include <array>
#include <cstdint>

#include "kernels/kernel_table.hpp"
#include "plan/contact_list.hpp"
#include "plan/step_plan.hpp"

namespace cinch {

class Stepper {
 public:
  /// `model` must outlive the stepper; `node_share` as stable_step.hpp makes it.
  Stepper(const Model& model, const StepPlan& plan, AlignedVector<double> node_share, int threads);

  /// Advances by `steps` steps. Stops early only when a speed is not finite or above the limit: see
  /// healthy().
  void advance(State& state, std::int64_t steps);

  /// Computes all forces of the state as it stands and books nothing; leaves them in the arrays below.
  void evaluate(State& state);

  /// False once a node's speed was not finite or above the limit.
  bool healthy() const { return healthy_; }
  /// Seconds of each stage so far, scaled up from sampled steps.
  const std::array<double, stage_count>& seconds() const { return seconds_; }
  void add_seconds(StageId stage, double s) { seconds_[static_cast<std::size_t>(stage)] += s; }

  const Model& model() const { return *model_; }
  const StepPlan& plan() const { return plan_; }
  const ContactList& contacts() const { return contacts_; }
  const double* force_x() const { return fx_.data(); }  ///< element: force on its end a, N
  const double* force_y() const { return fy_.data(); }
  const double* force_z() const { return fz_.data(); }

 private:
  enum class Verdict { go_on, renew_contacts, unhealthy };

  void bind(State& state);
  void forces(State& state, double time, double booked_dt, int thread);
  void ball_forces(State& state, double time, double booked_dt, int thread);
  void update(int thread);
  void meet() const;
  Verdict watch(double& margin_used) const;
  std::int64_t run(State& state, std::int64_t steps, Verdict& verdict);
  std::int64_t run_thread(State& state, std::int64_t steps, int thread, Verdict& verdict);
  void renew_contacts(State& state);

  const Model* model_;
  StepPlan plan_;
  int threads_;
  AlignedVector<double> node_share_;
  ContactList contacts_;
  AlignedVector<double> fx_, fy_, fz_;
  std::vector<kernel::Watch> watch_;
  kernel::AxialArguments axial_{};
  kernel::RingArguments ring_{};
  kernel::NodeArguments node_{};
  double margin_used_ = 0;
  bool contacts_valid_ = false, healthy_ = true;
  std::array<double, stage_count> seconds_{};
};

}  // namespace cinch
