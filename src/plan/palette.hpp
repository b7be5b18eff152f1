// What the kernels know of elements in groups: most groups have the same, which is kept once.
#pragma once
#include <vector>

#include "base/aligned.hpp"
#include "store/model.hpp"

namespace cinch {

/// g of axial_law.hpp for an element, m/N: dt^2 (1/m_a + 1/m_b).
double element_give(const Model& model, std::size_t element, double dt);

struct Palette {
  AlignedVector<double> rows;   ///< row x (k, c, l0, g) x lanes: see kernel::AxialArguments
  std::vector<Index> of_group;  ///< group, in the order of the runs: its row
};

/// Of the runs of a topology, for steps of dt. Lanes without element are never taut.
Palette make_palette(const Model& model, const Topology& topology, double dt);

}  // namespace cinch
