#include "report/facts.hpp"

#include <cmath>
#include <cstdio>

#include "report/html.hpp"
#include "report/paper_numbers.hpp"

namespace cinch {
namespace {

const char* name_of(PaperCase which) {
  switch (which) {
    case PaperCase::ring_pull:
      return "ring_pull";
    case PaperCase::edge_closure:
      return "edge_closure";
    case PaperCase::capture:
      return "capture";
    default:
      return "";
  }
}

Fact number(const char* what, double value, const char* unit, std::string aside = "") {
  return {what, value, unit, "", std::move(aside)};
}

Fact words(std::string what, std::string text, std::string aside = "") {
  return {std::move(what), 0, "", std::move(text), std::move(aside)};
}

std::string printed(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// The paper's cost for as many simulated seconds beside ours.
void add_cost(const Digest& d, const Summary& s, std::vector<Fact>& facts) {
  facts.push_back(words("wall time", html::duration(s.wall_seconds)));
  facts.push_back(number("a simulated second takes", s.minutes_per_simulated_second(), "min"));
  const auto cost = paper_cost(name_of(d.paper_case), d.thread_elements());
  if (!cost) return;
  const double paper = cost->minutes / cost->simulated_seconds;
  Fact fact = number("... in the paper", paper, "min",
                     std::string(cost->source) + ": " + printed("%.4g min", cost->minutes) + " for " +
                         printed("%.3g s", cost->simulated_seconds) + ", Core i7-6700HQ, step 1 µs");
  if (s.minutes_per_simulated_second() > 0)
    fact.aside +=
        printed("; here %.3g times less, on another machine", paper / s.minutes_per_simulated_second());
  facts.push_back(fact);
}

// 1 000 000
std::string grouped(long long value) {
  std::string text = std::to_string(value);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, "\u202f");
  return text;
}

std::string sizes(const Summary& s) {
  return grouped(s.nodes) + " nodes, " + grouped(s.elements) + " elements, " + std::to_string(s.rings) +
         (s.rings == 1 ? " ring" : " rings");
}

// The residual's verdict: what share of the largest input the books cannot account for.
std::string residual_words(double relative) {
  if (!std::isfinite(relative)) return "the case keeps no ledger";
  const std::string of = "of the largest of initial energy, work put in and gravity's work";
  return relative > residual_limit ? "ENERGY IS NOT CONSERVED: above 1 % " + of
                                   : "energy accounted for; " + of;
}

// "closed at 1.84 s, reopened at 2.4 s"
std::string turns_of(const Digest& d, const char* kind, const char* done, const char* undone_kind,
                     const char* undone, const std::string& name) {
  std::string text;
  for (const Event& event : d.turns(kind, undone_kind, name))
    text += (text.empty() ? "" : ", ") + std::string(event.kind == kind ? done : undone) +
            printed(" at %.4g s", event.time);
  return text.empty() ? std::string("never ") + done : text;
}

// Whether a net has caught what it was to catch.
void add_capture(const Digest& d, std::vector<Fact>& facts) {
  if (!d.model.closing_time || d.model.balls.empty()) return;
  facts.push_back(words("mouth", turns_of(d, "mouth_closed", "closed", "mouth_reopened", "reopened", ""),
                        "closed: less than 5 % of its greatest area; reopened: more than 10 %"));
  for (const ResultModel::Ball& ball : d.model.balls)
    facts.push_back(words("target " + ball.name,
                          turns_of(d, "target_enclosed", "enclosed", "target_lost", "lost", ball.name)));
}

}  // namespace

std::string status_of(const Digest& d) {
  if (!d.summary) return "unfinished: the run left no summary; what it recorded is shown";
  std::string text = d.summary->status;
  if (!d.summary->message.empty()) return text + ": " + d.summary->message;
  for (const std::string& warning : d.summary->warnings) text += "; warning: " + warning;
  return text;
}

std::vector<Fact> facts_of(const Digest& d) {
  std::vector<Fact> facts{words("status", status_of(d))};
  if (!d.summary) {
    facts.push_back(words("recorded", std::to_string(d.frame_times.size()) + " frames until " +
                                          printed("%.4g s", d.end_time())));
    facts.push_back(words("version", d.model.version, d.model.commit));
    return facts;
  }
  const Summary& s = *d.summary;
  add_capture(d, facts);
  facts.push_back(
      number("energy residual", 100 * s.relative_residual, "%", residual_words(s.relative_residual)));
  facts.push_back(number("momentum drift", s.linear_momentum_drift, "kg m/s", "linear"));
  if (s.angular_momentum_drift) facts.push_back(number("... angular", *s.angular_momentum_drift, "kg m²/s"));
  facts.push_back(number("largest penetration", s.max_penetration * 1e3, "mm"));
  facts.push_back(number("simulated", s.simulated_seconds, "s", grouped(s.steps) + " steps"));
  const std::string held =
      s.joint_steps > 1 ? "sliding joints every " + std::to_string(s.joint_steps) + " steps" : "";
  if (s.time_step == s.closing_time_step) facts.push_back(number("step", s.time_step * 1e6, "µs", held));
  else {
    facts.push_back(number("step before closing", s.time_step * 1e6, "µs"));
    facts.push_back(number("... from then on", s.closing_time_step * 1e6, "µs", held));
  }
  facts.push_back(number("stable step", s.stable_step * 1e6, "µs", "limited by " + s.stable_step_limited_by));
  add_cost(d, s, facts);
  facts.push_back(words("model", sizes(s)));
  facts.push_back(words("threads", std::to_string(s.threads), s.isa + ", " + s.host));
  facts.push_back(words("version", s.version, s.commit + ", " + s.compiler));
  return facts;
}

}  // namespace cinch
