// What a valid case says and may not mean: told by `cinch check`, and by `cinch run` before it begins.
#pragma once
#include <string>
#include <vector>

#include "plan/preparation.hpp"

namespace cinch {

/// Each with its place in the case file: rings with automatic joints that no thread passes through, or that
/// are too narrow for one that does, closing threads far too short for what they are laid along, other parts
/// that begin with great strain, a closing time behind the end, given steps longer than frames or probes are
/// apart.
std::vector<std::string> case_warnings(const Scene& scene, const Preparation& preparation);

}  // namespace cinch
