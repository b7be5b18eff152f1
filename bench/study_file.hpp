// What a study has found, as study.json and study.csv.
#pragma once
#include <filesystem>

#include "study_result.hpp"

namespace cinch::study {

/// Of `all` problems those that `results` lack are kept as a study.json in the folder has them, where the
/// same program made that to the same extent; throws FileError.
void write(const std::vector<ProblemResult>& results, const std::vector<Problem>& all, Extent extent,
           const std::filesystem::path& folder);

}  // namespace cinch::study
