#include "plan/palette.hpp"

#include <cstring>
#include <string>
#include <unordered_map>

#include "store/force_reduction.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double void_length = 1e300;  ///< rest length of a lane without element

struct Row {
  double stiffness[kernel::lanes], damping[kernel::lanes], rest_length[kernel::lanes], give[kernel::lanes];
};
static_assert(sizeof(Row) == kernel::palette_fields * kernel::lanes * sizeof(double));

Row row_of(const Model& model, const Topology& topology, const Run& run, Index group, double dt) {
  Row row;
  for (Index lane = 0; lane < kernel::lanes; ++lane) {
    const Index k = first_group_node(run) + group * kernel::lanes + lane - run.a;
    const Index e = k >= 0 && k < run.count ? topology.slot_element[at(run.slot + k)] : -1;
    row.stiffness[lane] = e >= 0 ? model.stiffness[at(e)] : 0;
    row.damping[lane] = e >= 0 ? model.damping[at(e)] : 0;
    row.rest_length[lane] = e >= 0 ? model.rest_length[at(e)] : void_length;
    row.give[lane] = e >= 0 ? element_give(model, at(e), dt) : 0;
  }
  return row;
}

}  // namespace

double element_give(const Model& model, std::size_t element, double dt) {
  return dt * dt * (mobility(model, model.end_a[element]) + mobility(model, model.end_b[element]));
}

Palette make_palette(const Model& model, const Topology& topology, double dt) {
  Palette palette;
  std::unordered_map<std::string, Index> rows;  // by their bytes
  std::string bytes(sizeof(Row), '\0');
  for (const Run& run : topology.runs)
    for (Index g = 0; g < group_count(run); ++g) {
      const Row row = row_of(model, topology, run, g, dt);
      std::memcpy(bytes.data(), &row, sizeof row);
      const auto [found, fresh] = rows.try_emplace(bytes, static_cast<Index>(rows.size()));
      if (fresh)
        for (const auto* field : {&row.stiffness, &row.damping, &row.rest_length, &row.give})
          palette.rows.insert(palette.rows.end(), std::begin(*field), std::end(*field));
      palette.of_group.push_back(found->second);
    }
  return palette;
}

}  // namespace cinch
