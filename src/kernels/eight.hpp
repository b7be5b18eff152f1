// Eight numbers on which each operation is done side by side, in the widest registers of the instruction set:
// for code that compilers do not vectorise by themselves. Each number gets the bits that it would get alone.
#pragma once
#if defined(__SSE2__)
#pragma GCC diagnostic push  // false alarms, GCC bug 105593
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#include "kernels/vec.hpp"

namespace cinch::CINCH_ISA {

#if defined(__AVX512F__)
constexpr int native_lanes = 8;
#elif defined(__AVX__)
constexpr int native_lanes = 4;
#else
constexpr int native_lanes = 2;
#endif
constexpr int native_parts = 8 / native_lanes;

using NativeLanes [[gnu::vector_size(8 * native_lanes)]] = double;
using NativeFlags = decltype(NativeLanes{} < NativeLanes{});

struct Eight {
  NativeLanes part[native_parts];

  Eight() = default;
  Eight(double all) {
    for (NativeLanes& p : part) p = all - NativeLanes{};
  }
  double operator[](int i) const { return part[i / native_lanes][i % native_lanes]; }
  void put(int i, double v) { part[i / native_lanes][i % native_lanes] = v; }
};

/// A truth for each of eight numbers.
struct Flags {
  NativeFlags part[native_parts];
};

template <class Result, class Operation>
[[gnu::always_inline]] inline Result part_by_part(Operation operation) {
  Result result;
#pragma GCC unroll 4
  for (int i = 0; i < native_parts; ++i) result.part[i] = operation(i);
  return result;
}

inline Eight operator+(Eight a, Eight b) {
  return part_by_part<Eight>([&](int i) { return a.part[i] + b.part[i]; });
}
inline Eight operator-(Eight a, Eight b) {
  return part_by_part<Eight>([&](int i) { return a.part[i] - b.part[i]; });
}
inline Eight operator*(Eight a, Eight b) {
  return part_by_part<Eight>([&](int i) { return a.part[i] * b.part[i]; });
}
inline Eight operator/(Eight a, Eight b) {
  return part_by_part<Eight>([&](int i) { return a.part[i] / b.part[i]; });
}
inline Flags operator>(Eight a, Eight b) {
  return part_by_part<Flags>([&](int i) { return a.part[i] > b.part[i]; });
}
inline Flags operator<=(Eight a, Eight b) {
  return part_by_part<Flags>([&](int i) { return a.part[i] <= b.part[i]; });
}
inline Flags operator<(Eight a, Eight b) { return b > a; }
inline Flags operator&&(Flags a, Flags b) {
  return part_by_part<Flags>([&](int i) { return a.part[i] & b.part[i]; });
}
inline Flags operator||(Flags a, Flags b) {
  return part_by_part<Flags>([&](int i) { return a.part[i] | b.part[i]; });
}
inline Flags operator~(Flags a) {
  return part_by_part<Flags>([&](int i) { return ~a.part[i]; });
}
inline Eight pick(Flags flags, Eight a, Eight b) {
  return part_by_part<Eight>([&](int i) { return flags.part[i] ? a.part[i] : b.part[i]; });
}

inline NativeLanes native_root(NativeLanes a) {
#if defined(__AVX512F__)
  return _mm512_sqrt_pd(a);
#elif defined(__AVX__)
  return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
  return _mm_sqrt_pd(a);
#else
  return NativeLanes{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}
inline Eight square_root(Eight a) {
  return part_by_part<Eight>([&](int i) { return native_root(a.part[i]); });
}
inline Eight magnitude(Eight a) {
  return part_by_part<Eight>(
      [&](int i) { return (NativeLanes)((NativeFlags)a.part[i] & ~(NativeFlags)(-0.0 - NativeLanes{})); });
}

inline bool any(Flags flags) {
#if defined(__AVX512F__)
  return _mm512_test_epi64_mask((__m512i)flags.part[0], (__m512i)flags.part[0]) != 0;
#else
  NativeFlags sum = flags.part[0];
  for (int i = 1; i < native_parts; ++i) sum |= flags.part[i];
  for (int i = 0; i < native_lanes; ++i)
    if (sum[i]) return true;
  return false;
#endif
}

}  // namespace cinch::CINCH_ISA
