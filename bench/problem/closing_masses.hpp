// What problems in which a net closes compare: its mouth, the eight split masses, the rings' peak force.
#pragma once
#include "common.hpp"

namespace cinch::study {

/// Mouth's area, places and velocities of the split masses, peak force; m^2, m, m/s, N.
std::vector<double> sample_of_closing(Simulation& sim, const Look& now);
inline constexpr std::size_t closing_numbers = 1 + 8 * 3 + 8 * 3 + 1;  ///< in such a sample

/// Errors of tracks whose samples begin so. Velocities count after `closing_time`, s.
Errors errors_of_closing(const Track& found, const Track& reference, double closing_time);

/// The first of these errors in words.
extern const char* const measure_of_closing;

}  // namespace cinch::study
