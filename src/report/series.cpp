#include "report/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cinch {

double Series::at(double time) const {
  if (t.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto after = std::lower_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return v.front();
  if (after == t.end()) return v.back();
  const auto i = static_cast<std::size_t>(after - t.begin());
  const double share = (time - t[i - 1]) / (t[i] - t[i - 1]);
  return (1 - share) * v[i - 1] + share * v[i];
}

std::optional<double> Series::jump_at(double time, double slack) const {
  const auto after = std::upper_bound(t.begin(), t.end(), time + slack);
  const auto before = std::lower_bound(t.begin(), t.end(), time - slack);
  if (after == t.end() || before == t.begin()) return std::nullopt;
  return v[static_cast<std::size_t>(after - t.begin())] - v[static_cast<std::size_t>(before - t.begin()) - 1];
}

std::optional<double> Series::rises_through(double level, double from) const {
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] <= from || v[i] < level || v[i - 1] >= level) continue;
    return t[i - 1] + (t[i] - t[i - 1]) * (level - v[i - 1]) / (v[i] - v[i - 1]);
  }
  return std::nullopt;
}

Series VectorSeries::component(int axis) const {
  Series out{t, {}};
  for (const Vec3& value : v) out.v.push_back(value[axis]);
  return out;
}

Series VectorSeries::norm() const {
  Series out{t, {}};
  for (const Vec3& value : v) out.v.push_back(value.norm());
  return out;
}

std::size_t samples_between(const std::vector<double>& t, double from, double to) {
  const auto first = std::upper_bound(t.begin(), t.end(), from);
  const auto last = std::upper_bound(t.begin(), t.end(), to);
  return first < last ? static_cast<std::size_t>(last - first) : 0;
}

Series thinned(const Series& series, std::size_t most) {
  const std::size_t n = series.t.size();
  if (n <= most || most < 4) return series;
  Series out;
  const auto keep = [&](std::size_t i) {
    out.t.push_back(series.t[i]);
    out.v.push_back(series.v[i]);
  };
  const std::size_t buckets = most / 2 - 1;
  keep(0);
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t begin = 1 + b * (n - 2) / buckets, end = 1 + (b + 1) * (n - 2) / buckets;
    if (begin == end) continue;
    const auto first = series.v.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = series.v.begin() + static_cast<std::ptrdiff_t>(end);
    const auto [least, greatest] = std::minmax_element(first, last);
    const auto a = static_cast<std::size_t>(std::min(least, greatest) - series.v.begin());
    const auto c = static_cast<std::size_t>(std::max(least, greatest) - series.v.begin());
    keep(a);
    if (c != a) keep(c);
  }
  keep(n - 1);
  return out;
}

}  // namespace cinch
