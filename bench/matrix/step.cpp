// How sharp the stable step is: bounded below it, growing above it where it is exact, never optimistic.
#include <cmath>

#include "groups.hpp"
#include "scenes.hpp"
#include "search.hpp"
#include "spectrum.hpp"
#include "watch.hpp"

namespace cinch::matrix {
namespace {

using Maker = Scene (*)(double damping);

Scene tense_chain_of_40(double damping) { return tense_chain(40, damping); }

/// The chain passes the middle of a ring along its axis and does not touch it.
Scene ring_round_a_chain(double damping) {
  Scene scene = tense_chain(40, damping);
  add_ring(scene, "r", Vec3(0.203, 0, 0), Vec3::UnitX());
  return scene;
}

/// The ring draws the chain aside by 1 mm: its wire stays in touch.
Scene ring_beside_a_chain(double damping) {
  Scene scene = tense_chain(40, damping);
  Ring& ring = add_ring(scene, "r", Vec3(0.203, 0, 0.007), Vec3::UnitX());
  ring.support = Support::fixed;
  scene.threads[0].points = {Vec3::Zero(), Vec3(0.203, 0, 0.00005), Vec3(0.4, 0, -0.004)};
  return scene;
}

/// The same with a joint in place of the wire.
Scene joint_on_a_chain(double damping) {
  Scene scene = ring_beside_a_chain(damping);
  scene.rings[0].joint = RingJoint::sliding;
  scene.rings[0].mass = 0.05;
  return scene;
}

struct Sample {
  const char* name;
  Maker make;
  bool straight;  ///< no ring is touched: the bound covers all that pulls
};

constexpr Sample samples[] = {{"chain", tense_chain_of_40, true},
                              {"net", tense_net, true},
                              {"junction", tense_junction, true},
                              {"chain through a ring", ring_round_a_chain, true},
                              {"chain on a ring's wire", ring_beside_a_chain, false},
                              {"chain on a sliding joint", joint_on_a_chain, false}};

// ---- below the bound, for long

void add_long_runs(std::vector<Cell>& cells, Extent extent) {
  const std::int64_t steps = extent == Extent::full ? 1000000 : 50000;
  for (const Sample& sample : samples)
    for (const double damping : {0.0, 0.106})
      for (const double fraction : {0.5, 0.9, 0.99}) {
        Cell cell("step", std::string(sample.name) + ", damping ratio, step",
                  words(damping) + ", " + words(fraction), sample.straight ? Must::hold : Must::either);
        cell.run = [=] {
          return watch([=] { return at_fraction(sample.make(damping), fraction); }, {steps, 20});
        };
        if (sample.straight) cell.most_residual = 1e-2;
        else cell.names = {"thread.main"};
        cell.place = {{sample.name, 1}, {"damping", damping}, {"step_fraction", fraction}};
        cells.push_back(cell);
      }
}

// ---- on both sides of the true limit

double true_step(const Scene& scene) {
  const Preparation p = prepare(scene);
  return critical_step(p.phases.front().model, places(p.assembly));
}

/// Faster than what the shaking gives, slower than what makes the growing mode turn slack.
constexpr double speed_limit = 6;  // m/s

Scene near_true_step(const Sample& sample, double damping, double fraction) {
  Scene scene = sample.make(damping);
  scene.time.step = fraction * true_step(scene);
  scene.time.allow_unstable = true;
  scene.time.speed_limit = speed_limit;
  return scene;
}

Outcome sharpness(const Sample& sample, double damping) {
  const Scene scene = sample.make(damping);
  const double ratio = true_step(scene) / prepare(scene).stable_step;
  return {ratio >= 1 - 1e-9 ? Verdict::held : Verdict::failed, 0, 0,
          "true stable step " + words(ratio) + " of the bound"};
}

Cell side_of_true_step(const Sample& sample, double damping, double fraction) {
  Cell cell("step", std::string(sample.name) + ", damping ratio, step over the true stable one",
            words(damping) + ", " + words(fraction), fraction < 1 ? Must::hold : Must::stop);
  cell.run = [=] { return watch([=] { return near_true_step(sample, damping, fraction); }, {20000, 1}); };
  cell.names = {"moves at", sample.name == std::string("net") ? "of net.main" : "of thread.",
                "is too large (stable step"};
  return cell;
}

void add_true_steps(std::vector<Cell>& cells) {
  for (const Sample& sample : {samples[0], samples[1], samples[2]})
    for (const double damping : {0.0, 0.106}) {
      cells.emplace_back("step", std::string(sample.name) + ", damping ratio: bound against eigenvalues",
                         words(damping), Must::hold, [=] { return sharpness(sample, damping); });
      for (const double fraction : {0.99, 1.01})
        cells.push_back(side_of_true_step(sample, damping, fraction));
    }
}

/// The chain's bound is exact but for its number of elements: 1 % above it grows.
Scene near_bound(double damping, double fraction) {
  Scene scene = at_fraction(tense_chain(40, damping), fraction);
  scene.time.speed_limit = speed_limit;
  return scene;
}

void add_chain_above(std::vector<Cell>& cells) {
  for (const double damping : {0.0, 0.106})
    for (const double fraction : {0.99, 1.01}) {
      Cell cell("step", "chain, damping ratio, step over the bound, until it grows",
                words(damping) + ", " + words(fraction), fraction < 1 ? Must::hold : Must::stop);
      cell.run = [=] { return watch([=] { return near_bound(damping, fraction); }, {20000, 1}); };
      cell.names = {"moves at", "of thread.main", "is too large (stable step"};
      cells.push_back(cell);
    }
}

// ---- the search

Outcome searched(Family family, int trials) {
  const Found found = search(family, trials);
  return {found.counter_examples == 0 ? Verdict::held : Verdict::failed, 0, 0,
          std::to_string(found.counter_examples) + " counter-examples; greatest usage " + words(found.worst) +
              " (seed " + std::to_string(found.seed) + ")"};
}

void add_search(std::vector<Cell>& cells, Extent extent) {
  const int trials = extent == Extent::full ? 100000 : 1000;
  for (const Family family : {Family::graph, Family::chain, Family::junction, Family::net})
    cells.emplace_back("step", "random " + name(family) + "s against eigenvalues", std::to_string(trials),
                       Must::hold, [=] { return searched(family, trials); });
}

}  // namespace

std::vector<Cell> step(Extent extent) {
  std::vector<Cell> cells;
  add_long_runs(cells, extent);
  add_true_steps(cells);
  add_chain_above(cells);
  add_search(cells, extent);
  return cells;
}

}  // namespace cinch::matrix
