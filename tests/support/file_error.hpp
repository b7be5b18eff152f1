// What a file that cannot be used is told to be.
#pragma once
#include <string>

#include "base/error.hpp"

namespace cinch::test {

/// The text of the FileError that `use` throws; empty where it throws none.
template <class Use>
std::string file_error_of(Use&& use) {
  try {
    use();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace cinch::test
