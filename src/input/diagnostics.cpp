#include "input/diagnostics.hpp"

#include <algorithm>
#include <tuple>

#include "base/error.hpp"

namespace cinch {

namespace {

constexpr std::size_t max_shown = 20;
constexpr std::size_t max_kept = 10000;  // a file of garbage may hold millions

// Overrides first: they are what the user typed last.
auto order_of(Place place) {
  return std::tuple(place.override_number == 0, place.override_number, place.line, place.column);
}

}  // namespace

void Diagnostics::error(Place place, const std::string& message, const std::string& help) {
  ++count_;
  if (errors_.size() < max_kept) errors_.push_back({place, message, help});
}

std::string Diagnostics::where(Place place) const {
  if (place.override_number > 0) {
    const Override& set = overrides_[static_cast<std::size_t>(place.override_number - 1)];
    return "--set " + set.key + "=" + set.value;
  }
  if (place.line == 0) return file_name_;
  return file_name_ + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

// The line of the file with a caret below the column; shortened when very long.
std::string Diagnostics::source_line(Place place) const {
  if (place.override_number > 0 || place.line == 0) return "";
  std::size_t begin = 0;
  for (int line = 1; line < place.line; ++line) {
    begin = text_.find('\n', begin);
    if (begin == std::string_view::npos) return "";
    ++begin;
  }
  std::string line(text_.substr(begin, std::min(text_.find('\n', begin), text_.size()) - begin));
  if (!line.empty() && line.back() == '\r') line.pop_back();
  const auto column = static_cast<std::size_t>(place.column - 1);
  if (line.empty() || column > line.size() || column > 90) return "";
  std::string caret(column, ' ');
  for (std::size_t i = 0; i < column; ++i)
    if (line[i] == '\t') caret[i] = '\t';
  if (line.size() > 100) line = line.substr(0, 97) + "...";
  return "\n    " + line + "\n    " + caret + "^";
}

std::string Diagnostics::format(const Entry& entry) const {
  return where(entry.place) + ": error: " + entry.message + source_line(entry.place) +
         (entry.help.empty() ? "" : "\n    " + entry.help);
}

void Diagnostics::throw_if_any() const {
  if (errors_.empty()) return;
  std::vector<Entry> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) { return order_of(a.place) < order_of(b.place); });
  std::string text;
  for (std::size_t i = 0; i < sorted.size() && i < max_shown; ++i)
    text += (i ? "\n" : "") + format(sorted[i]);
  if (count_ > max_shown)
    text += "\n" + file_name_ + ": error: " + std::to_string(count_ - max_shown) + " more";
  throw CaseError(text);
}

}  // namespace cinch
