// Each kernel on its own, on arrays that fit into the first (200) or second (2000) level of caches. Bytes are
// those that a kernel reads and writes once; what it shares with neighbours counts once.
#include <benchmark/benchmark.h>

#include "base/aligned.hpp"
#include "counters.hpp"
#include "kernels/kernel_table.hpp"

namespace cinch::bench {
namespace {

using kernel::lanes;

void count(benchmark::State& state, double bytes_per_item) {
  const double items = static_cast<double>(state.iterations() * state.range(0));
  state.counters["items_per_second"] = benchmark::Counter(items, benchmark::Counter::kIsRate);
  count_bytes(state, bytes_per_item * items);
}

/// A taut chain of whole groups, with what its kernels need; forces begin one group into their arrays.
struct Chain {
  explicit Chain(std::int64_t elements) : count(static_cast<Index>(elements)) {
    const auto nodes = static_cast<std::size_t>(count + lanes);
    for (auto& field : fields) field.assign(nodes, 0.0);
    for (auto& force : forces) force.assign(2 * (nodes + lanes), 0.0);  // of two runs
    for (std::size_t i = 0; i < nodes; ++i) fields[0][i] = 1.01 * 0.005 * static_cast<double>(i);
    scale.assign(nodes, 1e-6 / 1.5e-5);
    parameter.assign(static_cast<std::size_t>(count / lanes), 0);
    for (const double value : {6.28e5, 0.655, 0.005, 1.3e-13}) palette.insert(palette.end(), lanes, value);
    damper.assign(static_cast<std::size_t>(count), 0.0);
    booked.assign(static_cast<std::size_t>(count / kernel::grain + 1) * lanes, 0.0);
  }
  kernel::AxialArguments axial() {
    return {fields[0].data(), fields[1].data(), fields[2].data(), fields[3].data(),
            fields[4].data(), fields[5].data(), parameter.data(), palette.data(),
            forces[0].data(), forces[1].data(), forces[2].data(), booked.data(),
            damper.data(),    nullptr,          nullptr,          1e-9};
  }
  kernel::NodeArguments node() {
    return {fields[0].data(), fields[1].data(), fields[2].data(), fields[3].data(),
            fields[4].data(), fields[5].data(), scale.data(),     forces[0].data(),
            forces[1].data(), forces[2].data(), {0, 0, 0},        1e-9};
  }

  Index count;
  AlignedVector<double> fields[6], forces[3], scale, palette, booked, damper;
  std::vector<Index> parameter;
};

void axial_forces(benchmark::State& state, kernel::Book::Sum book) {
  Chain chain(state.range(0));
  const kernel::Span span{0, chain.count / lanes, 1, 0, lanes, 0, -1};
  const kernel::AxialArguments arguments = chain.axial();
  const auto kernel = kernels().axial_spans[1][book];
  for (auto _ : state) {
    kernel(arguments, &span, 0, 1);
    benchmark::ClobberMemory();
  }
  const int of_dampers = book == kernel::Book::power ? 2 : 0;
  count(state, (9 + of_dampers) * sizeof(double));
}

// Nodes of a chain take the forces of two elements, those of a net four.
void node_update(benchmark::State& state, Index terms) {
  Chain chain(state.range(0));
  const Index second = chain.count + 3 * lanes;  // where forces of the other run begin
  kernel::Stretch stretch{0, chain.count, terms, {lanes, second, second}, {lanes - 1, second - lanes, 0}};
  const kernel::NodeArguments arguments = chain.node();
  const auto kernel = kernels().move_nodes[0][kernel::Moving::blind];
  for (auto _ : state) {
    kernel(arguments, &stretch, 0, 1);
    benchmark::ClobberMemory();
  }
  count(state, (terms == 1 ? 16 : 19) * sizeof(double));
}

// Elements and nodes in one pass, where the instruction set has it.
void chain_update(benchmark::State& state, bool ledger) {
  const auto kernel = kernels().update_chain[1][ledger][0][kernel::Moving::blind];
  Chain chain(state.range(0));
  const Index zeros = chain.count + 3 * lanes;
  const kernel::Span span{0, chain.count / lanes, 1, 0, lanes, ledger ? 0 : -1, 0};
  const kernel::Stretch stretch{0, chain.count, 1, {lanes, zeros, zeros}, {lanes - 1, zeros, zeros}};
  const kernel::AxialArguments elements = chain.axial();
  const kernel::NodeArguments nodes = chain.node();
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernel(elements, nodes, span, stretch));
    benchmark::ClobberMemory();
  }
  count(state, (13 + 2 * ledger) * sizeof(double));
}

// Single elements, which have no neighbours in memory.
void links(benchmark::State& state) {
  Chain chain(state.range(0));
  std::vector<kernel::Link> links;
  for (Index e = 0; e < chain.count; ++e)
    links.push_back({e, e + 1, lanes + e, -1, 6.28e5, 0.655, 0.005, 1.3e-13});
  const kernel::AxialArguments arguments = chain.axial();
  const auto kernel = kernels().axial_links[1][kernel::Book::nothing];
  for (auto _ : state) {
    kernel(arguments, links.data(), 0, chain.count);
    benchmark::ClobberMemory();
  }
  count(state, 9 * sizeof(double));
}

// Additions alone, for as many steps as a look allows on the way: an item is a node and step.
void free_flight(benchmark::State& state) {
  constexpr Index steps = 64;
  Chain chain(state.range(0));
  const kernel::NodeArguments arguments = chain.node();
  const auto kernel = kernels().fly_freely[0];
  for (auto _ : state) {
    kernel(arguments, chain.count, steps);
    benchmark::ClobberMemory();
  }
  const double items = static_cast<double>(state.iterations() * state.range(0) * steps);
  state.counters["items_per_second"] = benchmark::Counter(items, benchmark::Counter::kIsRate);
}

void energies(benchmark::State& state) {
  Chain chain(state.range(0));
  const kernel::EnergyArguments arguments{chain.fields[0].data(),
                                          chain.fields[1].data(),
                                          chain.fields[2].data(),
                                          chain.fields[3].data(),
                                          chain.fields[4].data(),
                                          chain.fields[5].data(),
                                          chain.forces[0].data(),
                                          chain.forces[1].data(),
                                          chain.forces[2].data(),
                                          0.5,
                                          chain.scale.data(),
                                          {0, 0, -9.81},
                                          chain.count};
  for (auto _ : state) benchmark::DoNotOptimize(kernels().node_energies(arguments));
  count(state, 10 * sizeof(double));
}

template <class Kernel, class Argument>
void add(const std::string& name, Kernel kernel, Argument argument) {
  benchmark::RegisterBenchmark(("kernel/" + name).c_str(), kernel, argument)->Arg(200)->Arg(2000);
}

[[maybe_unused]] const bool registered = [] {
  add("axial_forces", axial_forces, kernel::Book::nothing);
  add("axial_forces_with_ledger", axial_forces, kernel::Book::power);
  add("node_update_of_chain", node_update, 1);
  add("node_update_of_net", node_update, 2);
  if (kernels().update_chain[1][0][0][kernel::Moving::blind] != nullptr) {
    add("chain_update", chain_update, false);
    add("chain_update_with_ledger", chain_update, true);
  }
  benchmark::RegisterBenchmark("kernel/links", links)->Arg(200)->Arg(2000);
  benchmark::RegisterBenchmark("kernel/free_flight", free_flight)->Arg(200)->Arg(2000);
  benchmark::RegisterBenchmark("kernel/energies", energies)->Arg(200)->Arg(2000);
  return true;
}();

}  // namespace
}  // namespace cinch::bench
