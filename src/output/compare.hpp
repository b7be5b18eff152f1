// Two results against each other: first bit by bit, then how far apart.
#pragma once
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "output/result_reader.hpp"

namespace cinch {

/// One field in which two results differ.
struct FieldDifference {
  std::string field, unit;
  std::size_t values = 0;  ///< how many values differ, in all frames together
  double absolute = 0;     ///< largest difference, in `unit`; infinity where only one of them is nan
  double relative = 0;     ///< the same over the field's largest magnitude in either run
  int first_frame = -1;    ///< first frame (row of a series) that differs; -1: has no frames
  double first_time = std::numeric_limits<double>::quiet_NaN();  ///< s
  std::size_t first_index = 0;  ///< node, element, ring ... that differs first there
};

struct Comparison {
  bool identical = true;  ///< same shape, same bits, same state hash
  std::vector<std::string>
      shape;  ///< differences in shape or kind: counts, connectivity, status; one sentence each
  std::vector<std::string>
      notes;  ///< no differences of the results: threads, instruction set, compiler, case text
  std::vector<FieldDifference> fields;  ///< only those that differ
  int frames_compared = 0;
  std::size_t values_compared = 0;
  std::optional<std::uint64_t> hash_a, hash_b;  ///< of the final state; absent where a run did not end
};

/// Compares frames and probe rows of the same time, events, ring records and the state hash; rings and probes
/// by name, nodes and elements only where the meshes are alike. Wall times, threads, instruction set,
/// compiler and case text may differ. Throws FileError when a file cannot be read.
Comparison compare_results(const Result& a, const Result& b);

/// "identical: 41 frames, ..." or the list of differences.
void print_comparison(const Comparison& comparison, std::ostream& out);

}  // namespace cinch
