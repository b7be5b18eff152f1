// What a simulation reports of itself apart from its frames: its model, events and summary.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/version.hpp"
#include "plan/health.hpp"
#include "plan/simulation.hpp"
#include "store/fields.hpp"

namespace cinch {
ResultModel Simulation::result_model() const {
  const Assembly& assembly = preparation_.assembly;
  ResultModel m;
  m.case_name = scene_.name;
  m.title = scene_.title;
  m.about = scene_.about;
  m.case_toml = scene_.resolved_toml;
  m.version = cinch::version;
  m.commit = cinch::commit;
  m.compiler = cinch::compiler;
  m.isa = kernels().isa;
  m.threads = threads_;
  m.time_step = preparation_.timeline.before();
  m.closing_time_step = preparation_.timeline.after();
  const Model& whole = preparation_.whole();
  m.elements.reserve(whole.end_a.size());
  for (std::size_t e = 0; e < whole.end_a.size(); ++e) m.elements.push_back({whole.end_a[e], whole.end_b[e]});
  m.rest_length.assign(whole.rest_length.begin(), whole.rest_length.end());
  m.element_radius.assign(whole.radius.begin(), whole.radius.end());
  m.element_part.resize(whole.end_a.size());
  for (std::size_t p = 0; p < assembly.parts.size(); ++p)
    std::fill_n(m.element_part.begin() + assembly.parts[p].first_element, assembly.parts[p].elements,
                static_cast<int>(p));
  m.node_mass.assign(whole.mass.begin(), whole.mass.end());
  for (const Part& part : assembly.parts) m.parts.push_back({kind_name(part.kind), part.name, part.closing});
  for (const AssemblyRing& ring : assembly.rings)
    m.rings.push_back({ring.name, ring.radius, ring.wire_radius});
  for (std::size_t t = 0; t < whole.sliding_threads.size(); ++t) {
    const kernel::SlidingThread& thread = whole.sliding_threads[t];
    const int part = m.element_part[static_cast<std::size_t>(whole.sliding_first[t])];
    for (Index j = thread.joint_begin; j < thread.joint_end; ++j)
      m.joints.push_back({part, whole.joints[static_cast<std::size_t>(j)].ring});
  }
  for (const AssemblyBall& ball : assembly.balls) m.balls.push_back({ball.name, ball.center, ball.radius});
  for (const NamedNode& named : assembly.named) m.masses.push_back({named.name, named.node, named.mass});
  if (preparation_.closing_step >= 0)
    m.closing_time = preparation_.timeline.time_of(preparation_.closing_step);
  m.probes = probe_columns_;
  return m;
}

std::vector<Event> Simulation::all_events() const {
  std::vector<Event> events = events_;
  for (std::size_t r = 0; r < state_.rings.size(); ++r)
    if (state_.rings[r].state > 0)
      events.push_back({state_.rings[r].first_time, "ring_contact", preparation_.assembly.rings[r].name});
  for (std::size_t b = 0; b < state_.balls.size(); ++b) {
    double first = -1;
    for (const kernel::BallTally& tally : state_.balls[b])
      if (tally.first_time >= 0 && (first < 0 || tally.first_time < first)) first = tally.first_time;
    if (first >= 0) events.push_back({first, "target_contact", preparation_.assembly.balls[b].name});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& l, const Event& r) { return l.time < r.time; });
  return events;
}

static std::string words_of_end(const Event& end) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "ring %s, an end of its thread, was drawn to it at t = %.6g s; a sliding joint keeps it, as a "
      "knot too large for the opening would be, where a free end would leave the ring",
      end.name.c_str(), end.time);
  return text;
}

Summary Simulation::summary() {
  const Assembly& assembly = preparation_.assembly;
  Summary s;
  s.case_name = scene_.name;
  s.version = cinch::version;
  s.commit = cinch::commit;
  s.compiler = cinch::compiler;
  s.isa = kernels().isa;
  s.threads = threads();
  s.steps = state_.step;
  s.time_step = preparation_.timeline.before();
  s.closing_time_step = preparation_.timeline.after();
  s.joint_steps = preparation_.phases.back().plan.joint_steps;
  s.simulated_seconds = time();
  s.nodes = preparation_.whole().nodes;
  s.elements = preparation_.whole().elements;
  s.rings = static_cast<Index>(assembly.rings.size());
  s.stable_step = preparation_.stable_step;
  s.stable_step_limited_by = preparation_.limited_by;
  s.state_hash = state_hash(state_);
  s.energy = ledger_.energies(look().energy());
  s.energy_initial = ledger_.initial();
  if (!scene_.output.ledger) s.energy.residual = std::numeric_limits<double>::quiet_NaN();  // books not kept
  s.relative_residual =
      std::abs(s.energy.residual) / std::max(ledger_.scale(), least_energy / residual_limit);
  if (s.relative_residual > residual_limit)
    s.warnings.push_back(
        "energy is not conserved (residual above 1 %); a smaller time.step_s or more damping may help");
  for (const Event& event : events_)
    if (event.kind == "thread_end") s.warnings.push_back(words_of_end(event));
  const Momentum drift = ledger_.drift(model(), state_, time());
  s.linear_momentum_drift = drift.linear.norm();
  if (!model().has_gravity) s.angular_momentum_drift = drift.angular.norm();
  for (const kernel::RingTally& ring : state_.rings)
    s.max_penetration = std::max(s.max_penetration, ring.max_penetration);
  for (const auto& ball : state_.balls)
    for (const kernel::BallTally& tally : ball)
      s.max_penetration = std::max(s.max_penetration, tally.max_penetration);
  for (std::size_t stage = 0; stage < stage_count; ++stage)
    s.stages.push_back(
        {stage_name(static_cast<StageId>(stage)), seconds_[stage] + stepper_->seconds()[stage]});
  s.events = all_events();
  for (const Paced& paced : history_)
    s.history.push_back({paced.time, node_label(assembly, paced.fastest.node), paced.fastest.speed});
  for (std::size_t r = 0; r < assembly.rings.size(); ++r) {
    RingRecord record;
    record.name = assembly.rings[r].name;
    if (r < state_.rings.size()) {
      const kernel::RingTally& tally = state_.rings[r];
      record.first_contact_time = tally.first_time;
      record.first_contact_force = tally.first_peak;
      record.peak_force = tally.peak_force;
      record.peak_time = tally.peak_time;
    }
    s.ring_records.push_back(record);
  }
  return s;
}

}  // namespace cinch
