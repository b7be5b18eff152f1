// 64-bit FNV-1a, the hash of states and of checkpoints.
#pragma once
#include <cstddef>
#include <cstdint>

namespace cinch {

class Fnv {
 public:
  void add(std::uint8_t byte) {
    hash_ ^= byte;
    hash_ *= 0x100000001b3ULL;
  }
  /// From the least significant byte.
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) add(static_cast<std::uint8_t>(word >> (8 * byte)));
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

}  // namespace cinch
