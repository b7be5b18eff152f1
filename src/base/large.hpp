// Memory for what grows with the scene.
#pragma once
#include <cstddef>
#include <new>
#include <vector>

namespace cinch {

/// Asks for huge pages where a block has room for some: a net of a million knots is there in half the time,
/// as the first touch of each page costs more than what is written to it. A wish: all works without.
void wish_huge_pages(void* block, std::size_t bytes);

template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}
  T* allocate(std::size_t n) {
    void* const block = ::operator new(n * sizeof(T));
    wish_huge_pages(block, n * sizeof(T));
    return static_cast<T*>(block);
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p); }
  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }
};

/// A vector as long as the scene has nodes or elements.
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace cinch
