// A folder for what a benchmark writes, gone with the object.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

namespace cinch::bench {

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() / ("cinch_bench_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

  /// Bytes of all that lies in it.
  double bytes() const {
    double sum = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path_))
      if (entry.is_regular_file()) sum += static_cast<double>(entry.file_size());
    return sum;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace cinch::bench
