// Plain three-vector for the kernels' one-item laws. Everything under src/kernels lives in a namespace of its
// own for each instruction set (CINCH_ISA), so that the linker can never hand AVX-512 code to a machine
// without it.
#pragma once
#include <cmath>

#ifndef CINCH_ISA
#define CINCH_ISA plain  // tests, set-up and output code compiled for any machine
#endif

namespace cinch::CINCH_ISA {

template <class Number>
struct Triple {
  Number x, y, z;
};
using V3 = Triple<double>;

/// For operands that shall convert to Number, as 0.5 to eight of them.
template <class Number>
struct AsType {
  using Type = Number;
};
template <class Number>
using As = typename AsType<Number>::Type;

template <class N>
inline Triple<N> operator+(Triple<N> a, Triple<N> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
inline Triple<N> operator-(Triple<N> a, Triple<N> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
inline Triple<N> operator*(As<N> s, Triple<N> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class N>
inline N dot(Triple<N> a, Triple<N> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
inline Triple<N> cross(Triple<N> a, Triple<N> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(V3 a) { return std::sqrt(dot(a, a)); }

// What code for one number or several needs besides: for one.
inline double square_root(double a) { return std::sqrt(a); }
inline double magnitude(double a) { return std::fabs(a); }
inline double pick(bool first, double a, double b) { return first ? a : b; }
template <class Truth, class N>
inline Triple<N> pick(Truth first, Triple<N> a, Triple<N> b) {
  return {pick(first, a.x, b.x), pick(first, a.y, b.y), pick(first, a.z, b.z)};
}

}  // namespace cinch::CINCH_ISA
