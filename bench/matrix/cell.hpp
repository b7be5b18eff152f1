// A cell of the stability matrix: a scene with something extreme in it, what must come of it, what did.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cinch::matrix {

enum class Verdict {
  held,     ///< bounded, its energy accounted for
  stopped,  ///< ended with an error that names item, time and cause
  failed    ///< garbage that nobody was told of, or not what it must do
};

/// What a cell must do.
enum class Must { hold, stop, either };

struct Outcome {
  Verdict verdict = Verdict::failed;
  double residual = 0;  ///< of the energy, the greatest relative one that was seen
  std::int64_t steps = 0;
  std::string message;  ///< of a stopped run; what is wrong with a failed one; remarks
};

struct Cell {
  Cell(std::string in, std::string what, std::string how_much, Must wanted, std::function<Outcome()> how = {})
      : group(std::move(in)),
        parameter(std::move(what)),
        value(std::move(how_much)),
        must(wanted),
        run(std::move(how)) {}

  std::string group, parameter, value;
  Must must;
  std::function<Outcome()> run;
  std::vector<std::pair<std::string, double>> place;  ///< in the figures: name with unit, value
  std::vector<std::string> names;                     ///< what the message of a stopped run must tell
  double most_residual = 0.05;                        ///< of a run that holds
};

/// How much is computed.
enum class Extent {
  quick,  ///< seconds
  full    ///< minutes
};

/// Runs a cell and holds the outcome against what it must do.
Outcome judge(const Cell& cell);

std::string words(Verdict verdict);
/// "held", "stopped: thread.main", "held or stopped: ring 'r'".
std::string words_of_must(const Cell& cell);
/// A number as short as it can be.
std::string words(double value);

}  // namespace cinch::matrix
