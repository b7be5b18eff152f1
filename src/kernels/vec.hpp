// Plain three-vector for the kernels' one-item laws. Everything under src/kernels lives in a namespace of its
// own for each instruction set (CINCH_ISA), so that the linker can never hand AVX-512 code to a machine
// without it.
#pragma once
#include <cmath>

#ifndef CINCH_ISA
#define CINCH_ISA plain  // tests, set-up and output code compiled for any machine
#endif

namespace cinch::CINCH_ISA {

struct V3 {
  double x, y, z;
};

inline V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator*(double s, V3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(V3 a) { return std::sqrt(dot(a, a)); }

}  // namespace cinch::CINCH_ISA
