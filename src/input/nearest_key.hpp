// Suggestions for misspelt keys and names.
#pragma once
#include <string>
#include <vector>

namespace cinch {

/// The candidate that needs the fewest typing corrections to become `word`; empty when none is close.
std::string nearest_key(const std::string& word, const std::vector<std::string>& candidates);

/// " (did you mean 'x'?)", or nothing when no candidate is close.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

/// "a, b, c"; long lists are cut off.
std::string list_of(const std::vector<std::string>& words, std::size_t at_most = 40);

}  // namespace cinch
