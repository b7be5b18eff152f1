#include "base/result.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace cinch {
namespace {

// One row for each term: the only place where their names and their order are set down.
const std::vector<std::pair<std::string, double Energies::*>>& terms() {
  static const std::vector<std::pair<std::string, double Energies::*>> table{
      {"kinetic", &Energies::kinetic},
      {"elastic", &Energies::elastic},
      {"contact", &Energies::contact},
      {"gravity", &Energies::gravity},
      {"dissipated_damper", &Energies::dissipated_damper},
      {"dissipated_contact", &Energies::dissipated_contact},
      {"work_separation", &Energies::work_separation},
      {"booked_activation", &Energies::booked_activation},
      {"booked_couple", &Energies::booked_couple},
      {"residual", &Energies::residual},
  };
  return table;
}

}  // namespace

const std::vector<std::string>& Energies::names() {
  static const std::vector<std::string> list = [] {
    std::vector<std::string> names;
    for (const auto& term : terms()) names.push_back(term.first);
    return names;
  }();
  return list;
}

std::vector<double> Energies::values() const {
  std::vector<double> list;
  for (const auto& term : terms()) list.push_back(this->*term.second);
  return list;
}

Energies Energies::from_values(const std::vector<double>& values) {
  if (values.size() != terms().size()) throw std::invalid_argument("Energies: wrong number of terms");
  Energies energies;
  for (std::size_t i = 0; i < values.size(); ++i) energies.*terms()[i].second = values[i];
  return energies;
}

std::span<const Vec3> waypoints_in(const Frame& frame, Index element) {
  const auto [first, last] =
      std::equal_range(frame.joint_element.begin(), frame.joint_element.end(), element);
  const auto before = static_cast<std::size_t>(first - frame.joint_element.begin());
  return std::span(frame.joint_waypoint).subspan(before, static_cast<std::size_t>(last - first));
}

}  // namespace cinch
