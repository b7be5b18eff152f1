// What a checkpoint holds of a simulation: all that decides how it goes on and what it reports at the end.
// What the scene alone decides is made from it again.
#include <limits>

#include "plan/probes.hpp"
#include "plan/simulation.hpp"
#include "store/saved_state.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void transfer_places(Archive& archive, const std::string& name, std::vector<Vec3>& places) {
  archive.values(name, std::span(places.empty() ? nullptr : places.front().data(), 3 * places.size()));
}

void transfer_events(Archive& archive, std::vector<Event>& events) {
  std::vector<double> times;
  std::vector<std::string> kinds, names;
  for (const Event& event : events) {
    times.push_back(event.time);
    kinds.push_back(event.kind);
    names.push_back(event.name);
  }
  archive.list("events/time", times);
  archive.texts("events/kind", kinds);
  archive.texts("events/name", names);
  if (kinds.size() != times.size() || names.size() != times.size())
    archive.refuse("events", "has columns of different lengths");
  events.clear();
  for (std::size_t i = 0; i < times.size(); ++i) events.push_back({times[i], kinds[i], names[i]});
}

}  // namespace

void Simulation::restore(Archive& saved) {
  preparation_.assembly.forget_start();
  ring_start_.resize(preparation_.assembly.rings.size());
  if (needs_node_start(scene_)) node_start_.resize(at(preparation_.assembly.node_count()));
  transfer(saved);
  if (has_mouth_) find_surfaces();
  require_mouth();
  remember();
}

void Simulation::transfer(Archive& archive) {
  const auto same_step = [&](const char* name, const double given) {
    double dt = given;
    archive.value(name, dt);
    if (dt != given) archive.refuse(name, "is not the one that the case gives");
  };
  same_step("time_step", preparation_.timeline.before());
  same_step("closing_time_step", preparation_.timeline.after());
  const auto last = static_cast<std::int64_t>(preparation_.phases.size()) - 1;
  archive.whole("phase", phase_, 0, last);
  if (archive.restoring()) {
    enter_phase(phase_);
    state_ = State(model());
  }
  cinch::transfer(archive, state_, model());
  if (last > 0 && closed_phase() != (state_.step >= preparation_.closing_step))
    archive.refuse("phase", "is not the one at that time");
  stepper_->transfer(archive, state_);
  ledger_.transfer(archive);
  transfer_watch(archive);
  transfer_seconds(archive);
}

// What is watched at each sample of the probes.
void Simulation::transfer_watch(Archive& archive) {
  transfer_places(archive, "watch/ring_start", ring_start_);
  transfer_places(archive, "watch/node_start", node_start_);
  archive.value("watch/greatest_mouth", greatest_mouth_);
  archive.flag("watch/has_mouth", has_mouth_);
  archive.flag("watch/mouth_closed", mouth_closed_);
  std::vector<std::int64_t> enclosed(enclosed_.begin(), enclosed_.end());
  archive.values("watch/enclosed", std::span(enclosed));
  enclosed_.assign(enclosed.begin(), enclosed.end());
  transfer_events(archive, events_);
  threadings_.transfer(archive, preparation_.assembly, model().elements);
  overlaps_.transfer(archive, model());
}

// Of all stages since the beginning, whoever stepped.
void Simulation::transfer_seconds(Archive& archive) {
  StageSeconds all = seconds_;
  if (!archive.restoring())
    for (std::size_t s = 0; s < stage_count; ++s) all[s] += stepper_->seconds()[s];
  archive.values("seconds/stage", std::span(all));
  if (archive.restoring()) seconds_ = all;
}

}  // namespace cinch
