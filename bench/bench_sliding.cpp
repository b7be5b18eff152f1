// The kernel of sliding joints, as a step calls it: rings on one taut thread, each alone in its element,
// which bends over the ring's rim. The number in the name is that of the rings, an item is a ring.
#include <benchmark/benchmark.h>

#include "counters.hpp"
#include "plan/sliding_joints.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

constexpr double element = 0.05;  // m

std::string ring(int number) {
  return "[ring.r" + std::to_string(number) + "]\ncenter_m = [" +
         std::to_string((2 * number + 1.5) * element) +
         ", 0, 0]\nnormal = [1, 0, 0]\nsupport = \"fixed\"\njoint = \"sliding\"\ndiameter_m = 0.02\n"
         "wire_diameter_m = 0.004\nmass_kg = 0.1\nyoungs_modulus_Pa = 70e9\n";
}

Scene threaded_rings(int count) {
  const int elements = 2 * count + 1;
  std::string text = case_head({}) + "[thread.main]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = " +
                     std::to_string(elements) + "\npoints_m = [[0, 0, 0], [" +
                     std::to_string(element * elements) + ", 0, 0]]\n";
  for (int i = 0; i < count; ++i) text += ring(i);
  return parse_case(text, "threaded.toml");
}

void sliding_joints(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  Simulation simulation(threaded_rings(count), 1);
  const Phase& phase = simulation.preparation().phases.back();
  State& s = simulation.state();
  for (const kernel::Joint& joint : phase.model.joints)
    s.y[static_cast<std::size_t>(joint.host_a)] += 0.01;  // 3 mm beyond the opening
  SlidingJoints joints;
  joints.take_all(phase.model);
  joints.take(s, s.x.size());
  const NodeView nodes{s.x.data(), s.y.data(), s.z.data(), s.vx.data(), s.vy.data(), s.vz.data(), nullptr};
  for (auto _ : state) joints.evaluate(nodes, phase.plan, 0);
  state.counters["items_per_second"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["loads"] = static_cast<double>(joints.on_hosts().size());
}

BENCHMARK(sliding_joints)->Name("kernel/sliding_joint")->Arg(16)->Arg(128);

}  // namespace
}  // namespace cinch::bench
