#include "input/nearest_key.hpp"

#include <algorithm>
#include <numeric>

namespace cinch {

namespace {

constexpr std::size_t max_word = 40, max_candidates = 1000;  // more is no slip of the pen, or takes long

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Number of insertions, deletions, replacements and swaps of neighbours, letters' case ignored.
std::size_t typing_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0u);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

// A word that was cut short, or lacks its unit, is meant more often than one of similar letters.
bool is_beginning(const std::string& word, const std::string& candidate) {
  return word.size() >= 3 && candidate.size() > word.size() && candidate.compare(0, word.size(), word) == 0;
}

}  // namespace

std::string nearest_key(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > max_word) return "";
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2);
  for (std::size_t i = 0; i < candidates.size() && i < max_candidates; ++i) {
    const std::string& candidate = candidates[i];
    if (is_beginning(word, candidate)) return candidate;
    if (candidate.size() > word.size() + best_distance) continue;
    const std::size_t distance = typing_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_key(word, candidates);
  return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

std::string list_of(const std::vector<std::string>& words, std::size_t at_most) {
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < at_most; ++i) text += (i ? ", " : "") + words[i];
  if (words.size() > at_most) text += ", ... (" + std::to_string(words.size()) + " in all)";
  return text;
}

}  // namespace cinch
