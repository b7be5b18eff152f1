// The exact closest points of segment_circle.hpp for many pairs at once: the same operations in the same
// order on arrays, without branches, so that compilers vectorise them and every pair gets the bits that it
// would get alone.
//
// The few pairs that need a branch of their own (a thread along the ring's axis, a second local minimum in
// reach, more iterations than `rounds`) are marked hard and left to segment_circle_exact.
#pragma once
#include "kernels/segment_circle.hpp"

namespace cinch::CINCH_ISA {

constexpr int lane_capacity = 32;  ///< pairs of a batch: its arrays stay in the first-level cache

struct Lane3 {
  alignas(64) double x[lane_capacity], y[lane_capacity], z[lane_capacity];
};

struct Lane1 {
  alignas(64) double at[lane_capacity];
};

/// In: the segments' first ends, as seen from the rings' centres, and their vectors; normals and radii of the
/// rings. Out: parameter, closest points (from the centre), radial vectors, distance; hard is 1 where the
/// rest is void.
struct CircleLanes {
  Lane3 start, along, normal;
  Lane1 radius;
  Lane3 p, q, radial;
  Lane1 t, distance, hard;
  Lane1 start_squared, end_squared;  ///< squared distances of the two ends from the circle
};

/// What the search of one batch keeps between its passes; names as in segment_circle.hpp.
struct SearchLanes {
  Lane1 v, n0, dn, ee, inv_ee, b2, mm, low, u, back, open;
};

/// h and its derivatives at u of one lane, as half_slope.
inline HalfSlope lane_slope(double radius, double b2, double ee, double inv_ee, double mm, double v0,
                            double n0, double dn, double u) {
  const double v = v0 + u * ee;
  const double rho2 = b2 + v * v * inv_ee;
  const double axial = dn * (n0 + u * dn);
  const double inv = 1.0 / std::sqrt(rho2);
  const double k = radius * inv;
  const double bend = k * ee * (b2 * inv * inv);
  const double curl = 3.0 * bend * inv * inv;
  return {axial + (v - k * v), mm - bend, curl * v, curl * ee};
}

/// One round of convex_root at u, where `h` is the slope there: the next u, and whether the search goes on.
inline double lane_round(const HalfSlope& h, double u, double low, double& more) {
  const double inv = 1.0 / h.dh;
  const double step = h.h * inv;
  const double r2 = step * h.d2h * inv;
  const double r3 = step * step * h.d3h * inv;
  const double newton = u - step;
  const double led = newton - 0.5 * step * r2;
  const double curved = led > low ? led : low;
  const double next = std::fabs(r2) < 0.25 ? curved : newton;
  more = std::fabs(step) * (r2 * r2 + r3) <= 1e-17 ? 0.0 : 1.0;
  return newton > low ? next : low;
}

/// Directions, brackets and the first round of the search.
inline void begin_search(CircleLanes& c, SearchLanes& s, int count) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double nx = c.normal.x[i], ny = c.normal.y[i], nz = c.normal.z[i];
    const double mx = c.along.x[i], my = c.along.y[i], mz = c.along.z[i];
    const double dx = c.start.x[i], dy = c.start.y[i], dz = c.start.z[i];
    const double nm = nx * mx + ny * my + nz * mz, n1 = nx * dx + ny * dy + nz * dz;
    const double ex = mx - nm * nx, ey = my - nm * ny, ez = mz - nm * nz;
    const double fx = dx - n1 * nx, fy = dy - n1 * ny, fz = dz - n1 * nz;
    const double ee = ex * ex + ey * ey + ez * ez;
    const double mm = ee + nm * nm;
    const double inv_ee = 1.0 / ee;
    const double gx = fy * ez - fz * ey, gy = fz * ex - fx * ez, gz = fx * ey - fy * ex;
    const double b2 = (gx * gx + gy * gy + gz * gz) * inv_ee;
    const double v1 = fx * ex + fy * ey + fz * ez;
    const double c_slope = nm * (n1 - v1 * inv_ee * nm);
    const double v_back = -(v1 + ee);
    const double other_side = c_slope <= 0.0 ? 0.0 : 1.0;
    const double beyond = v_back >= 0.0 ? 1.0 : other_side;
    const double behind = v1 < 0.0 ? beyond : 0.0;
    const double v = behind > 0.0 ? v_back : v1, n0 = behind > 0.0 ? n1 + nm : n1,
                 dn = behind > 0.0 ? -nm : nm;
    const double low =
        v < 0.0 ? -v * inv_ee : 0.0;  // above 0: the line's lowest point on the other side is here, too
    const double radius = c.radius.at[i];
    const HalfSlope end = lane_slope(radius, b2, ee, inv_ee, mm, v, n0, dn, 1.0);
    const HalfSlope begin = lane_slope(radius, b2, ee, inv_ee, mm, v, n0, dn, 0.0);
    double more;
    const double first = lane_round(end, 1.0, low, more);
    const double falls = end.h > 0.0 ? 0.0 : 1.0;  // towards the far end, all the way
    const double uphill = begin.h > 0.0 ? 1.0 : 0.0;
    const double rises = v < 0.0 ? 0.0 : uphill;  // from the near end on
    const double rho_start = std::sqrt(fx * fx + fy * fy + fz * fz) - radius;
    const double tx = fx + ex, ty = fy + ey, tz = fz + ez, n2 = n1 + nm;
    const double rho_end = std::sqrt(tx * tx + ty * ty + tz * tz) - radius;
    c.start_squared.at[i] = rho_start * rho_start + n1 * n1;
    c.end_squared.at[i] = rho_end * rho_end + n2 * n2;
    // tiny segments, those along the axis or with an end on it, and the choice between two minima
    double odd = mm > 1e-200 ? 0.0 : 1.0;
    odd = ee > 1e-30 * mm ? odd : 1.0;
    odd = b2 + v * v * inv_ee > 1e-280 ? odd : 1.0;
    const double far_choice = low > 0.5 ? 1.0 : rises;
    const double dips = begin.dh >= 0.0 ? 0.0 : 1.0, bottom = end.dh > 0.0 ? 0.0 : 1.0;
    const double near_choice = rises > 0.0 ? dips : bottom;
    odd += falls > 0.0 ? far_choice : near_choice;
    s.v.at[i] = v, s.n0.at[i] = n0, s.dn.at[i] = dn;
    s.ee.at[i] = ee, s.inv_ee.at[i] = inv_ee, s.b2.at[i] = b2, s.mm.at[i] = mm, s.low.at[i] = low;
    const double inner = rises > 0.0 ? 0.0 : first;
    const double going = first > low ? more : 0.0;
    s.u.at[i] = falls > 0.0 ? 1.0 : inner;
    s.back.at[i] = behind;
    s.open.at[i] = falls + rises > 0.0 ? 0.0 : going;
    c.hard.at[i] = odd;
  }
}

/// One further round for the lanes whose search is open.
inline void search_round(const CircleLanes& c, SearchLanes& s, int count) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double u = s.u.at[i];
    const HalfSlope h = lane_slope(c.radius.at[i], s.b2.at[i], s.ee.at[i], s.inv_ee.at[i], s.mm.at[i],
                                   s.v.at[i], s.n0.at[i], s.dn.at[i], u);
    double more;
    const double low = s.low.at[i], open = s.open.at[i];
    const double stepped = lane_round(h, u, low, more);
    const double over = h.h > 0.0 ? low : u;  // past the lowest h: no root if it is positive
    const double next = h.dh > 0.0 ? stepped : over;
    const double going = h.dh > 0.0 ? more : 0.0;
    s.u.at[i] = open > 0.0 ? next : u;
    s.open.at[i] = next > low ? open * going : 0.0;
  }
}

inline bool any_open(const SearchLanes& s, int count) {
  double open = 0;  // whole numbers: their order does not matter
#pragma omp simd reduction(+ : open)
  for (int i = 0; i < count; ++i) open += s.open.at[i];
  return open > 0.0;
}

/// The points at the parameter found, as segment_point_circle.
inline void finish_search(CircleLanes& c, const SearchLanes& s, int count) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double found = s.u.at[i] < 1.0 ? s.u.at[i] : 1.0;
    const double t = s.back.at[i] > 0.0 ? 1.0 - found : found;
    const double nx = c.normal.x[i], ny = c.normal.y[i], nz = c.normal.z[i];
    const double mx = c.along.x[i], my = c.along.y[i], mz = c.along.z[i];
    const double ax = c.start.x[i], ay = c.start.y[i], az = c.start.z[i];
    const double px = ax + t * mx, py = ay + t * my, pz = az + t * mz;
    const double axial = nx * px + ny * py + nz * pz;
    const double wx = px - axial * nx, wy = py - axial * ny, wz = pz - axial * nz;
    const double rough = wx * wx + wy * wy + wz * wz;
    const double again = rough < 0.1 * axial * axial ? nx * wx + ny * wy + nz * wz : 0.0;
    const double x = wx - again * nx, y = wy - again * ny, z = wz - again * nz;
    const double rho2 = x * x + y * y + z * z;
    const double inv = 1.0 / std::sqrt(rho2);
    const double radius = c.radius.at[i];
    const double ux = inv * x, uy = inv * y, uz = inv * z;
    const double qx = radius * ux, qy = radius * uy, qz = radius * uz;
    const double gx = px - qx, gy = py - qy, gz = pz - qz;
    c.t.at[i] = t;
    c.p.x[i] = px, c.p.y[i] = py, c.p.z[i] = pz;
    c.q.x[i] = qx, c.q.y[i] = qy, c.q.z[i] = qz;
    c.radial.x[i] = ux, c.radial.y[i] = uy, c.radial.z[i] = uz;
    c.distance.at[i] = std::sqrt(gx * gx + gy * gy + gz * gz);
    const double on_axis = rho2 <= 1e-30 * axial * axial + 1e-280 ? 1.0 : 0.0;
    c.hard.at[i] += s.open.at[i] + on_axis;
  }
}

/// Closest points of `count` segments and circles; count is filled up to a multiple of 8 by the caller.
inline void segment_circle_lanes(CircleLanes& c, int count) {
  constexpr int rounds = 3;  // seen on elements from 0.2 to 2 ring radii: two, sometimes three
  SearchLanes s;
  begin_search(c, s, count);
  for (int round = 0; round < rounds && any_open(s, count); ++round) search_round(c, s, count);
  finish_search(c, s, count);
}

}  // namespace cinch::CINCH_ISA
