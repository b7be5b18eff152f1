// The folder that a run writes to: chosen, made when there is something to write, and locked, so that no two
// runs write to it at once.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "app/commands.hpp"
#include "output/folder_lock.hpp"

namespace cinch::app {

class ResultFolder {
 public:
  /// Of a run that begins, or goes on elsewhere: that of `arguments`, or the first free results/NAME-K. It
  /// is locked if it is there. Throws FileError where it holds a result that may not be replaced, or
  /// another run writes to it.
  ResultFolder(const RunArguments& arguments, const std::string& case_name);
  /// Of a run that goes on in `folder`, which it has locked already.
  explicit ResultFolder(std::filesystem::path folder) : path_(std::move(folder)), ours_(true) {}
  ResultFolder(const ResultFolder&) = delete;

  /// Creates and locks it, where that is not done: another run may have been quicker.
  void make();
  const std::filesystem::path& path() const { return path_; }

 private:
  bool hold();
  void next();
  std::filesystem::path base_, path_;
  bool fixed_ = true, overwrite_ = false, ours_ = false;
  int number_ = 1;
  std::optional<FolderLock> lock_;
};

/// Throws FileError where `folder` holds a result, unless that may be replaced.
void require_free(const std::filesystem::path& folder, bool overwrite);

}  // namespace cinch::app
