#include "report/assets.hpp"

#include <cstddef>

// Set down in assets.S.
extern "C" {
extern const char cinch_asset_chart_js[], cinch_asset_chart_js_end[];
extern const char cinch_asset_three_js[], cinch_asset_three_js_end[];
extern const char cinch_asset_page_css[], cinch_asset_page_css_end[];
extern const char cinch_asset_page_js[], cinch_asset_page_js_end[];
}

namespace cinch::assets {
namespace {

std::string_view text(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view chart_js() { return text(cinch_asset_chart_js, cinch_asset_chart_js_end); }
std::string_view three_js() { return text(cinch_asset_three_js, cinch_asset_three_js_end); }
std::string_view page_css() { return text(cinch_asset_page_css, cinch_asset_page_css_end); }
std::string_view page_js() { return text(cinch_asset_page_js, cinch_asset_page_js_end); }

}  // namespace cinch::assets
