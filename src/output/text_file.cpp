#include "output/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/error.hpp"

namespace cinch {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const char* verb) {
  const std::string reason = errno ? std::strerror(errno) : "unknown error";
  throw FileError(file.string() + ": cannot " + verb + ": " + reason);
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || (in.peek() != std::ifstream::traits_type::eof() && !(text << in.rdbuf()))) fail(file, "read it");
  return text.str();
}

void replace_text_file(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path draft = file.string() + ".tmp";
  errno = 0;
  std::ofstream out(draft, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) fail(draft, "write it");
  std::error_code error;
  std::filesystem::rename(draft, file, error);
  if (error) throw FileError(file.string() + ": cannot replace it: " + error.message());
}

}  // namespace cinch
