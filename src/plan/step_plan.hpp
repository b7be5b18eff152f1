// The stages of a step: which of them this scene needs, and why the others are left out.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "plan/timeline.hpp"
#include "store/model.hpp"

namespace cinch {

/// In running order.
enum class StageId { contacts, axial_forces, gather_and_move, meeting, broadphase, observe, output, count };

constexpr std::size_t stage_count = static_cast<std::size_t>(StageId::count);

struct StageInfo {
  std::string name;
  bool runs = true;
  std::string note;  ///< what it does here, or why it is left out
};

struct StepPlan {
  double dt = 0;                ///< s
  Timeline timeline;            ///< of the whole run
  std::int64_t first_step = 0;  ///< of the phase
  int joint_steps = 1;          ///< for which forces of sliding joints hold
  bool damped = false, ledger = false, gravity = false, rings = false, balls = false, joints = false;
  bool couple = true, golden = false;
  double alpha_ring = 0, alpha_target = 0;  ///< s/m
  double margin = 0;                        ///< m, 0: automatic
  double speed_limit = 0;                   ///< m/s
  bool allow_unstable = false;
  bool fly = true;  ///< steps of free flight at once, see free_flight.hpp: no bit depends on it
  Vec3 gravity_acceleration = Vec3::Zero();  ///< m/s^2

  /// Only scenes in which something acts on nodes beside their elements go step by step and watch the
  /// greatest speed: it tells how long a list of pairs is good.
  bool contacts() const { return touches() || joints; }
  /// Whether there are pairs that may touch.
  bool touches() const { return rings || balls; }
  /// Steps at `step` since the forces of sliding joints were last due; 0: they are.
  int joints_hold(std::int64_t step) const { return static_cast<int>((step - first_step) % joint_steps); }
  /// Why nodes never fly freely (free_flight.hpp), whatever elements do; empty where they may.
  std::string flight_obstacle(const Model& model) const;
  std::vector<StageInfo> stages(const Model& model) const;
};

StepPlan plan_steps(const Scene& scene, const Model& model, double dt, const Timeline& timeline);

const char* stage_name(StageId stage);

}  // namespace cinch
