// The files that `cinch report` writes, as far as they are known again: it replaces no others.
#pragma once
#include <filesystem>

namespace cinch {

/// Stands in the head of each page.
inline constexpr char kPageMark[] = "<meta name=\"generator\" content=\"cinch report\">";
/// Ends the first line of each table of the paper's numbers.
inline constexpr char kTableMark[] = "| place | paper | Cinch | verdict | sensitivity and notes |";

/// A regular file, no link to one, that begins as a page does.
bool is_report_page(const std::filesystem::path& file);

/// The same for a table: such a first line, and nothing but rows behind it.
bool is_report_table(const std::filesystem::path& file);

/// Throws Error (usage) where a file is in the way that is none of those that `own` knows.
void require_own(const std::filesystem::path& file, bool (*own)(const std::filesystem::path&));

}  // namespace cinch
