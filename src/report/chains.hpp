// The elements of a result strung together again: rows and columns of a net, threads. Lines are drawn along
// them.
#pragma once
#include <vector>

#include "base/result.hpp"

namespace cinch {

/// Elements of one part, end to end and as straight as the part allows.
struct Chain {
  int part = 0;
  std::vector<Index> nodes;  ///< elements.size() + 1
  std::vector<Index> elements;
};

/// Every element in exactly one chain; `position` decides which way is straight on at a knot.
std::vector<Chain> element_chains(const ResultModel& model, const std::vector<Vec3>& position);

/// An evenly chosen part of the chains, of each part alike, with at most about `most_elements` elements.
std::vector<Chain> chosen_chains(const std::vector<Chain>& chains, std::size_t most_elements);

/// Four levels of an element: 0 slack, 1 below a tenth of the reference, 2 below it, 3 above.
int tension_level(double tension, double reference);

/// A reference for tension_level: the median of the frames' greatest tensions, rounded to 1, 2 or 5 times a
/// power of ten; 1 N where nothing is ever taut.
double tension_reference(std::vector<double> greatest);

}  // namespace cinch
