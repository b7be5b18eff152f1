// How far each of the paper's numbers moves with the inputs that the paper leaves open.
#pragma once
#include <vector>

#include "report/digest.hpp"
#include "report/paper_numbers.hpp"

namespace cinch {

/// The range of each number over `variants`: runs of one case, each with some open input changed. The note
/// names the variants (by their folders) that reach the ends of the range.
Sensitivity range_over(const std::vector<Digest>& variants);

}  // namespace cinch
