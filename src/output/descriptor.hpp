// An open file of the system, for what streams do not do: reading and writing at a place, and waiting until
// the disk has it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

namespace cinch {

enum class Lock { shared, alone };
enum class Locked { done, refused, impossible };  ///< impossible: not where the file lies

/// Closes itself. Every function throws FileError with the system's reason.
class Descriptor {
 public:
  /// `flags` as those of open().
  Descriptor(std::filesystem::path path, int flags);
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  /// How many bytes were there.
  std::size_t read_at(std::size_t place, std::span<std::uint8_t> into) const;
  void write_at(std::size_t place, std::span<const std::uint8_t> from) const;
  void sync() const;
  /// An advisory lock of the whole, until this object goes; refused at once where another descriptor's
  /// excludes it, and then this one's last is gone, too.
  Locked lock(Lock kind) const;
  void unlock() const;

 private:
  [[noreturn]] void fail(const char* verb) const;
  std::filesystem::path path_;
  int number_;
};

}  // namespace cinch
