// One quantity of a run as points in time or place, with some numbers each; and what several such pictures
// have in common.
#pragma once
#include <vector>

namespace cinch {

using Picture = std::vector<std::vector<double>>;

Picture difference(Picture a, const Picture& b);
/// Of the first `count` pictures.
Picture mean(const std::vector<Picture>& pictures, std::size_t count);
/// Standard deviations of each number, over all pictures: at least two.
Picture deviation(const std::vector<Picture>& pictures);

/// Greatest norm of a point.
double greatest(const Picture& picture);
double root_mean_square(const Picture& picture);
/// How far points come from the first.
double extent(const Picture& picture);

}  // namespace cinch
