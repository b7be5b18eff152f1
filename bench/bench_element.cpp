// The element update (spring, damper, reduction to nodes, integration) of one chain without contact, beside
// its yardstick: two bare loops over arrays, written for nothing but this chain. Time an element and step is
// the inverse of elements_per_second; compare the two in one run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "base/aligned.hpp"
#include "input/case_reader.hpp"
#include "plan/simulation.hpp"

namespace {

using cinch::AlignedVector;
using cinch::Index;

constexpr std::int64_t batch = 500;  // steps between two readings of the clock

void count_elements(benchmark::State& state) {
  state.counters["elements_per_second"] = benchmark::Counter(
      static_cast<double>(state.iterations() * batch * state.range(0)), benchmark::Counter::kIsRate);
}

/// ring_pull's thread with as many elements of 5 mm as asked for, taut by 1 %.
struct BareChain {
  explicit BareChain(Index elements) : count(elements) {
    for (auto* v : {&x, &y, &z, &vx, &vy, &vz}) v->assign(static_cast<std::size_t>(elements) + 1, 0.0);
    // the force on the node before the first element is zero, and so is that behind the last
    for (auto* f : {&fx, &fy, &fz}) f->assign(static_cast<std::size_t>(elements) + 2, 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1.01 * 0.005 * static_cast<double>(i);
  }

  Index count;
  AlignedVector<double> x, y, z, vx, vy, vz, fx, fy, fz;
};

// The same arithmetic as the solver's, with constants in place of arrays.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void bare_step(Index n, double* __restrict x, double* __restrict y, double* __restrict z, double* __restrict u,
               double* __restrict v, double* __restrict w, double* __restrict fx, double* __restrict fy,
               double* __restrict fz) {
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

void chain_bare(benchmark::State& state) {
  BareChain c(static_cast<Index>(state.range(0)));
  for (auto _ : state) {
    for (std::int64_t s = 0; s < batch; ++s)
      bare_step(c.count, c.x.data(), c.y.data(), c.z.data(), c.vx.data(), c.vy.data(), c.vz.data(),
                c.fx.data(), c.fy.data(), c.fz.data());
    benchmark::DoNotOptimize(c.x.data());
    benchmark::ClobberMemory();
  }
  count_elements(state);
}

void chain_step(benchmark::State& state, bool ledger) {
  const std::string elements = std::to_string(state.range(0));
  const double rest = 0.005 * static_cast<double>(state.range(0));
  const std::string length = std::to_string(rest), laid = std::to_string(1.01 * rest);
  cinch::Simulation simulation(
      cinch::parse_case("schema = 1\n[time]\nend_s = 100\nstep_s = 1e-6\n[output]\nledger = " +
                            std::string(ledger ? "true" : "false") +
                            "\n[material.m]\nyoungs_modulus_Pa = 1e9\ndensity_kg_m3 = 970\n"
                            "[thread.main]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = " +
                            elements + "\npoints_m = [[0, 0, 0], [" + laid +
                            ", 0, 0]]\nlength_m = " + length + "\n",
                        "chain.toml"),
      1);
  for (auto _ : state) simulation.advance_to(simulation.step() + batch);
  count_elements(state);
}

void chain(benchmark::State& state) { chain_step(state, false); }
void chain_with_ledger(benchmark::State& state) { chain_step(state, true); }

BENCHMARK(chain_bare)->Arg(200)->Arg(2000)->UseRealTime();
BENCHMARK(chain)->Arg(200)->Arg(2000)->UseRealTime();
BENCHMARK(chain_with_ledger)->Arg(200)->Arg(2000)->UseRealTime();

}  // namespace
