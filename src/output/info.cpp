#include "output/info.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "output/folder_lock.hpp"

namespace cinch {
namespace {

using std::string;

template <class... Values>
void line(std::ostream& out, const char* label, const char* format, Values... values) {
  char text[2048];  // what stopped a run may take some lines
  if constexpr (sizeof...(values) == 0) {
    std::snprintf(text, sizeof text, "%s", format);
  } else {
    std::snprintf(text, sizeof text, format, values...);
  }
  char start[32];
  std::snprintf(start, sizeof start, "%-16s", label);
  out << start << text << '\n';
}

// What stopped a run, as a part of a line.
string reason(const Summary& summary) {
  const string prefix = "error: ";
  return summary.message.starts_with(prefix) ? summary.message.substr(prefix.size()) : summary.message;
}

void print_frames(const Result& result, std::ostream& out) {
  const auto& times = result.frame_times();
  if (times.empty()) {
    line(out, "frames", "none");
  } else {
    line(out, "frames", "%d, t = %.9g .. %.9g s, last step %lld", result.frames(), times.front(),
         times.back(), static_cast<long long>(result.frame_steps().back()));
  }
  if (!result.model().probes.empty()) {
    line(out, "probes", "%zu columns, %zu rows", result.model().probes.size(), result.probe_times().size());
    for (const auto& probe : result.model().probes) {
      line(out, "", "%s: %s%s%s, %s", probe.name.c_str(), probe.quantity.c_str(),
           probe.of.empty() ? "" : " of ", probe.of.c_str(), probe.unit.c_str());
    }
  }
}

void print_parts(const ResultModel& model, std::ostream& out) {
  line(out, "model", "%zu nodes, %zu elements, %zu rings, %zu balls", model.node_mass.size(),
       model.elements.size(), model.rings.size(), model.balls.size());
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    const auto& part = model.parts[i];
    const auto count = std::count(model.element_part.begin(), model.element_part.end(), static_cast<int>(i));
    line(out, i == 0 ? "parts" : "", "%s.%s: %td elements%s", part.kind.c_str(), part.name.c_str(), count,
         part.closing ? ", closing thread" : "");
  }
  for (const auto& ball : model.balls) line(out, "ball", "%s: radius %.9g m", ball.name.c_str(), ball.radius);
  if (model.closing_time) line(out, "closing time", "%.9g s", *model.closing_time);
}

void print_stages(const Summary& summary, std::ostream& out) {
  double total = 0;
  for (const auto& stage : summary.stages) total += stage.seconds;
  const char* label = "stages";
  for (const auto& stage : summary.stages) {
    line(out, label, "%-24s %10.3f s %5.1f %%", stage.name.c_str(), stage.seconds,
         total > 0 ? 100 * stage.seconds / total : 0.0);
    label = "";
  }
}

void print_events(const Summary& summary, std::ostream& out) {
  const char* label = "events";
  for (const auto& event : summary.events) {
    line(out, label, "t = %.9g s  %s %s", event.time, event.kind.c_str(), event.name.c_str());
    label = "";
  }
  label = "rings";
  for (const auto& ring : summary.ring_records) {
    if (ring.first_contact_time < 0) {
      line(out, label, "%s: never touched", ring.name.c_str());
    } else {
      line(out, label, "%s: first contact at %.9g s (%.4g N), peak %.4g N at %.9g s", ring.name.c_str(),
           ring.first_contact_time, ring.first_contact_force, ring.peak_force, ring.peak_time);
    }
    label = "";
  }
}

void print_verdict(const Summary& summary, std::ostream& out) {
  line(out, "status", "%s%s%s", summary.status.c_str(), summary.message.empty() ? "" : ": ",
       reason(summary).c_str());
  const auto steps = static_cast<long long>(summary.steps);
  if (summary.time_step == summary.closing_time_step)
    line(out, "steps", "%lld of %.9g s, %.9g s simulated", steps, summary.time_step,
         summary.simulated_seconds);
  else
    line(out, "steps", "%lld, of %.9g s before closing and %.9g s from then on, %.9g s simulated", steps,
         summary.time_step, summary.closing_time_step, summary.simulated_seconds);
  if (summary.joint_steps > 1)
    line(out, "sliding joints", "forces hold for %d steps each time", summary.joint_steps);
  line(out, "stable step", "%.4g s, limited by %s", summary.stable_step,
       summary.stable_step_limited_by.c_str());
  line(out, "wall time", "%.3f s, %.4g min per simulated second", summary.wall_seconds,
       summary.minutes_per_simulated_second());
  if (std::isfinite(summary.relative_residual))
    line(out, "energy", "initial %.6g J, residual %.3g J (%.2e of the largest input)", summary.energy_initial,
         summary.energy.residual, summary.relative_residual);
  else line(out, "energy", "initial %.6g J, no ledger kept", summary.energy_initial);
  line(out, "momentum", "linear drift %.3g kg m/s", summary.linear_momentum_drift);
  if (summary.angular_momentum_drift) {
    line(out, "", "angular drift %.3g kg m^2/s", *summary.angular_momentum_drift);
  }
  line(out, "penetration", "%.4g m at most", summary.max_penetration);
  line(out, "state hash", "0x%016llx", static_cast<unsigned long long>(summary.state_hash));
}

const char* why_unfinished(const Result& result) {
  const std::filesystem::path folder = result.path().parent_path();
  switch (writer_of(folder.empty() ? "." : folder)) {
    case Writer::there:
      return "not finished: still running";
    case Writer::gone:
      return "not finished: stopped before its end, as no run on this machine writes to it";
    case Writer::unknown:
      break;
  }
  return "not finished: still running, or stopped before its end (killed, or the disk was full)";
}

}  // namespace

void print_info(const Result& result, std::ostream& out) {
  const ResultModel& model = result.model();
  line(out, "case", "%s%s%s", model.case_name.c_str(), model.title.empty() ? "" : ": ", model.title.c_str());
  line(out, "written by", "cinch %s (%s), %s, %s, %d thread%s", model.version.c_str(), model.commit.c_str(),
       model.compiler.c_str(), model.isa.c_str(), model.threads, model.threads == 1 ? "" : "s");
  print_frames(result, out);
  print_parts(model, out);
  if (!result.summary()) {
    line(out, "status", why_unfinished(result));
    return;
  }
  print_stages(*result.summary(), out);
  print_events(*result.summary(), out);
  print_verdict(*result.summary(), out);
}

}  // namespace cinch
