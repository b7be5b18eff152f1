#include "plan/preparation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.hpp"

namespace cinch {
namespace {

// Threads with little damping that turn slack and taut change their energy well below the linear bound: what
// their neighbours do to the rate is beyond axial_law.hpp. A thread that springs back from twice its length
// loses 9 % in a second at half the bound with 0.01 of the critical damping, about 1 % at these; without any
// it loses more at each.
double greatest_safety(double damping_ratio) {
  return damping_ratio < 0.005 ? 0.1 : damping_ratio < 0.02 ? 0.2 : damping_ratio < 0.05 ? 0.3 : 1.0;
}

std::string place_of(const SourceRef& source) { return source.text.empty() ? "" : source.text + ": "; }

// A step that fits whole numbers of times into the frame interval, below safety x bound and no longer than
// probes are apart. From a closing time on that is no frame's, frames and the end come up to half a step
// beside their time.
double automatic_step(const Scene& scene, double safety, double bound) {
  const double interval = scene.output.frame_interval, probes = scene.output.probe_interval;
  for (const auto& [name, material] : scene.materials)
    safety = std::min(safety, greatest_safety(material.damping_ratio));
  const double wanted = std::isfinite(bound) ? safety * bound : interval;
  double steps = std::ceil(interval / wanted);
  constexpr double rounding = 1e-9;  // 0.02 s are 200 times 1e-4 s
  if (probes > 0) steps = std::max(steps, std::ceil(interval / probes * (1 - rounding)));
  return interval / steps;
}

// What the case says of the steps of a phase.
struct StepKeys {
  const char* key;   // that gives the step
  double step;       // s; 0: automatic
  double safety;     // of an automatic one
  SourceRef source;  // of the step
};

// From the closing time on steps are those of [closing] as far as it says so: its safety asks for automatic
// ones.
StepKeys keys_of(const Scene& scene, bool closed) {
  StepKeys keys{"time.step_s", scene.time.step, scene.time.safety, scene.time.source};
  const Closing& closing = scene.closing;
  if (!closed || !(closing.step || closing.safety)) return keys;
  return {"closing.step_s", closing.step.value_or(0), closing.safety.value_or(keys.safety),
          closing.step_source};
}

// Sums of constants from 1e-60 to 1e60 can still give a step that leads nowhere.
void check_number_of_steps(const Scene& scene, const StepKeys& keys, const Phase& phase, double dt) {
  constexpr double most = 1e12;
  if (dt > 0 && scene.time.end / dt <= most) return;
  char text[400];
  std::snprintf(
      text, sizeof text,
      "error: the stable step is %.3g s, limited by %s; that makes %.3g steps to %.6g s, allowed: at most "
      "%.0e",
      phase.bound.step, phase.limited_by.c_str(), scene.time.end / dt, scene.time.end, most);
  throw CaseError(place_of(keys.source) + text);
}

void check_step(const Scene& scene, const StepKeys& keys, const Phase& phase, double dt) {
  if (scene.time.allow_unstable || dt <= phase.bound.step) return;
  // four digits, rounded down: the step in the message must work
  const double digits = std::pow(10.0, std::floor(std::log10(phase.bound.step)) - 3);
  char text[400];
  std::snprintf(text, sizeof text,
                "error: %s = %.6g s is above the stable step, limited by %s; the largest step that works is "
                "%.4g s (or %s = \"auto\", or time.allow_unstable = true)",
                keys.key, dt, phase.limited_by.c_str(), std::floor(phase.bound.step / digits) * digits,
                keys.key);
  throw CaseError(place_of(keys.source) + text);
}

// Throws CaseError for one that the phase does not allow.
double step_of(const Scene& scene, bool closed, Phase& phase) {
  const StepKeys keys = keys_of(scene, closed);
  phase.step_given = keys.step > 0;
  phase.step_key = keys.key;
  phase.step_source = keys.source;
  const double dt = keys.step > 0 ? keys.step : automatic_step(scene, keys.safety, phase.bound.step);
  check_step(scene, keys, phase, dt);
  check_number_of_steps(scene, keys, phase, dt);
  return dt;
}

// At half of what is stable errors stay those of 1 (bench/study); more than 8 steps would save next to
// nothing. Steps below 0.8 of the stable one are taken for the energy's books: they hold forces for less time
// still, with the square of the step.
constexpr double automatic_joint_share = 0.5, full_hold_safety = 0.8;
constexpr int most_automatic_joint_steps = 8;

int automatic_joint_steps(const Model& model, double dt, double stable) {
  const double part = std::min(dt / (full_hold_safety * stable), 1.0);
  return joint_steps(model, stable, automatic_joint_share * part * part, most_automatic_joint_steps);
}

int joint_steps_of(const Scene& scene, const Model& model, double dt, double stable) {
  const int given = scene.time.joint_steps;
  if (model.joints.empty()) return 1;
  if (given == 0) return automatic_joint_steps(model, dt, stable);
  const int most = joint_steps(model, dt, 1, given);
  if (given <= most || scene.time.allow_unstable) return given;
  char text[300];
  std::snprintf(text, sizeof text,
                "error: time.joint_steps = %d is more than sliding threads allow with a step of %.6g s; the "
                "largest that works is %d (or time.joint_steps = \"auto\", or time.allow_unstable = true)",
                given, dt, most);
  throw CaseError(place_of(scene.time.joint_steps_source) + text);
}

}  // namespace

std::string element_label(const Preparation& preparation, Index user_element) {
  const auto e = static_cast<std::size_t>(user_element);
  const Part& part = preparation.assembly.part_of(user_element);
  return "element " + std::to_string(user_element - part.first_element) + " of " + part.reference() +
         " (nodes " + std::to_string(preparation.whole().end_a[e]) + " and " +
         std::to_string(preparation.whole().end_b[e]) + ")";
}

std::string node_label(const Assembly& assembly, Index node) {
  for (const Part& part : assembly.parts) {
    const auto found = std::find(part.nodes.begin(), part.nodes.end(), node);
    if (found != part.nodes.end())
      return "node " + std::to_string(found - part.nodes.begin()) + " of " + part.reference();
  }
  return "node " + std::to_string(node);
}

namespace {

void add_phases(const Scene& scene, Preparation& p) {
  const bool deploys = p.assembly.has_closing() && scene.closing.time.value_or(0) > 0;
  const auto add = [&](const char* name, Stage stage) {
    Phase phase;
    phase.name = name;
    phase.model = build_model(p.assembly, scene, stage);
    phase.bound = stable_step(phase.model);
    p.phases.push_back(std::move(phase));
  };
  if (deploys) add("deployment", Stage::before_closing);
  add(deploys ? "closing" : "whole scene", Stage::closing);
  for (Phase& phase : p.phases) {                    // labels know the whole scene
    if (!std::isfinite(phase.bound.step)) continue;  // nothing limits it
    phase.limited_by = element_label(p, phase.bound.element);
    if (deploys) phase.limited_by += " while " + phase.name;
  }
}

void note_least_stable_step(Preparation& p) {
  const auto least = std::min_element(p.phases.begin(), p.phases.end(), [](const Phase& l, const Phase& r) {
    return l.bound.step < r.bound.step;
  });
  p.stable_step = least->bound.step;
  p.limited_by = least->limited_by;
}

}  // namespace

Preparation prepare(const Scene& scene) {
  Preparation p;
  p.assembly = assemble(scene);
  if (!scene.equilibrium) p.strained = great_begin_strains(scene, p.assembly);  // else it hangs otherwise
  add_phases(scene, p);
  note_least_stable_step(p);
  const bool deploys = p.phases.size() > 1;
  std::vector<double> dt;
  for (Phase& phase : p.phases) {
    const bool closed = p.assembly.has_closing() && &phase == &p.phases.back();
    dt.push_back(step_of(scene, closed, phase));
  }
  // what closes after t = 0 was deployed first: for a step at least
  if (p.assembly.has_closing())
    p.closing_step = std::max<std::int64_t>(Timeline(dt[0]).step_at(scene.closing.time.value_or(0)), deploys);
  p.timeline = deploys ? Timeline(dt[0], dt[1], p.closing_step) : Timeline(dt[0]);
  p.end_step = p.timeline.step_at(scene.time.end);
  for (std::size_t i = 0; i < p.phases.size(); ++i) {
    Phase& phase = p.phases[i];
    phase.plan = plan_steps(scene, phase.model, dt[i], p.timeline);
    phase.plan.joint_steps = joint_steps_of(scene, phase.model, dt[i], phase.bound.step);
  }
  if (deploys) p.phases.back().plan.first_step = p.closing_step;
  return p;
}

Preparation step_by_step(Preparation preparation) {
  for (Phase& phase : preparation.phases) phase.plan.fly = false;
  return preparation;
}

}  // namespace cinch
