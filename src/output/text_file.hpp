// Small text files: read whole, replaced at once.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace cinch {

/// The whole file. Throws FileError.
std::string read_text_file(const std::filesystem::path& file);

/// Writes FILE.tmp and renames it to FILE: readers see the old text or the new one, never a part. Throws
/// FileError.
void replace_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace cinch
