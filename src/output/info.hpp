// What is in a result file, for people.
#pragma once
#include <iosfwd>

#include "output/result_reader.hpp"

namespace cinch {

/// Case, program, frames, counts, parts, probes and, if the run ended, stages, events and verdict.
void print_info(const Result& result, std::ostream& out);

}  // namespace cinch
