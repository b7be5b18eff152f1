// --set key.path=value: changes a parsed case before it is checked.
#pragma once
#include <vector>

#include "input/diagnostics.hpp"

namespace cinch {

/// Puts the overrides into the document. Keys may be new, parts must exist; errors go to `diagnostics`.
void apply_overrides(TomlValue& document, const std::vector<Override>& overrides, Diagnostics& diagnostics);

}  // namespace cinch
