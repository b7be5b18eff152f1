// The two sides of an absent feature: the solver on a scene that lacks it, and the program stripped of it.
#pragma once
#include <string>
#include <vector>

#include "plan/piece.hpp"
#include "plan/simulation.hpp"
#include "scenes.hpp"
#include "stripped.hpp"

namespace cinch::bench {

/// A feature and what the scene without it has. Damping, gravity and ledger are left out one by one; rings
/// and targets bring contacts, of which the stripped programs know nothing, and probes are no part of a step:
/// these scenes have all the rest.
struct AbsentFeature {
  std::string name;
  Features has;
};
const std::vector<AbsentFeature>& absent_features();

/// A flying net of about the size of the paper's capture; whole steps of the solver and of the stripped
/// program.
constexpr std::int64_t absent_knots = 30;

class StrippedNet {
 public:
  explicit StrippedNet(const Features& has);
  void advance(std::int64_t steps) { advance_(scene_, steps); }
  Index elements() const { return model_.elements; }
  const State& state() const { return state_; }

 private:
  Simulation start_;  ///< owns the model
  const Model& model_;
  State state_;
  ForceReduction work_;
  std::vector<StrippedBlock> blocks_;
  Palette palette_;
  AlignedVector<double> scale_, force_[3], damper_;
  StrippedScene scene_{};
  void (*advance_)(const StrippedScene&, std::int64_t) = nullptr;
};

}  // namespace cinch::bench
