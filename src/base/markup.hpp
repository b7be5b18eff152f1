// Text inside XML and HTML.
#pragma once
#include <string>
#include <string_view>

namespace cinch {

/// `text` with the four characters escaped that end text or an attribute in XML and HTML.
std::string escape_markup(std::string_view text);

}  // namespace cinch
