// How a scene that cannot be is refused.
#pragma once
#include <string>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace cinch {

/// Throws CaseError with the place in the case file, where the part has one.
[[noreturn]] inline void fail(const SourceRef& source, const std::string& message) {
  throw CaseError((source.text.empty() ? std::string() : source.text + ": ") + "error: " + message);
}

}  // namespace cinch
