// Segment-circle distance: the exact method against a dense search, the paper's golden section and closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "kernels/segment_circle.hpp"

namespace {

using cinch::CINCH_ISA::CirclePoint;
using cinch::CINCH_ISA::cross;
using cinch::CINCH_ISA::dot;
using cinch::CINCH_ISA::norm;
using cinch::CINCH_ISA::point_circle;
using cinch::CINCH_ISA::segment_circle_exact;
using cinch::CINCH_ISA::segment_circle_golden;
using cinch::CINCH_ISA::segment_circle_lower_bound;
using cinch::CINCH_ISA::V3;

constexpr double eps = std::numeric_limits<double>::epsilon();

struct Trial {
  V3 a1, a2, center, normal;
  double radius;
};

CirclePoint exact(const Trial& s) { return segment_circle_exact(s.a1, s.a2, s.center, s.normal, s.radius); }
CirclePoint golden(const Trial& s) { return segment_circle_golden(s.a1, s.a2, s.center, s.normal, s.radius); }

// ---- random segments

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  int integer(int lo, int hi) {
    return lo + static_cast<int>(engine_() % static_cast<std::uint64_t>(hi - lo + 1));
  }
  double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
  V3 box(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  V3 direction() {
    for (;;) {
      const V3 v = box(1.0);
      const double length = norm(v);
      if (length > 0.1 && length < 1.0) return 1.0 / length * v;
    }
  }
  V3 normal_to(V3 n) {
    const V3 v = cross(n, direction());
    return norm(v) > 0.1 ? 1.0 / norm(v) * v : normal_to(n);
  }

 private:
  std::mt19937_64 engine_;
};

/// One of eight families in turn: ordinary elements and the ways in which a segment can be degenerate.
Trial make_trial(Dice& dice, int family) {
  const V3 c = dice.box(0.5);
  const V3 n = dice.direction();
  const V3 x = dice.normal_to(n);
  const V3 y = cross(n, x);
  const double r = dice.log_uniform(0.005, 0.5);
  const double length = r * dice.log_uniform(1e-2, 10.0);
  switch (family) {
    case 0: {  // the usual case: 5 mm beside a ring of 20 mm
      const V3 mid = c + dice.box(0.03);
      const V3 half = 0.0025 * dice.direction();
      return {mid - half, mid + half, c, n, 0.02};
    }
    case 1: {  // anything
      const V3 a = c + dice.box(2.0 * r);
      return {a, a + length * dice.direction(), c, n, r};
    }
    case 2: {  // in the ring's plane
      const V3 a = c + dice.uniform(-2.0, 2.0) * r * x;
      const V3 b = a + dice.uniform(-2.0, 2.0) * r * y;
      return {b, b + length * dice.normal_to(n), c, n, r};
    }
    case 3: {  // through the axis, or through the centre
      const V3 foot = c + (dice.integer(0, 1) ? dice.uniform(-2.0, 2.0) * r : 0.0) * n;
      const V3 d = length * dice.direction();
      const double share = dice.integer(0, 3) ? dice.uniform(0.0, 1.0) : dice.integer(0, 1);
      return {foot - share * d, foot + (1.0 - share) * d, c, n, r};
    }
    case 4: {  // parallel to the axis, exactly or nearly
      const double aside = dice.integer(0, 2);
      const V3 foot = c + aside * dice.uniform(0.0, r) * x;
      const V3 a = foot + dice.uniform(-2.0, 2.0) * r * n;
      const double tilt = dice.integer(0, 3) ? dice.log_uniform(1e-18, 1e-2) : 0.0;
      return {a, a + length * (n + tilt * dice.direction()), c, n, r};
    }
    case 5: {  // a lattice of spacing r/2, a tie at every turn
      const auto lattice = [&] {
        return V3{0.5 * r * dice.integer(-4, 4), 0.5 * r * dice.integer(-4, 4),
                  0.5 * r * dice.integer(-2, 2)};
      };
      return {lattice(), lattice(), {0, 0, 0}, {0, 0, 1}, r};
    }
    case 6: {  // touching the wire; every other time tangent to it
      const V3 q = c + r * x;
      const V3 d = length * (dice.integer(0, 1) ? y : dice.direction());
      const double share = dice.uniform(0.0, 1.0);
      return {q - share * d, q + (1.0 - share) * d, c, n, r};
    }
    default: {  // short, down to nothing
      const V3 a = c + dice.box(2.0 * r);
      const double size = dice.integer(0, 3) ? r * dice.log_uniform(1e-20, 1e-2) : 0.0;
      return {a, a + size * dice.direction(), c, n, r};
    }
  }
}

// ---- dense reference

template <class Real>
struct Sample {
  Real distance, slope;  // slope = M.(P - Q)
};

/// Straight from the geometry, the axial part and the part in the ring's plane apart.
template <class Real>
Sample<Real> sample(const Trial& s, Real t) {
  const Real nx = s.normal.x, ny = s.normal.y, nz = s.normal.z, r = s.radius;
  const Real mx = Real(s.a2.x) - s.a1.x, my = Real(s.a2.y) - s.a1.y, mz = Real(s.a2.z) - s.a1.z;
  const Real dx = Real(s.a1.x) - s.center.x + t * mx;
  const Real dy = Real(s.a1.y) - s.center.y + t * my;
  const Real dz = Real(s.a1.z) - s.center.z + t * mz;
  const Real axial = nx * dx + ny * dy + nz * dz, climb = nx * mx + ny * my + nz * mz;
  const Real wx = dx - axial * nx, wy = dy - axial * ny, wz = dz - axial * nz;
  const Real ex = mx - climb * nx, ey = my - climb * ny, ez = mz - climb * nz;
  const Real rho = std::sqrt(wx * wx + wy * wy + wz * wz);
  const Real pull = rho > 0 ? 1 - r / rho : 0;
  return {std::sqrt((rho - r) * (rho - r) + axial * axial),
          axial * climb + pull * (wx * ex + wy * ey + wz * ez)};
}

/// Distance at the root of the slope between a and b, by bisection in extended precision.
double bisect(const Trial& s, double a, double b) {
  long double x = a, y = b;
  for (int k = 0; k < 48; ++k) {
    const long double mid = 0.5L * (x + y);
    (sample(s, mid).slope < 0 ? x : y) = mid;
  }
  return static_cast<double>(sample(s, 0.5L * (x + y)).distance);
}

/// Least distance on [lo, hi] by sampling, and by bisection wherever the slope turns from falling to rising.
/// A dip may hide between two samples: where the distance, which changes no faster than the way along the
/// segment, could still pass below the best of all samples, the interval is searched on a finer grid.
double search(const Trial& s, double lo, double hi, double best, bool finer) {
  constexpr int parts = 12;
  Sample<double> at[parts + 1];
  const auto place = [&](int i) { return lo + (hi - lo) * i / parts; };
  for (int i = 0; i <= parts; ++i) {
    at[i] = sample(s, place(i));
    best = std::min(best, at[i].distance);
  }
  const double way = norm(s.a2 - s.a1) * (hi - lo) / parts;
  for (int i = 0; i < parts; ++i) {
    if (0.5 * (at[i].distance + at[i + 1].distance - way) > best) continue;
    const double a = place(i), b = place(i + 1);
    if (finer) {
      best = search(s, a, b, best, false);
    } else if (at[i].slope < 0.0 && at[i + 1].slope > 0.0) {
      best = std::min(best, bisect(s, a, b));
    }
  }
  return best;
}

/// Least distance on the segment. The crest of the distance where the segment passes the axis may be as sharp
/// as an edge and hide a dip beside it: the two sides are searched apart.
double dense(const Trial& s) {
  const V3 m = cross(s.normal, s.a2 - s.a1), d = cross(s.normal, s.a1 - s.center);
  const double crest = dot(m, m) > 0.0 ? -dot(d, m) / dot(m, m) : 0.5;
  const double below = std::clamp(crest - 1e-9, 0.0, 1.0), above = std::clamp(crest + 1e-9, 0.0, 1.0);
  double best = std::min(sample(s, 0.0).distance, sample(s, 1.0).distance);
  if (sample(s, below).slope < 0.0 && sample(s, above).slope > 0.0)
    best = std::min(best, bisect(s, below, above));
  if (below > 0.0) best = search(s, 0.0, below, best, true);
  if (above < 1.0) best = search(s, above, 1.0, best, true);
  return best;
}

/// h(t) in units of its own rounding error, which grows near the axis, where the direction to the wire turns
/// quickly.
double stationarity(const Trial& s, double t) {
  const V3 m = s.a2 - s.a1;
  const double size = norm(m) + norm(s.a1 - s.center) + norm(s.center) + s.radius;
  const double rho = norm(cross(s.normal, s.a1 - s.center + t * m));
  const double turn = norm(cross(s.normal, m)) * s.radius / rho;
  return std::fabs(sample(s, t).slope) / (eps * size * (norm(m) + turn));
}

/// What every answer must satisfy, whichever t it found: worst violation in units of its own rounding error.
double inconsistency(const Trial& s, const CirclePoint& c) {
  const double size = norm(s.a1) + norm(s.a2) + norm(s.center) + s.radius;
  double worst = std::fabs(norm(c.radial) - 1.0) / eps;
  worst = std::max(worst, std::fabs(dot(c.radial, s.normal)) / eps);
  worst = std::max(worst, norm(c.p - (s.a1 + c.t * (s.a2 - s.a1))) / (eps * size));
  worst = std::max(worst, norm(c.q - (s.center + s.radius * c.radial)) / (eps * size));
  worst = std::max(worst, std::fabs(c.distance - norm(c.p - c.q)) / (eps * size));
  worst = std::max(worst, std::fabs(c.distance - sample(s, c.t).distance) / (eps * size));
  const bool inside = c.t >= 0.0 && c.t <= 1.0;  // false for a NaN, too
  return inside && worst == worst ? worst : std::numeric_limits<double>::infinity();
}

// ---- a million segments

TEST(SegmentCircle, MillionSegmentsAgainstDenseSearch) {
  Dice dice(20210827);
  double worst_error[8] = {}, worst_h = 0.0, worst_inside = 0.0, worst_golden = 0.0, worst_bound = 0.0;
  for (int i = 0; i < 1000000; ++i) {
    const Trial s = make_trial(dice, i % 8);
    const CirclePoint c = exact(s);
    double& error = worst_error[i % 8];
    error = std::max(error, std::fabs(c.distance - dense(s)));
    worst_inside = std::max(worst_inside, inconsistency(s, c));
    if (c.t > 1e-12 && c.t < 1.0 - 1e-12) worst_h = std::max(worst_h, stationarity(s, c.t));
    worst_golden = std::max(worst_golden, c.distance - golden(s).distance);
    const double bound = segment_circle_lower_bound(s.a1, s.a2, s.center, s.normal, s.radius);
    worst_bound = std::max(worst_bound, bound - c.distance);
  }
  for (int family = 0; family < 8; ++family) {
    EXPECT_LT(worst_error[family], 1e-12) << "family " << family;
    RecordProperty("error_" + std::to_string(family), std::to_string(worst_error[family] * 1e15) + "e-15");
  }
  EXPECT_LT(worst_golden, 1e-14);  // never farther than golden section
  EXPECT_LT(worst_bound, 1e-14);
  EXPECT_LT(worst_inside, 16.0);
  EXPECT_LT(worst_h, 16.0);
  RecordProperty("h_over_rounding", std::to_string(worst_h));
  RecordProperty("inconsistency_over_rounding", std::to_string(worst_inside));
}

/// Contacts (distance below 1 mm) that a method does not see, for elements of a length beside a ring of 10
/// mm.
struct Missed {
  int contacts = 0, by_golden = 0, by_exact = 0;
};

Missed count_missed(double length) {
  Dice dice(7);
  Missed missed;
  for (int i = 0; i < 100000; ++i) {
    const V3 mid = dice.box(0.02);
    const V3 half = 0.5 * length * dice.direction();
    const Trial s{mid - half, mid + half, {0, 0, 0}, {0, 0, 1}, 0.01};
    const bool contact = dense(s) < 1e-3;
    missed.contacts += contact;
    missed.by_golden += contact && golden(s).distance >= 1e-3;
    missed.by_exact += contact && exact(s).distance >= 1e-3;
  }
  return missed;
}

TEST(SegmentCircle, GoldenSectionMissesContactsOfLongElements) {
  for (const double length : {0.005, 0.020, 0.050}) {
    const Missed missed = count_missed(length);
    const std::string key = std::to_string(static_cast<int>(1e3 * length)) + "_mm";
    RecordProperty(key, std::to_string(missed.by_golden) + " of " + std::to_string(missed.contacts));
    EXPECT_GT(missed.contacts, 1000) << key;
    EXPECT_EQ(missed.by_exact, 0) << key;
    if (length > 0.04) {
      EXPECT_GT(missed.by_golden, 0) << key;
    }
    if (length < 0.01) {
      EXPECT_LT(missed.by_golden, missed.contacts / 1000) << key;
    }
  }
}

TEST(SegmentCircle, SwappedEndsGiveTheSameDistance) {
  Dice dice(11);
  double worst = 0.0, worst_t = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const Trial s = make_trial(dice, i % 8);
    const CirclePoint c = exact(s);
    const CirclePoint d = exact({s.a2, s.a1, s.center, s.normal, s.radius});
    worst = std::max(worst, std::fabs(c.distance - d.distance));
    if (i % 8 == 0) worst_t = std::max(worst_t, std::fabs(c.t + d.t - 1.0));
  }
  EXPECT_LT(worst, 1e-14);
  EXPECT_LT(worst_t, 1e-11);
}

TEST(SegmentCircle, RigidMotionChangesNothing) {
  Dice dice(13);
  double worst = 0.0, worst_t = 0.0, worst_p = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const Trial s = make_trial(dice, i % 8);
    const V3 z = dice.direction(), x = dice.normal_to(z), y = cross(z, x), shift = dice.box(1.0);
    const auto turn = [&](V3 v) { return v.x * x + v.y * y + v.z * z; };
    const auto move = [&](V3 v) { return shift + turn(v); };
    const CirclePoint c = exact(s);
    const CirclePoint d = exact({move(s.a1), move(s.a2), move(s.center), turn(s.normal), s.radius});
    worst = std::max(worst, std::fabs(c.distance - d.distance));
    if (i % 8 != 0) continue;  // elsewhere equal minima may change places
    worst_t = std::max(worst_t, std::fabs(c.t - d.t));
    worst_p = std::max(worst_p, norm(move(c.p) - d.p));
  }
  EXPECT_LT(worst, 1e-13);
  EXPECT_LT(worst_t, 1e-10);  // 1e-16 m over a 5 mm element, where the minimum is well conditioned
  EXPECT_LT(worst_p, 1e-12);
}

TEST(SegmentCircle, ScaleChangesNothing) {
  Dice dice(17);
  for (int i = 0; i < 10000; ++i) {
    const Trial s = make_trial(dice, i % 8);
    const double k = 0x1p20;  // a power of two: not one bit may differ, but for the guards against underflow
    const CirclePoint c = exact(s), d = exact({k * s.a1, k * s.a2, k * s.center, s.normal, k * s.radius});
    ASSERT_EQ(c.t, d.t) << i;
    ASSERT_EQ(k * c.distance, d.distance) << i;
  }
}

// ---- closed forms

constexpr V3 origin{0, 0, 0}, ez{0, 0, 1};

void expect_point(V3 a, V3 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(SegmentCircle, PointBesideTheCircle) {
  const CirclePoint c = point_circle({5, 0, 4}, origin, ez, 2);
  EXPECT_EQ(c.t, 0.0);
  EXPECT_EQ(c.distance, 5.0);  // 3-4-5
  expect_point(c.q, {2, 0, 0}, 0);
  expect_point(c.radial, {1, 0, 0}, 0);
  expect_point(c.p, {5, 0, 4}, 0);
}

TEST(SegmentCircle, OnTheAxis) {
  const Trial s{{0, 0, -1}, {0, 0, 3}, origin, ez, 2};
  const CirclePoint c = exact(s);
  EXPECT_EQ(c.t, 0.25);
  EXPECT_EQ(c.distance, 2.0);
  EXPECT_LT(inconsistency(s, c), 4.0);
  EXPECT_EQ(exact({{0, 0, 1}, {0, 0, 3}, origin, ez, 2}).t, 0.0);
  EXPECT_EQ(exact({{0, 0, -3}, {0, 0, -1}, origin, ez, 2}).t, 1.0);
}

TEST(SegmentCircle, OnTheAxisTheDirectionIsFixedAndTurnsWithTheNormal) {
  const V3 ring = point_circle({0, 0, 5}, origin, ez, 1).radial;
  expect_point(ring, point_circle({0, 0, -3}, origin, ez, 1).radial, 0);
  expect_point(ring, exact({{0, 0, -1}, {0, 0, 3}, origin, ez, 2}).radial, 0);
  Dice dice(19);
  for (int i = 0; i < 10000; ++i) {
    const V3 n = dice.direction();
    const V3 tilted = n + 1e-6 * dice.direction();
    const V3 m = 1.0 / norm(tilted) * tilted;
    const V3 p = point_circle(3.0 * n, origin, n, 1).radial, q = point_circle(3.0 * m, origin, m, 1).radial;
    ASSERT_LT(std::fabs(dot(p, n)), 1e-14);
    ASSERT_NEAR(norm(p), 1.0, 1e-14);
    if (std::fabs(n.z + 0.9) > 1e-5) {
      ASSERT_LT(norm(p - q), 3e-5) << n.x << " " << n.y << " " << n.z;
    }
  }
}

TEST(SegmentCircle, NearTheAxisTheDirectionIsTheRadialOne) {
  for (const double offset : {1e-3, 1e-9, 1e-14}) {
    const Trial s{{0, offset, -1}, {0, offset, 3}, origin, ez, 2};
    const CirclePoint c = exact(s);
    expect_point(c.radial, {0, 1, 0}, 1e-15);
    EXPECT_NEAR(c.t, 0.25, 1e-15);
    EXPECT_NEAR(c.distance, 2.0 - offset, 1e-15);
  }
}

TEST(SegmentCircle, ParallelToTheAxis) {
  const CirclePoint c = exact({{3, 4, -1}, {3, 4, 3}, origin, ez, 2});
  EXPECT_EQ(c.t, 0.25);
  EXPECT_EQ(c.distance, 3.0);
  expect_point(c.q, {1.2, 1.6, 0}, 1e-15);
}

TEST(SegmentCircle, ThroughTheCentreInThePlaneHasTwoEqualMinima) {
  const CirclePoint c = exact({{-4, 0, 0}, {4, 0, 0}, origin, ez, 2});
  EXPECT_EQ(c.distance, 0.0);
  EXPECT_EQ(std::fabs(c.t - 0.5), 0.25);
}

TEST(SegmentCircle, ThroughTheCentreOneMinimumInReach) {
  const CirclePoint c =
      exact({{-4, 0, 0}, {1, 0, 0}, origin, ez, 2});  // left one inside, right one beyond the end
  EXPECT_NEAR(c.t, 0.4, eps);
  EXPECT_NEAR(c.distance, 0.0, eps);
  const CirclePoint d = exact({{-1, 0, 0}, {4, 0, 0}, origin, ez, 2});
  EXPECT_NEAR(d.t, 0.6, eps);
  const CirclePoint e = exact({{-1, 0, 0}, {1.5, 0, 0}, origin, ez, 2});  // neither: the farther end
  EXPECT_EQ(e.t, 1.0);
  EXPECT_EQ(e.distance, 0.5);
  EXPECT_EQ(exact({{-1.5, 0, 0}, {1, 0, 0}, origin, ez, 2}).t, 0.0);
}

TEST(SegmentCircle, ObliqueThroughTheCentre) {
  // rho = |s| cos, n = s sin: f = s^2 - 2 R |s| cos + R^2, lowest at |s| = R cos with the distance R sin
  const double angle = 0.3, k = std::cos(angle), z = std::sin(angle);
  const CirclePoint c = exact({{-2 * k, 0, -2 * z}, {0.5 * k, 0, 0.5 * z}, origin, ez, 1});
  EXPECT_NEAR(c.t, (2 - k) / 2.5, 4 * eps);
  EXPECT_NEAR(c.distance, z, 4 * eps);
  expect_point(c.q, {-1, 0, 0}, 4 * eps);
}

TEST(SegmentCircle, ChordInThePlane) {
  // x = 0.6 crosses the unit circle at y = -0.8 and 0.8
  const CirclePoint both = exact({{0.6, -1, 0}, {0.6, 2, 0}, origin, ez, 1});
  EXPECT_NEAR(both.distance, 0.0, 2 * eps);
  EXPECT_NEAR(std::fabs(3 * both.t - 1), 0.8, 4 * eps);
  const CirclePoint lower = exact({{0.6, -1, 0}, {0.6, 0.5, 0}, origin, ez, 1});
  EXPECT_NEAR(lower.t, 0.2 / 1.5, 2 * eps);
  const CirclePoint upper = exact({{0.6, -0.5, 0}, {0.6, 1, 0}, origin, ez, 1});
  EXPECT_NEAR(upper.t, 1.3 / 1.5, 2 * eps);
}

TEST(SegmentCircle, TangentInThePlane) {
  // f = (sqrt(1 + y^2) - 1)^2 = y^4 / 4: three roots of h in one place
  const CirclePoint c = exact({{1, -1, 0}, {1, 2, 0}, origin, ez, 1});
  EXPECT_LT(c.distance, 1e-15);
  EXPECT_NEAR(3 * c.t, 1.0, 1e-7);
}

TEST(SegmentCircle, BesideTheRingInThePlane) {
  const CirclePoint c = exact({{3, -1, 0}, {3, 3, 0}, origin, ez, 1});
  EXPECT_NEAR(c.t, 0.25, eps);
  EXPECT_NEAR(c.distance, 2.0, eps);
  expect_point(c.q, {1, 0, 0}, 2 * eps);
}

TEST(SegmentCircle, CrossingTheWire) {
  const CirclePoint c = exact({{2, 0, -0.25}, {2, 0, 0.75}, origin, ez, 2});
  EXPECT_EQ(c.t, 0.25);
  EXPECT_EQ(c.distance, 0.0);
  expect_point(c.p, c.q, 0);
  expect_point(c.q, {2, 0, 0}, 0);
  const CirclePoint end = exact({{0, 2, 0}, {0, 5, 1}, origin, ez, 2});  // touching with an end
  EXPECT_EQ(end.t, 0.0);
  EXPECT_EQ(end.distance, 0.0);
}

TEST(SegmentCircle, ZeroLength) {
  for (const V3 a : {V3{5, 0, 4}, V3{0, 0, 3}, V3{0, 2, 0}, origin}) {
    const CirclePoint c = exact({a, a, origin, ez, 2});
    const CirclePoint p = point_circle(a, origin, ez, 2);
    EXPECT_EQ(c.t, 0.0);
    EXPECT_EQ(c.distance, p.distance);
    expect_point(c.q, p.q, 0);
    EXPECT_TRUE(std::isfinite(golden({a, a, origin, ez, 2}).distance));
  }
}

TEST(SegmentCircle, EndAtTheCentre) {
  for (const V3 end : {V3{1, 0, 0}, V3{3, 0, 0}, V3{0, 0, 3}, V3{0, -1, 2}}) {
    const Trial s{origin, end, origin, ez, 2};
    const CirclePoint c = exact(s), d = exact({end, origin, origin, ez, 2});
    EXPECT_LT(inconsistency(s, c), 4.0);
    EXPECT_NEAR(c.distance, dense(s), 2 * eps);
    EXPECT_EQ(c.distance, d.distance);
  }
  EXPECT_NEAR(exact({origin, {3, 0, 0}, origin, ez, 2}).t, 2.0 / 3.0, eps);
  EXPECT_EQ(exact({origin, {0, 0, 3}, origin, ez, 2}).t, 0.0);
}

TEST(SegmentCircle, EndOnTheAxisFarAbove) {
  // leaving the axis upwards: the lowest point is the end on the axis, every direction is as good
  const Trial s{{0, 0, 3}, {1, 0, 5}, origin, ez, 2};
  const CirclePoint c = exact(s);
  EXPECT_EQ(c.t, 0.0);
  EXPECT_NEAR(c.distance, std::sqrt(13.0), 2 * eps * 4);
  EXPECT_LT(inconsistency(s, c), 4.0);
}

TEST(SegmentCircle, RadiusEntersToTheFirstPower) {
  // eq. (5) prints a3 = -2 R^2; with it the distance of a point 3 outside a ring of radius 2 would be off
  for (const double radius : {0.01, 0.5, 2.0, 20.0}) {
    const Trial s{{radius + 3, -1, 0}, {radius + 3, 1, 0}, origin, ez, radius};
    EXPECT_NEAR(exact(s).distance, 3.0, 4 * eps * radius + 4 * eps);
    EXPECT_NEAR(exact(s).t, 0.5, 1e-15);
    EXPECT_NEAR(golden(s).distance, 3.0, 1e-12);
    EXPECT_NEAR(golden(s).t, 0.5, 1e-6);
  }
}

}  // namespace
