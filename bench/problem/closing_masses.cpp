#include "closing_masses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/mouth.hpp"

namespace cinch::study {
namespace {

constexpr std::size_t masses = 8, places = 1, velocities = places + 3 * masses;
constexpr std::size_t force = velocities + 3 * masses;
constexpr double separation = 2 * std::numbers::sqrt2;  // m/s, that closing gives each mass

struct Apart {
  double mean_square = 0, greatest = 0;  // m^2/s^2, m/s
};

Apart velocities_apart(const Track& found, const Track& reference, double closing_time) {
  Apart apart;
  double sum = 0, count = 0;
  for (std::size_t s = 0; s < found.samples.size(); ++s) {
    if (found.times[s] < closing_time + 1e-3) continue;  // a sample at that time may lie on either side
    for (std::size_t m = 0; m < masses; ++m) {
      const std::size_t first = velocities + 3 * m;
      const double here = distance(found.samples[s], reference.samples[s], first, first + 3);
      sum += here * here, count += 1;
      apart.greatest = std::max(apart.greatest, here);
    }
  }
  if (count > 0) apart.mean_square = sum / count;
  return apart;
}

}  // namespace

const char* const measure_of_closing =
    "greatest difference of the mouth's area, of the open one, or of the place of any of the eight split "
    "masses, of the net's side";

std::vector<double> sample_of_closing(Simulation& sim, const Look& now) {
  std::vector<double> found{mouth_area(now.ring_centers())};
  std::vector<Index> nodes;
  for (const char* name : {"m1.a", "m1.b", "m2.a", "m2.b", "m3.a", "m3.b", "m4.a", "m4.b"})
    nodes.push_back(now.assembly().node_of(std::string("mechanism.") + name));
  for (const Index node : nodes) append(found, now.position(node));
  for (const Index node : nodes) append(found, now.velocity(node));
  found.push_back(peak_ring_force(sim));
  return found;
}

Errors errors_of_closing(const Track& found, const Track& reference, double closing_time) {
  const double area = greatest(found, reference, 0, 1);  // the net is 1 m wide, its mouth 1 m^2
  double path = 0;
  for (std::size_t m = 0; m < masses; ++m)
    path = std::max(path, greatest(found, reference, places + 3 * m, places + 3 * m + 3));
  const Apart velocity = velocities_apart(found, reference, closing_time);
  const double now = found.samples.back()[force], right = reference.samples.back()[force];
  return Errors{{"error", std::max(area, path)},
                {"mouth_area", area},
                {"split_mass_path", path},
                {"first_mass_path", greatest(found, reference, places, places + 3)},
                {"split_mass_velocity", std::sqrt(velocity.mean_square) / separation},
                {"split_mass_velocity_greatest", velocity.greatest / separation},
                {"ring_force", std::abs(now / right - 1)}};
}

}  // namespace cinch::study
