// Summary <-> JSON: the text of summary.json.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace cinch {

/// JSON text of a summary, two-space indent, newline at the end. Numbers read back to the same bits; values
/// that JSON cannot hold (nan, infinity) become null.
std::string summary_to_json(const Summary& summary);

/// Reads it back (null numbers as nan). `where` names the source in messages. Throws FileError.
Summary summary_from_json(std::string_view text, const std::string& where);

/// Reads a summary.json file. Throws FileError.
Summary read_summary(const std::filesystem::path& file);

}  // namespace cinch
