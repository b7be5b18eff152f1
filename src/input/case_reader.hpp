// Case files: TOML in, a checked scene with every default written out.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "input/diagnostics.hpp"
#include "scene/scene.hpp"

namespace cinch {

/// Reads and checks a case file; throws CaseError that lists all mistakes with file:line:column.
Scene read_case(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// The same for a text; `file_name` names the case and stands in messages.
Scene parse_case(std::string_view text, const std::string& file_name,
                 const std::vector<Override>& overrides = {});

/// Markdown tables of all sections and keys (the second part of cases/README.md).
std::string case_reference();

}  // namespace cinch
