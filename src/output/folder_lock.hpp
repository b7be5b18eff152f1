// Who writes to a folder of results: one run at a time. Locks lie on the folder itself: they leave no file
// behind, files in it may be replaced, and the kernel drops them when the process ends, however it ends.
#pragma once
#include <filesystem>

#include "output/descriptor.hpp"

namespace cinch {

/// Creates it where it is not there, with those above it; throws FileError.
void make_folder(const std::filesystem::path& folder);

/// The lock of one folder, held until the object goes. Where the file system has no locks, and against other
/// machines that share the folder, it does nothing. Throws FileError.
class FolderLock {
 public:
  /// The folder is there; nothing is locked yet.
  explicit FolderLock(const std::filesystem::path& folder);
  /// To write alone; false where somebody else writes. Who reads is waited for, up to a second.
  bool try_to_write() const;
  void write() const;  ///< the same, or FileError
  void read() const;   ///< beside others that read; FileError where somebody writes

 private:
  [[noreturn]] void refuse(const char* doing) const;
  std::filesystem::path folder_;
  Descriptor directory_;
};

enum class Writer { there, gone, unknown };
/// Whether a run on this machine writes to a folder; unknown where it cannot be locked.
Writer writer_of(const std::filesystem::path& folder);

}  // namespace cinch
