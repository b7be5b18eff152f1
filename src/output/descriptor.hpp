// An open file of the system, for what streams do not do: reading and writing at a place, and waiting until
// the disk has it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

namespace cinch {

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

 private:
  [[noreturn]] void fail(const char* verb) const;
  std::filesystem::path path_;
  int number_;
};

}  // namespace cinch
