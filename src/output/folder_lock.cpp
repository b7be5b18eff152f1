#include "output/folder_lock.hpp"

#include <fcntl.h>

#include <chrono>
#include <thread>

#include "base/error.hpp"

namespace cinch {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot create the directory: " + error.message());
}

FolderLock::FolderLock(const fs::path& folder)
    : folder_(folder), directory_(folder, O_RDONLY | O_DIRECTORY) {}

bool FolderLock::try_to_write() const {
  constexpr int tries = 100;
  for (int k = 0; k < tries; ++k) {
    if (directory_.lock(Lock::alone) != Locked::refused) return true;
    if (directory_.lock(Lock::shared) == Locked::refused) return false;  // somebody writes
    directory_.unlock();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

void FolderLock::write() const {
  if (!try_to_write())
    refuse(directory_.lock(Lock::shared) == Locked::refused ? "writing to it" : "reading it");
}

void FolderLock::read() const {
  if (directory_.lock(Lock::shared) == Locked::refused) refuse("writing to it");
}

void FolderLock::refuse(const char* doing) const {
  throw FileError("error: " + folder_.string() + ": another cinch run is " + doing);
}

Writer writer_of(const fs::path& folder) {
  try {
    const Descriptor directory(folder, O_RDONLY | O_DIRECTORY);
    const Locked locked = directory.lock(Lock::shared);
    return locked == Locked::refused ? Writer::there
           : locked == Locked::done  ? Writer::gone
                                     : Writer::unknown;
  } catch (const FileError&) {
    return Writer::unknown;
  }
}

}  // namespace cinch
