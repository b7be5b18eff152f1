// Errors of a case file: all are collected, then told at once.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "input/toml_document.hpp"

namespace cinch {

/// Replaces one value of a case: the key path ("time.end_s") and the new value in TOML syntax; a text that is
/// no TOML value counts as a string.
struct Override {
  std::string key, value;
};

/// Collects errors and formats them as file:line:column, message, source line and caret.
class Diagnostics {
 public:
  Diagnostics(std::string file_name, std::string_view text, const std::vector<Override>& overrides)
      : file_name_(std::move(file_name)), text_(text), overrides_(overrides) {}

  /// Notes an error; `help` (allowed keys, values, ...) is shown on a line of its own. Throws after a
  /// thousand. Of an override the first counts.
  void error(Place place, const std::string& message, const std::string& help = "");
  bool empty() const { return errors_.empty(); }
  /// Throws CaseError with the first 20 errors, overrides first, then in the order of the file.
  [[noreturn]] void throw_all() const;
  void throw_if_any() const {
    if (!empty()) throw_all();
  }
  /// "file:line:column", or "--set key=value".
  std::string where(Place place) const;

 private:
  struct Entry {
    Place place;
    std::string message, help;
  };
  std::string format(const Entry& entry) const;
  std::string source_line(Place place) const;

  std::string file_name_;
  std::string_view text_;
  const std::vector<Override>& overrides_;
  std::vector<Entry> errors_;
};

}  // namespace cinch
