// Verdicts: what a run did against what its cell must do.
#include "cell.hpp"

#include <cstdio>

namespace cinch::matrix {
namespace {

Outcome failure(Outcome outcome, const std::string& why) {
  outcome.verdict = Verdict::failed;
  outcome.message = outcome.message.empty() ? why : why + ": " + outcome.message;
  return outcome;
}

Outcome judge_stopped(const Cell& cell, const Outcome& outcome) {
  if (cell.must == Must::hold) return failure(outcome, "must hold, but stopped");
  for (const std::string& name : cell.names)
    if (outcome.message.find(name) == std::string::npos)
      return failure(outcome, "the message does not tell '" + name + "'");
  return outcome;
}

Outcome judge_held(const Cell& cell, const Outcome& outcome) {
  if (cell.must == Must::stop) return failure(outcome, "must stop, but ran through");
  if (!(outcome.residual <= cell.most_residual))
    return failure(outcome,
                   "energy residual " + words(outcome.residual) + " above " + words(cell.most_residual));
  return outcome;
}

}  // namespace

Outcome judge(const Cell& cell) {
  const Outcome outcome = cell.run();
  switch (outcome.verdict) {
    case Verdict::stopped:
      return judge_stopped(cell, outcome);
    case Verdict::held:
      return judge_held(cell, outcome);
    default:
      return outcome;
  }
}

std::string words(Verdict verdict) {
  return verdict == Verdict::held ? "held" : verdict == Verdict::stopped ? "stopped" : "FAILED";
}

std::string words_of_must(const Cell& cell) {
  if (cell.must == Must::hold) return "held";
  std::string text = cell.must == Must::stop ? "stopped" : "held or stopped";
  for (std::size_t i = 0; i < cell.names.size(); ++i) text += (i == 0 ? ": " : ", ") + cell.names[i];
  return text;
}

std::string words(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace cinch::matrix
