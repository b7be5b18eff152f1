#include "plan/step_plan.hpp"

namespace cinch {

const char* stage_name(StageId stage) {
  static constexpr const char* names[] = {"contacts",   "axial forces", "gather and move", "threads meeting",
                                          "broadphase", "observe",      "output"};
  return names[static_cast<std::size_t>(stage)];
}

StepPlan plan_steps(const Scene& scene, const Model& model, double dt, const Timeline& timeline) {
  StepPlan plan;
  plan.dt = dt;
  plan.timeline = timeline;
  plan.damped = model.damped;
  plan.ledger = scene.output.ledger;
  plan.gravity = model.has_gravity;
  plan.rings = model.ring_contacts;
  plan.joints = !model.joints.empty();
  plan.balls = !model.balls.empty();
  plan.couple = scene.contact.couple == RingCouple::conserving;
  plan.golden = scene.contact.distance == DistanceMethod::golden;
  plan.alpha_ring = scene.contact.alpha_ring;
  plan.alpha_target = scene.contact.alpha_target;
  plan.margin = scene.contact.margin;
  plan.speed_limit = scene.time.speed_limit;
  plan.allow_unstable = scene.time.allow_unstable;
  plan.gravity_acceleration = model.gravity;
  return plan;
}

static std::size_t touching_rings(const Model& model) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < model.rings.size(); ++r) count += !model.slides(r);
  return count;
}

std::string StepPlan::flight_obstacle(const Model& model) const {
  if (joints) return "rings slide on threads";
  if (!model.constraints.empty()) return "nodes are held";
  if (gravity && contacts()) return "the greatest speed changes with gravity";
  return "";
}

std::vector<StageInfo> StepPlan::stages(const Model& model) const {
  const auto count = [](std::size_t n, const char* what) { return std::to_string(n) + " " + what; };
  std::vector<StageInfo> list;
  list.push_back({"axial forces", true,
                  count(static_cast<std::size_t>(model.elements), "elements in ") +
                      count(model.topology.runs.size(), "runs and ") +
                      count(model.topology.links.size(), "links, springs") + (damped ? " and dampers" : "")});
  list.push_back({"dampers", damped, damped ? "inside axial forces" : "no material has damping"});
  list.push_back(
      {"ring contact", rings,
       rings    ? count(touching_rings(model), golden ? "rings, golden section" : "rings, exact distance")
       : joints ? "every ring slides"
                : "no rings in this phase"});
  list.push_back({"sliding joints", joints,
                  joints ? count(model.joints.size(), "rings on ") +
                               count(model.sliding_threads.size(),
                                     model.sliding_threads.size() == 1 ? "thread" : "threads") +
                               (joint_steps > 1 ? ", every " + std::to_string(joint_steps) + " steps" : "")
                         : "no ring slides in this phase"});
  list.push_back({"couple of eq. (12)", rings && couple,
                  !rings   ? "no ring contact"
                  : couple ? "conserving"
                           : "paper: dropped and booked"});
  list.push_back({"target contact", balls, balls ? count(model.balls.size(), "balls") : "no target"});
  list.push_back(
      {"broadphase", touches(), touches() ? "only when the margin may be used up" : "no contacts"});
  list.push_back({"watch on speeds", contacts(),
                  contacts() ? "every step, inside gather and move" : "no contacts: now and then"});
  list.push_back({"gravity", gravity, gravity ? "inside gather and move" : "no gravity"});
  list.push_back({"supports", !model.constraints.empty(),
                  model.constraints.empty() ? "no fixed or guided node"
                                            : count(model.constraints.size(), "fixed or guided nodes")});
  list.push_back({"gather and move", true, count(static_cast<std::size_t>(model.nodes), "nodes")});
  const std::string obstacle = flight_obstacle(model);
  list.push_back({"free flight", obstacle.empty(),
                  obstacle.empty() ? "steps in which nothing pulls or touches are done at once" : obstacle});
  list.push_back(
      {"energy ledger", ledger, ledger ? "dissipation summed every step" : "output.ledger = false"});
  return list;
}

}  // namespace cinch
