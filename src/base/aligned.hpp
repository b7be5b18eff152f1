// Vectors for kernels: their data begin on a cache line (and a full AVX-512 register), and behind their end
// lies one more group of lanes that kernels may read, so that loops need no remainder: it holds zeros, or
// what once was an element.
#pragma once
#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <vector>

#include "base/large.hpp"

namespace cinch {

template <class T>
struct AlignedAllocator {
  static_assert(std::is_trivial_v<T>);
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  static constexpr std::size_t spare = 8;  ///< readable elements behind the end
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) {
    const std::size_t bytes = (n + spare) * sizeof(T);
    T* const data = static_cast<T*>(::operator new(bytes, alignment));
    wish_huge_pages(data, bytes);
    std::fill(data, data + n + spare, T{});  // all of it: a vector may have room behind its end
    return data;
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace cinch
