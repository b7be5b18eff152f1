#include "input/diagnostics.hpp"

#include <algorithm>
#include <tuple>

#include "base/error.hpp"

namespace cinch {

namespace {

constexpr std::size_t max_shown = 20;
constexpr std::size_t max_kept = 1000;  // a file of garbage may hold millions
constexpr std::size_t max_text = 600;   // characters of a message

// Overrides first: they are what the user typed last.
auto order_of(Place place) {
  return std::tuple(place.override_number == 0, place.override_number, place.line, place.column);
}

// Bytes of the character that begins at `at`, or 0 where there is none that may be shown. Of UTF-8 beyond
// ASCII what moves a terminal's cursor, too, is left out: U+0080 to U+009F.
std::size_t bytes_of_character(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(at);
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + bytes > text.size()) return 0;
  for (std::size_t k = at + 1; k < at + bytes; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  // below: U+0080 to U+009F, and longer forms of what fits into fewer bytes
  const unsigned least = first == 0xC2 || first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  return byte(at + 1) >= least ? bytes : 0;
}

// What a file says may hold anything: no line breaks, nothing that moves a terminal's cursor.
std::string printable(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = bytes_of_character(text, at);
    if (bytes == 0) text[at] = text[at] == '\t' ? ' ' : '?';
    at += std::max<std::size_t>(bytes, 1);
  }
  return text;
}

std::string shortened(const std::string& text) {
  return printable(text.size() > max_text ? text.substr(0, max_text - 3) + "..." : text);
}

}  // namespace

void Diagnostics::error(Place place, const std::string& message, const std::string& help) {
  // thread.* may be wrong for each of many threads: one says it all
  const auto same = [&](const Entry& one) { return one.place.override_number == place.override_number; };
  if (place.override_number > 0 && std::any_of(errors_.begin(), errors_.end(), same)) return;
  errors_.push_back({place, shortened(message), printable(help)});
  if (errors_.size() >= max_kept) throw_all();
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
  if (line.size() > 100) line = line.substr(0, 97) + "...";
  return "\n    " + printable(line) + "\n    " + std::string(column, ' ') + "^";
}

std::string Diagnostics::format(const Entry& entry) const {
  return where(entry.place) + ": error: " + entry.message + source_line(entry.place) +
         (entry.help.empty() ? "" : "\n    " + entry.help);
}

void Diagnostics::throw_all() const {
  std::vector<Entry> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) { return order_of(a.place) < order_of(b.place); });
  std::string text;
  for (std::size_t i = 0; i < sorted.size() && i < max_shown; ++i)
    text += (i ? "\n" : "") + format(sorted[i]);
  if (sorted.size() > max_shown)
    text += "\n" + file_name_ + ": error: " + std::to_string(sorted.size() - max_shown) + " more" +
            (sorted.size() < max_kept ? "" : " or many more: reading stopped there");
  throw CaseError(text);
}

}  // namespace cinch
