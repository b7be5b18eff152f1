// How each number of the paper is measured in a result. A number that a result cannot give comes back empty
// with a note that says what is missing. What the paper tells of the end of its runs is measured at that
// time: a run that has not come so far decides nothing, a longer one tells the same. Nor does one decide that
// has no samples where a number is measured.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/digest.hpp"

namespace cinch {

struct Measured {
  std::optional<double> value;
  std::string note;
  bool late = false;  ///< no value, as what is waited for has not come by the end of the run
};

namespace measure {

using Results = std::vector<const Digest*>;

Measured missing(const std::string& what);
bool reaches(const Digest& d, double time);
Measured past_the_end(const Digest& d, double time);  ///< why a number of this time is missing
Measured too_few(double from, double to);             ///< samples of this time: why a number is missing

/// Samples further than this from a time tell nothing of it, s: more than a frame of the cases.
inline constexpr double sample_reach = 0.025;
/// Whether samples at these times tell what was at `time`: one then, or one near on each side.
bool told(const Digest& d, const std::vector<double>& t, double time);

/// The greatest contact force on a ring up to a time.
struct Peak {
  double force = 0, time = -1;  ///< N, s; -1: never touched
  std::string source;           ///< of samples that may have missed it; empty: it is that of every step
};
/// Absent where nothing of the ring was recorded.
std::optional<Peak> peak_force(const Digest& d, int ring, double until);

// 5.1, thread pulling a ring, until 1 s
Measured ball_ahead_of_ring(const Digest& d);          ///< m, along Y at the end
Measured ring_end_speed(const Digest& d);              ///< m/s, mean along Y over the last tenth
Measured peak_ring_force(const Digest& d);             ///< N, of all rings
Measured greatest_force_rise(const Results& results);  ///< N, from one element number to the next
Measured curves_apart(const Results& results, int fewer, int more);  ///< m, largest difference of ring Y
/// m: ring Y at the end, less that of the result with `reference` elements.
Measured beyond(const Digest& d, const Results& results, int reference);
Measured ring_at(const Digest& d, int ring, int axis, double time);  ///< m
Measured mass_at(const Digest& d, int mass, int axis, double time);  ///< m

// 5.2, one-edge closure
Measured start_speed(const Digest& d);                    ///< m/s, greatest of all nodes
Measured spread_at(const Digest& d, double time);         ///< m, greatest distance of ring centres
Measured left_above_right(const Digest& d, double time);  ///< m, against gravity
/// Numbers of the mass on the short (paper: left) and on the long side; empty unless there are two.
std::optional<std::array<int, 2>> left_and_right(const Digest& d);

/// Closing times less than this apart are the same, s.
inline constexpr double same_closing_time = 0.005;

// 5.3, net closure, until 0.5 s after the closing time; times are counted from there where the name says
// "after"
Measured first_touch(const Digest& d);                ///< s
Measured closed_after(const Digest& d);               ///< s
Measured enclosed(const Digest& d);                   ///< 1 or 0
Measured separation_jump(const Digest& d, int axis);  ///< m/s, mechanism 1's masses
Measured share_lost(const Digest& d, int axis);       ///< of A1's velocity within 0.1 s
Measured y_change_over_x(const Digest& d);       ///< A1: change of Y velocity over that of X within 0.1 s
Measured turns_positive_after(const Digest& d);  ///< s, A1's X velocity
Measured mirror_departure(const Digest& d);      ///< m/s
Measured first_collision_time(const Digest& d, const std::string& ring);   ///< s after the closing time
Measured first_collision_force(const Digest& d, const std::string& ring);  ///< N
Measured peak_force_time(const Digest& d, const std::string& ring);        ///< s after the closing time
Measured least_gain_along_z(const Results& results);                       ///< m, of means over closing times

/// Numbers of mechanism 1's split masses a and b; empty when the result has none.
std::optional<std::array<int, 2>> split_masses(const Digest& d);

}  // namespace measure
}  // namespace cinch
