// What the kernels know of elements in groups: most groups have the same, which is kept once.
#pragma once
#include <vector>

#include "base/aligned.hpp"
#include "store/model.hpp"

namespace cinch {

/// g of axial_law.hpp for the elements of a model, m/N: dt^2 (1/m_a + 1/m_b). A fixed end counts as
/// infinitely heavy. The model must live as long.
class ElementGive {
 public:
  ElementGive(const Model& model, double dt) : model_(&model), dt_(dt), inverse_mass_(mobility(model)) {}
  std::size_t memory() const;  ///< bytes, see memory.hpp
  double operator()(std::size_t element) const {
    return dt_ * dt_ * (end(model_->end_a[element]) + end(model_->end_b[element]));
  }

 private:
  double end(Index node) const { return inverse_mass_[static_cast<std::size_t>(node)]; }
  const Model* model_;
  double dt_;
  std::vector<double> inverse_mass_;
};

struct Palette {
  AlignedVector<double> rows;   ///< row x (k, c, l0, g) x lanes: see kernel::AxialArguments
  std::vector<Index> of_group;  ///< group, in the order of the runs: its row
};

/// Of the runs of a topology. Lanes without element are never taut.
Palette make_palette(const Model& model, const Topology& topology, const ElementGive& give);

}  // namespace cinch
