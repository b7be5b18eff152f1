// What a valid case says and may not mean: told by `cinch check`, and by `cinch run` before it begins.
#pragma once
#include <string>
#include <vector>

#include "plan/preparation.hpp"

namespace cinch {

/// A closing thread that is laid with more strain than this was hardly meant to be so short.
inline constexpr double great_laid_strain = 0.05;

/// Each with its place in the case file: rings with automatic joints that no thread passes through, or that
/// are too narrow for one that does, closing threads far too short for what they are laid along, a closing
/// time behind the end.
std::vector<std::string> case_warnings(const Scene& scene, const Preparation& preparation);

}  // namespace cinch
