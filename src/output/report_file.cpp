#include "output/report_file.hpp"

#include <fstream>
#include <string>

#include "base/error.hpp"

namespace cinch {
namespace {

namespace fs = std::filesystem;

bool is_plain(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(fs::symlink_status(file, ignored));
}

}  // namespace

bool is_report_page(const fs::path& file) {
  if (!is_plain(file)) return false;
  std::string head(512, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.starts_with("<!doctype html>") && head.find(kPageMark) != std::string::npos;
}

bool is_report_table(const fs::path& file) {
  if (!is_plain(file)) return false;
  std::ifstream in(file, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || !line.starts_with("|") || !line.ends_with(kTableMark)) return false;
  while (std::getline(in, line))
    if (!line.empty() && !line.starts_with("|")) return false;
  return true;
}

void require_own(const fs::path& file, bool (*own)(const fs::path&)) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(file, ignored);
  if (!fs::exists(status) || own(file)) return;
  const std::string why = is_plain(file)
                              ? "cinch report did not write it; give another name, or remove it first"
                              : "it is no regular file; give another name";
  throw Error(ExitCode::usage, "error: " + file.string() + " is not replaced: " + why);
}

}  // namespace cinch
