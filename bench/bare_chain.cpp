#include "bare_chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kernels/kernel_table.hpp"
#include "processor_time.hpp"

namespace cinch::bench {
namespace {

// The same arithmetic as the solver's, with constants in place of arrays.
[[gnu::always_inline]] inline void any_step(Index n, double* __restrict x, double* __restrict y,
                                            double* __restrict z, double* __restrict u, double* __restrict v,
                                            double* __restrict w, double* __restrict fx,
                                            double* __restrict fy, double* __restrict fz) {
  constexpr double k = 6.28e5, c = 0.655, l0 = 0.005, dt = 1e-6, scale = dt / 1.5e-5;
#pragma omp simd
  for (Index i = 0; i < n; ++i) {
    const double rx = x[i + 1] - x[i], ry = y[i + 1] - y[i], rz = z[i + 1] - z[i];
    const double length = std::sqrt(rx * rx + ry * ry + rz * rz), inverse = 1 / length;
    const double rate = (rx * (u[i + 1] - u[i]) + ry * (v[i + 1] - v[i]) + rz * (w[i + 1] - w[i])) * inverse;
    const double pull = k * (length - l0) + c * rate;
    const double per_length = length > l0 && pull > 0 ? pull * inverse : 0;
    fx[i + 1] = per_length * rx;
    fy[i + 1] = per_length * ry;
    fz[i + 1] = per_length * rz;
  }
#pragma omp simd
  for (Index i = 0; i <= n; ++i) {
    u[i] += scale * (fx[i + 1] - fx[i]);
    v[i] += scale * (fy[i + 1] - fy[i]);
    w[i] += scale * (fz[i + 1] - fz[i]);
    x[i] += dt * u[i];
    y[i] += dt * v[i];
    z[i] += dt * w[i];
  }
}

using Step = void(Index, double*, double*, double*, double*, double*, double*, double*, double*, double*);

void base_step(Index n, double* x, double* y, double* z, double* u, double* v, double* w, double* fx,
               double* fy, double* fz) {
  any_step(n, x, y, z, u, v, w, fx, fy, fz);
}
#ifdef CINCH_X86_ISAS
[[gnu::target("arch=x86-64-v3")]] void v3_step(Index n, double* x, double* y, double* z, double* u, double* v,
                                               double* w, double* fx, double* fy, double* fz) {
  any_step(n, x, y, z, u, v, w, fx, fy, fz);
}
[[gnu::target("arch=x86-64-v4")]] void v4_step(Index n, double* x, double* y, double* z, double* u, double* v,
                                               double* w, double* fx, double* fy, double* fz) {
  any_step(n, x, y, z, u, v, w, fx, fy, fz);
}
#endif

// That of the solver's instruction set.
Step* choose_step() {
#ifdef CINCH_X86_ISAS
  const std::string isa = kernels().isa;
  if (isa == "v4") return v4_step;
  if (isa == "v3") return v3_step;
#endif
  return base_step;
}

}  // namespace

BareChain::BareChain(std::int64_t elements) : count_(static_cast<Index>(elements)) {
  for (auto* v : {&x_, &y_, &z_, &vx_, &vy_, &vz_}) v->assign(static_cast<std::size_t>(elements) + 1, 0.0);
  // the force on the node before the first element is zero, and so is that behind the last
  for (auto* f : {&fx_, &fy_, &fz_}) f->assign(static_cast<std::size_t>(elements) + 2, 0.0);
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = 1.01 * 0.005 * static_cast<double>(i);
}

void BareChain::advance(std::int64_t steps) {
  Step* const bare_step = choose_step();
  for (std::int64_t s = 0; s < steps; ++s)
    bare_step(count_, x_.data(), y_.data(), z_.data(), vx_.data(), vy_.data(), vz_.data(), fx_.data(),
              fy_.data(), fz_.data());
}

double bare_rate(std::int64_t elements) {
  constexpr int stretches = 7;
  const std::int64_t steps = 4'000'000 / elements;  // some milliseconds
  BareChain chain(elements);
  std::array<double, stretches> seconds;
  for (double& stretch : seconds) {
    const double begin = thread_seconds();
    chain.advance(steps);
    stretch = thread_seconds() - begin;
  }
  std::nth_element(seconds.begin(), seconds.begin() + stretches / 2, seconds.end());
  return static_cast<double>(elements * steps) / seconds[stretches / 2];
}

}  // namespace cinch::bench
