#include "report/html.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cinch::html {
namespace {

std::string printed(const char* format, int digits, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, digits, value);
  return text;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
    text.replace(i, from.size(), to);
}

}  // namespace

std::string script_safe(std::string_view text) {
  std::string out(text);
  for (const std::string_view word : {"</script", "</SCRIPT", "</Script"})
    replace_all(out, word, "<\\/" + std::string(word.substr(2)));
  replace_all(out, "<!--", "<\\!--");
  replace_all(out, "<script", "<\\script");
  return out;
}

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return std::isnan(value) ? "–" : value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  std::string text;
  const double size = std::abs(value);
  if (size >= 1e-3 && size < 1e5) {
    text = printed("%.*g", digits, value);
    if (text.find('e') != std::string::npos) text = printed("%.*f", 0, value);
  } else {
    text = printed("%.*e", digits > 1 ? digits - 1 : 0, value);
    const auto e = text.find('e');
    std::string mantissa = text.substr(0, e);
    if (mantissa.find('.') != std::string::npos) {
      mantissa.erase(mantissa.find_last_not_of('0') + 1);
      if (mantissa.back() == '.') mantissa.pop_back();
    }
    text = mantissa + "·10<sup>" + std::to_string(std::atoi(text.c_str() + e + 1)) + "</sup>";
  }
  replace_all(text, "-", "−");
  return text;
}

std::string quantity(double value, std::string_view unit, int digits) {
  std::string text = number(value, digits);
  if (!unit.empty()) text += "\u202f" + escape_markup(unit);
  return text;
}

std::string plain(double value, std::string_view unit, int digits) {
  if (std::isnan(value)) return "-";
  std::string text = printed("%.*g", digits, value);
  if (!unit.empty()) text += " " + std::string(unit);
  return text;
}

std::string duration(double seconds) {
  char text[48];
  const double whole = std::round(seconds);
  if (seconds < 100) {
    std::snprintf(text, sizeof text, "%.3g s", seconds);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%.0f min %.0f s", std::floor(whole / 60), std::fmod(whole, 60));
  } else {
    std::snprintf(text, sizeof text, "%.0f h %.0f min", std::floor(whole / 3600),
                  std::floor(std::fmod(whole, 3600) / 60));
  }
  return text;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t word = (static_cast<std::uint32_t>(bytes[i]) << 16) |
                               (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0U) |
                               (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0U);
    out += digits[word >> 18];
    out += digits[(word >> 12) & 63];
    out += left > 1 ? digits[(word >> 6) & 63] : '=';
    out += left > 2 ? digits[word & 63] : '=';
  }
  return out;
}

}  // namespace cinch::html
