// What a study finds: runs with error and run time, which are the best, how fast errors fall.
#pragma once
#include <filesystem>
#include <limits>

#include "problem/problem.hpp"

namespace cinch::study {

struct RunResult {
  Setting setting;
  double step = 0, closing_step = 0;  ///< s, as taken before the closing time and from it on
  Errors errors;                      ///< shares of 1
  double residual = 0;                ///< of the energy ledger, relative
  double seconds = 0;                 ///< of run time for one simulated second
  std::string failure;                ///< why there is no result; else empty
  double error() const { return errors.front().second; }
  double uncertainty() const;  ///< of a mean over several runs, a share of 1; 0 for one run
  bool good() const { return failure.empty(); }
};

struct ProblemResult {
  const Problem* problem = nullptr;
  double reference_error = 0;  ///< of the reference itself; 0 for an exact one
  std::vector<RunResult> runs;
};

/// How far a mean of `count` results may be off, from how far results are from that mean. As it holds each of
/// them, their deviation is d sqrt(n / (n - 1)), that of the mean d / sqrt(n - 1); d itself for one result.
double error_of_mean(double from_the_mean, std::size_t count);

/// The run that takes least time among those within `error` for certain, null where there is none: its error,
/// what chance may add and what the reference may be off by come to no more, and its energy residual to no
/// more than `residual`.
const RunResult* best_within(const ProblemResult& result, double error,
                             double residual = std::numeric_limits<double>::infinity());

/// Order of a series: slope of log error over log element length, by least squares, from the coarsest run on
/// as far as errors fall; not a number for fewer than three such runs, or where means of chaotic runs are
/// compared.
double observed_order(const ProblemResult& result, const std::string& series);

/// All different series, in their order.
std::vector<std::string> series_of(const ProblemResult& result);

/// Writes study.json and study.csv; throws FileError.
void write(const std::vector<ProblemResult>& results, const std::filesystem::path& folder);

/// The errors for which the best setting is named.
inline constexpr double wanted_errors[] = {0.1, 0.03, 0.01, 0.003};
/// The energy residual up to which it is named once more.
inline constexpr double small_residual = 1e-4;

}  // namespace cinch::study
