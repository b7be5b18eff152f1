#include "input/case_reader.hpp"

#include <fstream>

#include "base/error.hpp"
#include "input/case_builder.hpp"
#include "input/overrides.hpp"

namespace cinch {

namespace {

std::string read_text(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw CaseError(file.string() + ": error: is a directory");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw CaseError(file.string() + ": error: the case file cannot be opened");
  std::string block(1 << 16, '\0'), text;
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > max_case_size)
      throw CaseError(file.string() + ": error: the file is larger than 4 MiB");
  }
  return text;
}

TomlValue parse(std::string_view text, Diagnostics& diagnostics) {
  try {
    return parse_toml(text);
  } catch (const TomlError& error) {
    diagnostics.error(error.place, error.what);
    diagnostics.throw_all();
  }
}

}  // namespace

Scene parse_case(std::string_view text, const std::string& file_name,
                 const std::vector<Override>& overrides) {
  Diagnostics diagnostics(file_name, text, overrides);
  TomlValue document = parse(text, diagnostics);
  apply_overrides(document, overrides, diagnostics);
  Scene scene = CaseBuilder(document, diagnostics).build();
  diagnostics.throw_if_any();
  scene.name = std::filesystem::path(file_name).stem().string();
  return scene;
}

Scene read_case(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_case(read_text(file), file.string(), overrides);
}

}  // namespace cinch
