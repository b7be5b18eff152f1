// What lists take of the heap, for the sums of memory.cpp.
#pragma once
#include <cstddef>

namespace cinch {

template <class... List>
std::size_t bytes_of(const List&... lists) {
  return (std::size_t{0} + ... + (lists.capacity() * sizeof(typename List::value_type)));
}

}  // namespace cinch
