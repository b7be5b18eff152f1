#include "output/descriptor.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"

namespace cinch {

Descriptor::Descriptor(std::filesystem::path path, int flags)
    : path_(std::move(path)), number_(open(path_.c_str(), flags | O_CLOEXEC)) {
  if (number_ < 0) fail("open it");
}

Descriptor::~Descriptor() { close(number_); }

std::size_t Descriptor::read_at(std::size_t place, std::span<std::uint8_t> into) const {
  const ssize_t got = pread(number_, into.data(), into.size(), static_cast<off_t>(place));
  if (got < 0) fail("read it");
  return static_cast<std::size_t>(got);
}

void Descriptor::write_at(std::size_t place, std::span<const std::uint8_t> from) const {
  const ssize_t put = pwrite(number_, from.data(), from.size(), static_cast<off_t>(place));
  if (put != static_cast<ssize_t>(from.size())) fail("write it");
}

void Descriptor::sync() const {
  if (fsync(number_) != 0) fail("write it");
}

Locked Descriptor::lock(Lock kind) const {
  if (flock(number_, (kind == Lock::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0) return Locked::done;
  return errno == EWOULDBLOCK ? Locked::refused : Locked::impossible;
}

void Descriptor::unlock() const { flock(number_, LOCK_UN); }

void Descriptor::fail(const char* verb) const {
  throw FileError("error: " + path_.string() + ": cannot " + verb + ": " + std::strerror(errno));
}

}  // namespace cinch
