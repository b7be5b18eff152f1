// Files that the program carries inside: libraries and our own style and script for the report page.
#pragma once
#include <string_view>

namespace cinch::assets {

std::string_view chart_js();  ///< Chart.js 3.9.1, minified
std::string_view three_js();  ///< three.js r111, minified
std::string_view page_css();  ///< page.css
std::string_view page_js();   ///< page.js

}  // namespace cinch::assets
