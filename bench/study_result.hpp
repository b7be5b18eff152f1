// What a study finds: runs with error and run time, which are the best, how fast errors fall.
#pragma once
#include <limits>
#include <map>

#include "problem/problem.hpp"

namespace cinch::study {

/// The steps of a run, before the closing time and from it on.
struct StepsTaken {
  double step = 0, closing_step = 0;          ///< s
  double fraction = 0, closing_fraction = 0;  ///< of the stable step
  int joint_steps = 0;                        ///< for which forces of sliding joints held
};

struct RunResult {
  Setting setting;
  StepsTaken taken;
  Errors errors;         ///< shares of 1
  Errors uncertainties;  ///< what chance may add to each, for a mean over several runs; else none
  double one_run = 0;    ///< how far one of several runs is from their mean, by the first measure
  double residual = 0;   ///< of the energy ledger, relative
  double seconds = 0;    ///< of run time for one simulated second
  std::string failure;   ///< why there is no result; else empty
  Track apart;           ///< from the exact solution, where there is one
  double error() const { return errors.front().second; }
  double uncertainty() const { return uncertainties.empty() ? 0 : uncertainties.front().second; }
  double sure_error() const { return error() + uncertainty(); }  ///< with what chance may add
  bool good() const { return failure.empty(); }
};

struct ProblemResult {
  const Problem* problem = nullptr;
  Errors reference_errors;  ///< of the reference itself, by each measure; none for an exact one
  std::vector<RunResult> runs;
  double reference_error() const { return reference_errors.empty() ? 0 : reference_errors.front().second; }
};

/// How far a mean of `count` results may be off, from how far results are from that mean. As it holds each of
/// them, their deviation is d sqrt(n / (n - 1)), that of the mean d / sqrt(n - 1); d itself for one result.
double error_of_mean(double from_the_mean, std::size_t count);

/// The run that takes least time among those within `error` for certain, null where there is none: its error,
/// what chance may add and what the reference may be off by come to no more, and its energy residual to no
/// more than `residual`.
const RunResult* best_within(const ProblemResult& result, double error,
                             double residual = std::numeric_limits<double>::infinity());

/// Why there is none, in words.
std::string why_none(const ProblemResult& result, double error,
                     double residual = std::numeric_limits<double>::infinity());

/// Order of a series in its elements: slope of log error over log element length, by least squares, from the
/// coarsest run on as far as errors fall; not a number for fewer than three such runs, or where means of
/// chaotic runs are compared.
double observed_order(const ProblemResult& result, const std::string& series);

/// All different series, in their order.
std::vector<std::string> series_of(const ProblemResult& result);

/// Order in the step, by what runs of the same method and elements ("sliding, 8 elements") change as it gets
/// shorter by the same factor thrice, down to their shortest; where both orders that come of it are within
/// 0.5 of each other. Only beside an exact solution: elsewhere samples of runs lie up to half a step apart.
std::map<std::string, double> step_orders(const ProblemResult& result);

/// The errors for which the best setting is named.
inline constexpr double wanted_errors[] = {0.1, 0.03, 0.01, 0.003};
/// The energy residual up to which it is named once more.
inline constexpr double small_residual = 1e-4;

}  // namespace cinch::study
