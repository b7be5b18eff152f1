#include "app/result_folder.hpp"

#include "base/error.hpp"
#include "output/result_layout.hpp"

namespace cinch::app {
namespace {

namespace fs = std::filesystem;

// What cannot be looked at is told by who makes or opens it.
bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool taken(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / layout::kResultFile, error);
}

}  // namespace

void require_free(const fs::path& folder, bool overwrite) {
  if (taken(folder) && !overwrite)
    throw FileError("error: " + folder.string() +
                    " holds a result already; give another --out, or --overwrite to replace it");
}

ResultFolder::ResultFolder(const RunArguments& arguments, const std::string& case_name)
    : base_(arguments.out.empty() ? fs::path("results") / case_name : arguments.out),
      path_(base_),
      fixed_(!arguments.out.empty() || arguments.overwrite),
      overwrite_(arguments.overwrite) {
  while (is_folder(path_) && !hold()) next();
}

void ResultFolder::make() {
  while (!ours_) {
    make_folder(path_);
    if (!hold()) next();
  }
}

// False where it is another run's and the next may do.
bool ResultFolder::hold() {
  const FolderLock& lock = lock_.emplace(path_);
  if (fixed_) lock.write();
  else if (!lock.try_to_write() || taken(path_)) return false;
  require_free(path_, overwrite_);
  return ours_ = true;
}

void ResultFolder::next() {
  lock_.reset();
  path_ = base_.string() + "-" + std::to_string(++number_);
}

}  // namespace cinch::app
