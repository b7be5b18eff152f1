#include "study/picture.hpp"

#include <algorithm>
#include <cmath>

namespace cinch {
namespace {

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

// Calls visit(p, i) for each number of a picture.
template <class Visit>
void for_each_number(const Picture& picture, Visit visit) {
  for (std::size_t p = 0; p < picture.size(); ++p)
    for (std::size_t i = 0; i < picture[p].size(); ++i) visit(p, i);
}

}  // namespace

Picture difference(Picture a, const Picture& b) {
  for_each_number(b, [&](std::size_t p, std::size_t i) { a[p][i] -= b[p][i]; });
  return a;
}

Picture mean(const std::vector<Picture>& pictures, std::size_t count) {
  Picture sum = pictures.front();
  for (std::size_t k = 1; k < count; ++k)
    for_each_number(sum, [&](std::size_t p, std::size_t i) { sum[p][i] += pictures[k][p][i]; });
  for_each_number(sum, [&](std::size_t p, std::size_t i) { sum[p][i] /= static_cast<double>(count); });
  return sum;
}

Picture deviation(const std::vector<Picture>& pictures) {
  const Picture middle = mean(pictures, pictures.size());
  Picture out = difference(middle, middle);
  for (const Picture& picture : pictures)
    for_each_number(out, [&](std::size_t p, std::size_t i) {
      const double off = picture[p][i] - middle[p][i];
      out[p][i] += off * off;
    });
  const double freedom = static_cast<double>(pictures.size()) - 1;
  for_each_number(out, [&](std::size_t p, std::size_t i) { out[p][i] = std::sqrt(out[p][i] / freedom); });
  return out;
}

double greatest(const Picture& picture) {
  double most = 0;
  for (const std::vector<double>& point : picture) most = std::max(most, norm(point));
  return most;
}

double root_mean_square(const Picture& picture) {
  double sum = 0;
  for (const std::vector<double>& point : picture) sum += norm(point) * norm(point);
  return std::sqrt(sum / static_cast<double>(picture.size()));
}

double extent(const Picture& picture) {
  return greatest(difference(picture, Picture(picture.size(), picture.front())));
}

}  // namespace cinch
