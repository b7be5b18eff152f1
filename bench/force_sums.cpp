#include "force_sums.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace cinch::bench {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr double mesh = 0.1, k = 3e-5, c = 1e-6, dt = 1e-6, scale = dt / 6e-4;
constexpr int stretch_count = 16;  // whatever the number of threads, for the bits

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define CINCH_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CINCH_CLONES
#endif

using Net = SummedNet::Net;

struct Pull {
  double x, y, z;
};

// T = k s + c dl/dt along the element, where it is taut and that pulls.
[[gnu::always_inline]] inline Pull pull_of(const Net& n, Index e) {
  const Index i = n.a[e], j = n.b[e];
  const double rx = n.x[j] - n.x[i], ry = n.y[j] - n.y[i], rz = n.z[j] - n.z[i];
  const double length = std::sqrt(rx * rx + ry * ry + rz * rz), inverse = 1 / length;
  const double rate = (rx * (n.u[j] - n.u[i]) + ry * (n.v[j] - n.v[i]) + rz * (n.w[j] - n.w[i])) * inverse;
  const double tension = k * (length - mesh) + c * rate;
  const double per_length = length > mesh && tension > 0 ? tension * inverse : 0;
  return {per_length * rx, per_length * ry, per_length * rz};
}

CINCH_CLONES void write_pulls(Net n, Index begin, Index end, double* __restrict fx, double* __restrict fy,
                              double* __restrict fz) {
#pragma omp simd
  for (Index e = begin; e < end; ++e) {
    const Pull f = pull_of(n, e);
    fx[e] = f.x, fy[e] = f.y, fz[e] = f.z;
  }
}

// Of one colour: no two elements write one node.
CINCH_CLONES void scatter_colour(Net n, Index begin, Index end, double* __restrict fx, double* __restrict fy,
                                 double* __restrict fz) {
#pragma omp simd
  for (Index e = begin; e < end; ++e) {
    const Pull f = pull_of(n, e);
    const Index i = n.a[e], j = n.b[e];
    fx[i] += f.x, fy[i] += f.y, fz[i] += f.z;
    fx[j] -= f.x, fy[j] -= f.y, fz[j] -= f.z;
  }
}

// One element after the other: neighbours share nodes.
void add_pulls(const Net& n, Index begin, Index end, Index first_node, double* __restrict fx,
               double* __restrict fy, double* __restrict fz) {
  for (Index e = begin; e < end; ++e) {
    const Pull f = pull_of(n, e);
    const Index i = n.a[e] - first_node, j = n.b[e] - first_node;
    fx[i] += f.x, fy[i] += f.y, fz[i] += f.z;
    fx[j] -= f.x, fy[j] -= f.y, fz[j] -= f.z;
  }
}

CINCH_CLONES void move_along(Index begin, Index end, double* __restrict x, double* __restrict v,
                             double* __restrict f) {
#pragma omp simd
  for (Index i = begin; i < end; ++i) {
    v[i] += scale * f[i];
    x[i] += dt * v[i];
    f[i] = 0;
  }
}

Index part_of(Index size, int thread, int threads) {
  return static_cast<Index>(static_cast<std::int64_t>(size) * thread / threads);
}

}  // namespace

SummedNet::SummedNet(std::int64_t knots, SumWay way, int threads) : way_(way), threads_(threads) {
  const auto side = static_cast<Index>(knots);
  for (auto* field : {&place_, &speed_, &force_})
    for (auto& axis : *field) axis.assign(at(side * side), 0.0);
  std::vector<Index> colour;
  for (Index row = 0; row < side; ++row)
    for (Index column = 0; column < side; ++column) {
      const Index node = row * side + column;
      place_[0][at(node)] = 1.001 * mesh * column, place_[1][at(node)] = 1.001 * mesh * row;
      if (column + 1 < side) add_element(node, node + 1), colour.push_back(column % 2);
      if (row + 1 < side) add_element(node, node + side), colour.push_back(2 + row % 2);
    }
  if (way == SumWay::coloured_scatter) sort_by_colour(colour);
  if (way == SumWay::private_sums) cut_stretches();
  if (way == SumWay::gather) list_elements_of_nodes();
}

void SummedNet::add_element(Index a, Index b) {
  end_a_.push_back(a);
  end_b_.push_back(b);
}

void SummedNet::sort_by_colour(const std::vector<Index>& colour) {
  const std::vector<Index> a = std::move(end_a_), b = std::move(end_b_);
  end_a_.clear(), end_b_.clear();
  colour_begin_ = {0};
  for (Index wanted = 0; wanted < 4; ++wanted) {
    for (std::size_t e = 0; e < a.size(); ++e)
      if (colour[e] == wanted) add_element(a[e], b[e]);
    colour_begin_.push_back(elements());
  }
}

void SummedNet::list_elements_of_nodes() {
  for (auto& axis : pull_) axis.assign(at(elements()), 0.0);
  std::vector<std::vector<Index>> of_node(at(nodes()));
  for (Index e = 0; e < elements(); ++e) {
    of_node[at(end_a_[at(e)])].push_back(e);
    of_node[at(end_b_[at(e)])].push_back(-1 - e);
  }
  of_node_begin_ = {0};
  for (const std::vector<Index>& here : of_node) {
    of_node_.insert(of_node_.end(), here.begin(), here.end());
    of_node_begin_.push_back(static_cast<Index>(of_node_.size()));
  }
}

void SummedNet::cut_stretches() {
  for (int s = 0; s < stretch_count; ++s) {
    Stretch stretch{
        part_of(elements(), s, stretch_count), part_of(elements(), s + 1, stretch_count), 0, 0, {}};
    const auto first = end_a_.begin() + stretch.begin, last_a = end_a_.begin() + stretch.end,
               first_b = end_b_.begin() + stretch.begin, last_b = end_b_.begin() + stretch.end;
    stretch.first_node = *std::min_element(first, last_a);
    stretch.last_node = *std::max_element(first_b, last_b) + 1;
    for (auto& axis : stretch.force) axis.assign(at(stretch.last_node - stretch.first_node), 0.0);
    stretches_.push_back(std::move(stretch));
  }
}

void SummedNet::move(Index begin, Index end) {
  for (int d = 0; d < 3; ++d) move_along(begin, end, place_[d].data(), speed_[d].data(), force_[d].data());
}

SummedNet::Net SummedNet::net() const {
  return {place_[0].data(), place_[1].data(), place_[2].data(), speed_[0].data(),
          speed_[1].data(), speed_[2].data(), end_a_.data(),    end_b_.data()};
}

void SummedNet::gather(int thread) {
  write_pulls(net(), part_of(elements(), thread, threads_), part_of(elements(), thread + 1, threads_),
              pull_[0].data(), pull_[1].data(), pull_[2].data());
#pragma omp barrier
  const Index begin = part_of(nodes(), thread, threads_), end = part_of(nodes(), thread + 1, threads_);
  for (Index i = begin; i < end; ++i)
    for (Index k_th = of_node_begin_[at(i)]; k_th < of_node_begin_[at(i + 1)]; ++k_th) {
      const Index item = of_node_[at(k_th)];
      const auto e = at(item < 0 ? -1 - item : item);
      for (int d = 0; d < 3; ++d) force_[d][at(i)] += item < 0 ? -pull_[d][e] : pull_[d][e];
    }
  move(begin, end);
}

void SummedNet::scatter(int thread) {
  for (std::size_t colour = 0; colour + 1 < colour_begin_.size(); ++colour) {
    const Index first = colour_begin_[colour], count = colour_begin_[colour + 1] - first;
    scatter_colour(net(), first + part_of(count, thread, threads_),
                   first + part_of(count, thread + 1, threads_), force_[0].data(), force_[1].data(),
                   force_[2].data());
#pragma omp barrier
  }
  move(part_of(nodes(), thread, threads_), part_of(nodes(), thread + 1, threads_));
}

void SummedNet::sum_privately(int thread) {
  for (Index s = part_of(stretch_count, thread, threads_); s < part_of(stretch_count, thread + 1, threads_);
       ++s) {
    Stretch& own = stretches_[at(s)];
    for (auto& axis : own.force) std::fill(axis.begin(), axis.end(), 0.0);
    add_pulls(net(), own.begin, own.end, own.first_node, own.force[0].data(), own.force[1].data(),
              own.force[2].data());
  }
#pragma omp barrier
  const Index begin = part_of(nodes(), thread, threads_), end = part_of(nodes(), thread + 1, threads_);
  for (const Stretch& stretch : stretches_)
    for (Index i = std::max(begin, stretch.first_node); i < std::min(end, stretch.last_node); ++i)
      for (int d = 0; d < 3; ++d) force_[d][at(i)] += stretch.force[d][at(i - stretch.first_node)];
  move(begin, end);
}

void SummedNet::step(int thread) {
  switch (way_) {
    case SumWay::gather:
      return gather(thread);
    case SumWay::coloured_scatter:
      return scatter(thread);
    case SumWay::private_sums:
      return sum_privately(thread);
  }
}

void SummedNet::advance(std::int64_t steps) {
#pragma omp parallel num_threads(threads_)
  for (std::int64_t s = 0; s < steps; ++s) {
    step(omp_get_thread_num());
#pragma omp barrier
  }
}

}  // namespace cinch::bench
