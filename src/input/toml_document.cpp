#include "input/toml_document.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace cinch {
[[noreturn]] static void refuse_toml(const char* condition) { throw std::logic_error(condition); }
}  // namespace cinch

// Some malformed texts reach an assertion of toml++ 3.3 (issue 294 there): make that an ordinary error. With
// NDEBUG the header would replace it by an assumption, and such a text by undefined behaviour.
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : cinch::refuse_toml(#condition))
#include <toml++/toml.h>

namespace cinch {

namespace {

constexpr std::size_t max_name = 100;  // characters of a key or name
constexpr int max_key_parts = 32;      // a.b.c...: tables nest by recursion, so depth costs stack

// Walks over the text before toml++ sees it. It knows comments and strings just well enough to blank what
// toml++ cannot take, and bounds the depth of dotted keys. Whatever it misjudges, only ASCII reaches toml++.
class PreScan {
 public:
  explicit PreScan(std::string_view text) : text_(text) {}

  std::string run() {
    if (text_.size() > max_resolved_size) throw TomlError{{1, 1}, "the case is larger than 64 MiB"};
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.replace(0, 3, "   ");  // byte order mark
    for (at_ = 0; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      check_byte(c);
      if (c == '\n') new_line();
      else if (in_comment_) continue;
      else if (quote_ != 0) inside_string(c);
      else if (c == '#') in_comment_ = true;
      else if (c == '"' || c == '\'') open_string(c);
      else count_key_part(c);
    }
    return std::move(text_);
  }

 private:
  Place here() const { return {line_, static_cast<int>(at_ - line_begin_) + 1}; }

  void check_byte(char c) {
    if (c == '\0') throw TomlError{here(), "the file contains a NUL byte: it is no text file"};
    if (static_cast<unsigned char>(c) < 0x80) return;
    if (!in_comment_) throw TomlError{here(), "only ASCII characters are allowed outside of comments"};
    text_[at_] = '?';
  }

  void new_line() {
    ++line_;
    line_begin_ = at_ + 1;
    in_comment_ = false;
    key_parts_ = 0;
    if (!triple_) quote_ = 0;
  }

  bool three_quotes(char c) const {
    return at_ + 2 < text_.size() && text_[at_ + 1] == c && text_[at_ + 2] == c;
  }

  void open_string(char c) {
    quote_ = c;
    triple_ = three_quotes(c);
    if (triple_) at_ += 2;
  }

  void inside_string(char c) {
    if (c == '\\' && quote_ == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n' &&
        static_cast<unsigned char>(text_[at_ + 1]) < 0x80 && text_[at_ + 1] != '\0') {
      ++at_;  // an escaped character never closes the string
    } else if (c == quote_ && (!triple_ || three_quotes(c))) {
      if (triple_) at_ += 2;
      quote_ = 0;
      triple_ = false;
    }
  }

  void count_key_part(char c) {
    if (c == '.') ++key_parts_;
    if (std::string_view("=,[]{}").find(c) != std::string_view::npos) key_parts_ = 0;
    if (key_parts_ >= max_key_parts)
      throw TomlError{here(), "a key of more than " + std::to_string(max_key_parts) + " parts"};
  }

  std::string text_;
  std::size_t at_ = 0, line_begin_ = 0;
  int line_ = 1, key_parts_ = 0;
  bool in_comment_ = false, triple_ = false;
  char quote_ = 0;
};

Place place_of(const toml::source_region& region) {
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

TomlValue convert(const toml::node& node);

void convert_table(const toml::table& table, TomlValue& value) {
  for (const auto& [key, child] : table) {
    if (key.str().size() > max_name)
      throw TomlError{place_of(key.source()),
                      "a key or name of more than " + std::to_string(max_name) + " characters"};
    value.members.push_back({std::string(key.str()), place_of(key.source()), convert(child)});
  }
  // toml++ sorts by key; the order of the file is the order of the parts
  std::stable_sort(value.members.begin(), value.members.end(), [](const TomlMember& a, const TomlMember& b) {
    return a.key_place.line != b.key_place.line ? a.key_place.line < b.key_place.line
                                                : a.key_place.column < b.key_place.column;
  });
}

TomlValue convert(const toml::node& node) {
  using Type = TomlValue::Type;
  TomlValue value;
  value.place = place_of(node.source());
  if (const toml::table* table = node.as_table()) {
    convert_table(*table, value);
  } else if (const toml::array* array = node.as_array()) {
    value.type = Type::array;
    for (const toml::node& item : *array) value.items.push_back(convert(item));
  } else if (const auto* string = node.as_string()) {
    value.type = Type::string;
    value.text = string->get();
  } else if (const auto* integer = node.as_integer()) {
    value.type = Type::integer;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.type = Type::number;
    value.number = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    value.type = Type::boolean;
    value.flag = flag->get();
  } else {
    value.type = Type::date;
  }
  return value;
}

// "\u00E4": what lies beyond ASCII comes in as escapes and leaves as escapes.
std::string escaped(std::uint32_t code) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), code > 0xFFFF ? "\\U%08X" : "\\u%04X", code);
  return text.data();
}

// The character of several bytes that begins at `i`, which is moved to its last byte. Strings are valid
// UTF-8: toml++ saw to that.
std::uint32_t code_point(const std::string& string, std::size_t& i) {
  const auto first = static_cast<unsigned char>(string[i]);
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  std::uint32_t code = first & (0x3Fu >> more);
  for (int k = 0; k < more && i + 1 < string.size(); ++k)
    code = code << 6 | (static_cast<unsigned char>(string[++i]) & 0x3Fu);
  return code;
}

void set_places(TomlValue& value, Place place) {
  value.place = place;
  for (TomlValue& item : value.items) set_places(item, place);
  for (TomlMember& member : value.members) {
    member.key_place = place;
    set_places(member.value, place);
  }
}

}  // namespace

const TomlMember* TomlValue::find(std::string_view key) const {
  for (const TomlMember& member : members)
    if (member.key == key) return &member;
  return nullptr;
}

TomlMember* TomlValue::find(std::string_view key) {
  return const_cast<TomlMember*>(static_cast<const TomlValue*>(this)->find(key));
}

TomlValue parse_toml(std::string_view text) {
  const std::string clean = PreScan(text).run();
  try {
    return convert(toml::parse(std::string_view(clean)));
  } catch (const toml::parse_error& error) {
    throw TomlError{place_of(error.source()), std::string(error.description())};
  } catch (const std::logic_error&) {
    throw TomlError{{}, "not valid TOML"};
  }
}

TomlValue parse_toml_value(std::string_view text, Place place) {
  for (const char c : text)
    if (c == '\0' || static_cast<unsigned char>(c) >= 0x80)
      throw TomlError{place, "only ASCII characters are allowed"};
  TomlValue value;
  value.type = TomlValue::Type::string;
  value.text = text;
  try {
    TomlValue document = parse_toml("value = " + std::string(text));
    if (document.members.size() == 1) value = std::move(document.members[0].value);
  } catch (const TomlError&) {
    // no TOML value: the bare text is the string
  }
  set_places(value, place);
  return value;
}

std::string toml_text(double number) {
  if (number == 0 && std::signbit(number)) return "-0.0";  // "-0" would be a whole number without a sign
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return std::string(buffer.data(), end);
}

std::string toml_text(const std::string& string) {
  std::string text = "\"";
  for (std::size_t i = 0; i < string.size(); ++i) {
    const char c = string[i];
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') text += std::string("\\") + c;
    else if (c == '\n') text += "\\n";
    else if (c == '\t') text += "\\t";
    else if (code < 0x20 || code == 0x7F) text += escaped(code);
    else if (code >= 0x80) text += escaped(code_point(string, i));
    else text += c;
  }
  return text + "\"";
}

std::string toml_text(const TomlValue& value, std::size_t enough) {
  using Type = TomlValue::Type;
  std::string text;
  switch (value.type) {
    case Type::string:
      return toml_text(value.text);
    case Type::integer:
      return std::to_string(value.integer);
    case Type::number:
      return toml_text(value.number);
    case Type::boolean:
      return value.flag ? "true" : "false";
    case Type::date:
      return "a date or time";
    case Type::array:
      for (const TomlValue& item : value.items) {
        if (text.size() > enough) break;
        text += (text.empty() ? "" : ", ") + toml_text(item, enough);
      }
      return "[" + text + "]";
    case Type::table:
      for (const TomlMember& member : value.members) {
        if (text.size() > enough) break;
        text += (text.empty() ? "" : ", ") + toml_key(member.key) + " = " + toml_text(member.value, enough);
      }
      return "{ " + text + " }";
  }
  return text;
}

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : toml_text(key);
}

std::string describe(const TomlValue& value) {
  static constexpr std::array<const char*, 7> names = {"string", "integer", "number", "boolean",
                                                       "array",  "table",   "date"};
  std::string text = toml_text(value, 60);
  const bool looks_whole = text.find_first_not_of("-0123456789") == std::string::npos;
  if (value.type == TomlValue::Type::number && looks_whole) text += ".0";
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  std::string type = names[static_cast<std::size_t>(value.type)];
  if (value.type == TomlValue::Type::array) type += " of " + std::to_string(value.items.size());
  return value.type == TomlValue::Type::date ? text : text + " (" + type + ")";
}

}  // namespace cinch
