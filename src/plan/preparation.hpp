// From a scene to what can be stepped: assembly, models of both phases, the stable step, the step taken.
// `cinch check` prints it, a simulation starts from it.
#pragma once
#include <optional>
#include <string>

#include "plan/stable_step.hpp"
#include "plan/step_plan.hpp"
#include "scene/assembly.hpp"
#include "scene/begin_strain.hpp"

namespace cinch {

/// One stretch of time in which the model does not change.
struct Phase {
  std::string name;  ///< "deployment" or "closing" where the scene has both, else "whole scene"
  Model model;
  StableStep bound;
  std::string limited_by;   ///< the element that limits the step, in words
  bool step_given = false;  ///< by the case; else automatic
  std::string step_key;     ///< that gives it or may do so: "time.step_s" or "closing.step_s"
  SourceRef step_source;    ///< of that key
  StepPlan plan;
};

struct Preparation {
  Assembly assembly;
  std::vector<Phase> phases;       ///< one or two, in order of time
  std::int64_t closing_step = -1;  ///< first step of the closing phase; -1: nothing closes
  std::int64_t end_step = 0;
  Timeline timeline;
  double stable_step = 0;             ///< s, the least of all phases
  std::string limited_by;             ///< the element that limits it, in words
  std::vector<BeginStrain> strained;  ///< parts that begin far too short for where they lie

  /// All nodes and elements that the scene ever has.
  const Model& whole() const { return phases.back().model; }
};

/// Throws CaseError for an impossible scene and for a given step above the stable bound (names the limiting
/// element and the largest step that works), unless the scene allows it.
Preparation prepare(const Scene& scene);
/// The same without free flight: of use where a step's time counts, or its bits.
Preparation step_by_step(Preparation preparation);

/// "element 17 of thread.main (nodes 17 and 18)", by the user's number.
std::string element_label(const Preparation& preparation, Index user_element);
/// "node 17 of thread.main" (the first part that has it).
std::string node_label(const Assembly& assembly, Index node);

}  // namespace cinch
