// The contact kernels, as a step calls them: through plan/near_contacts.hpp, which hands them the pairs that
// are near. The number in the name is that of the rings or balls, all of which touch one straight thread; an
// item is a pair that was looked at.
#include <benchmark/benchmark.h>

#include "counters.hpp"
#include "plan/contact_shares.hpp"
#include "scenes.hpp"

namespace cinch::bench {
namespace {

std::string at_x(int number, double y) {
  return "[" + std::to_string(0.05 * (number + 1) + 0.001) + ", " + std::to_string(y) + ", 0]";
}

// 0.1 mm into the thread, 3 mm between centre lines at first touch. Neither along the thread nor beside a
// node: few of a case's pairs are, and those are computed one by one.
std::string ring(int number) {
  return "[ring.r" + std::to_string(number) + "]\ncenter_m = " + at_x(number, 0.0071) +
         "\nnormal = [1, 0, 0.3]\nsupport = \"fixed\"\ndiameter_m = 0.02\nwire_diameter_m = 0.004\nmass_kg = "
         "0.1\n"
         "youngs_modulus_Pa = 70e9\n";
}

std::string ball(int number) {
  return "[target.b" + std::to_string(number) + "]\ncenter_m = " + at_x(number, 0.0059) +
         "\nradius_m = 0.005\nyoungs_modulus_Pa = 2.3e9\npoissons_ratio = 0.39\n";
}

Scene touched_thread(int count, std::string (*part)(int)) {
  const int elements = 10 * (count + 2);
  std::string text = case_head({}) + "[thread.main]\nmaterial = \"m\"\ndiameter_m = 0.002\nelements = " +
                     std::to_string(elements) + "\npoints_m = [[0, 0, 0], [" +
                     std::to_string(0.005 * elements) + ", 0, 0]]\n";
  for (int i = 0; i < count; ++i) text += part(i);
  return parse_case(text, "touched.toml");
}

void contacts(benchmark::State& state, std::string (*part)(int)) {
  Simulation simulation(touched_thread(static_cast<int>(state.range(0)), part), 1);
  const Phase& phase = simulation.preparation().phases.back();
  State& s = simulation.state();
  ContactList list(phase.model, 0);
  list.rebuild(phase.model, s);
  const std::vector<double> share = node_share(phase.model, phase.plan.dt, phase.plan.joint_steps);
  NearContacts near;
  near.renew(all_contacts(phase.model, list, s), list.margin(), share.data());
  const NodeView nodes{s.x.data(),  s.y.data(),  s.z.data(),  s.vx.data(),
                       s.vy.data(), s.vz.data(), share.data()};
  near.evaluate(nodes, phase.plan, 0, phase.plan.dt, 0);  // what is far falls asleep
  const std::int64_t before = near.evaluated();
  for (auto _ : state) near.evaluate(nodes, phase.plan, 0, phase.plan.dt, 0);
  const double pairs = static_cast<double>(near.evaluated() - before);
  state.counters["items_per_second"] = benchmark::Counter(pairs, benchmark::Counter::kIsRate);
  state.counters["pairs"] = pairs / static_cast<double>(state.iterations());
  state.counters["loads"] = static_cast<double>(near.loads().size());
}

[[maybe_unused]] const bool registered = [] {
  benchmark::RegisterBenchmark("kernel/ring_contact", contacts, ring)->Arg(16)->Arg(128);
  benchmark::RegisterBenchmark("kernel/target_contact", contacts, ball)->Arg(16)->Arg(128);
  return true;
}();

}  // namespace
}  // namespace cinch::bench
