// Text for pages and terminals: escaping, numbers, base64.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/markup.hpp"

namespace cinch::html {

/// JavaScript or JSON as it may stand inside <script>: no "</script", no "<!--".
std::string script_safe(std::string_view text);

/// `digits` significant digits, powers of ten as a superscript, a true minus sign; "–" for nan.
std::string number(double value, int digits = 4);

/// number() with a narrow space and the unit.
std::string quantity(double value, std::string_view unit, int digits = 4);

/// The same for a terminal: "1.2e-06 s".
std::string plain(double value, std::string_view unit, int digits = 4);

/// Seconds as people say them: "12.3 s", "4 min 10 s", "2 h 5 min".
std::string duration(double seconds);

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace cinch::html
