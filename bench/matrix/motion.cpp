// Hard and awkward motion: impacts from creeping to far too fast, and places where a formula could divide by
// nothing.
#include <algorithm>

#include "groups.hpp"
#include "motion_scenes.hpp"
#include "plan/preparation.hpp"
#include "quiet_net.hpp"
#include "random_runs.hpp"
#include "watch.hpp"

namespace cinch::matrix {
namespace {

Cell scene_cell(const std::string& parameter, const std::string& value, Must must, const SceneMaker& make,
                const Watch& how, std::vector<std::string> names = {}) {
  Cell cell("motion", parameter, value, must, [=] { return watch(make, how); });
  cell.names = std::move(names);
  return cell;
}

/// Steps for some travel at that speed, but no fewer and no more than so many.
std::int64_t steps_for(const Scene& scene, double travel, double speed, Extent extent) {
  const double steps = travel / speed / prepare(scene).timeline.after();
  return static_cast<std::int64_t>(std::clamp(steps, 2e3, extent == Extent::full ? 4e6 : 1e5));
}

struct Hit {
  const char* name;
  Scene (*make)(double speed);
};

constexpr Hit hits[] = {{"mass on a ball", mass_on_ball},
                        {"thread on a ball", thread_on_ball},
                        {"mass on a ring's wire, head-on", mass_on_wire},
                        {"mass on a ring's rim, in its plane", mass_on_rim},
                        {"thread on a ring from inside", thread_in_ring},
                        {"thread on a ring from outside", thread_outside_ring}};

void add_impacts(std::vector<Cell>& cells, Extent extent) {
  for (const Hit& hit : hits)
    for (const double speed : {0.01, 0.1, 1.0, 10.0, 50.0, 100.0, 500.0}) {
      Cell cell("motion", std::string(hit.name) + ", speed", words(speed) + " m/s",
                speed > 1 ? Must::either : Must::hold);
      cell.names = {"thread.main"};
      cell.run = [=] {
        const std::int64_t steps = steps_for(hit.make(speed), 0.03, speed, extent);
        return watch([=] { return hit.make(speed); }, {steps, 100});
      };
      cell.place = {{hit.name, 1}, {"speed_m_s", speed}};
      cells.push_back(cell);
    }
}

void add_places(std::vector<Cell>& cells, Extent extent) {
  const std::int64_t steps = extent == Extent::full ? 200000 : 20000;
  struct Place {
    const char *parameter, *value;
    Scene (*make)();
    Must must;
  };
  const Place all[] = {
      {"thread and ring", "along the ring's axis", thread_on_axis, Must::hold},
      {"thread and ring", "in its plane, through its centre", thread_across_ring, Must::either},
      {"thread and ring", "in its plane, beside it", thread_in_plane, Must::either},
      {"rings", "two on one thread, in touch", two_rings, Must::hold},
      {"rings", "two on neighbouring elements", ring_neighbours, Must::either},
      {"rings", "at a thread's end", ring_at_end, Must::hold},
      {"elements beside a ring", "much shorter than its wire", short_elements, Must::hold},
      {"elements beside a ring", "much longer than it", long_elements, Must::either},
      {"zero closing speed", "thread that touches a wire at rest", wire_at_rest, Must::hold},
      {"zero closing speed", "mass that touches a ball at rest", ball_at_rest, Must::hold},
      {"zero closing speed", "thread that presses on a wire at rest", wire_pressed, Must::hold},
      {"nothing moves", "slack thread, no gravity", idle_thread, Must::hold},
      {"folded net", "to a millionth", [] { return folded_net(1e-6); }, Must::hold},
      {"folded net", "to 1e-12", [] { return folded_net(1e-12); }, Must::hold},
      {"folded net", "to 1e-300", [] { return folded_net(1e-300); }, Must::hold},
      {"folded net", "with rings, to 1e-12", folded_ringed_net, Must::either},
      {"closing", "at t = 0", [] { return closing_net(0); }, Must::hold},
      {"closing", "in the first half of a step", [] { return closing_net(1e-9); }, Must::hold},
      {"closing", "at t = 5 ms", [] { return closing_net(0.005); }, Must::hold},
      {"separation", "at t = 0", [] { return separating_net(0); }, Must::hold},
      {"separation", "in the first half of a step", [] { return separating_net(1e-9); }, Must::hold},
      {"separation", "at t = 5 ms", [] { return separating_net(0.005); }, Must::hold},
  };
  for (const Place& place : all)
    cells.push_back(scene_cell(place.parameter, place.value, place.must, place.make, {steps}, {}));
}

/// A heavy net on a ball that gives way: many elements and their nodes sink in together. With damping, the
/// impact of a corner on a hard ball is more than a step of the net carries.
void add_pressed_nets(std::vector<Cell>& cells) {
  for (const double alpha : {0.0, 0.05})
    for (const int elements : {1, 10})
      for (const double modulus : {1e5, 1e7, 2.3e9}) {
        const std::string value =
            words(modulus) + " Pa, " + std::to_string(elements) + ", " + words(alpha) + " s/m";
        const bool hard = alpha > 0 && elements > 1 && modulus > 1e6;
        Cell cell = scene_cell("net on a ball, its modulus, elements of a side, alpha", value,
                               hard ? Must::either : Must::hold,
                               [=] { return net_on_ball(modulus, elements, alpha); }, {}, {"net.main"});
        cell.run = [=] {
          const Scene scene = net_on_ball(modulus, elements, alpha);
          return watch([=] { return scene; },
                       {static_cast<std::int64_t>(0.16 / prepare(scene).timeline.after()), 32});
        };
        cells.push_back(cell);
      }
}

/// Known to win energy at any step that is worth taking; that must be told.
void add_known(std::vector<Cell>& cells) {
  for (const double fraction : {0.1, 0.2, 0.5, 0.8}) {
    for (const double damping : {0.0, 0.106})
      cells.push_back(scene_cell("light node beside a sliding joint's rim, damping ratio, step",
                                 words(damping) + ", " + words(fraction), Must::either,
                                 [=] { return node_beside_rim(damping, fraction); }, {100000, 400},
                                 {"thread.main"}));
    cells.push_back(scene_cell("free end drawn into a sliding joint, step", words(fraction), Must::either,
                               [=] { return end_into_ring(0, fraction); }, {20000, 400},
                               {"node 10 of thread.main is drawn to ring 'r'"}));
    cells.push_back(scene_cell("end of 10 g drawn into a sliding joint, step", words(fraction), Must::hold,
                               [=] { return end_into_ring(0.01, fraction); }, {20000, 400}));
  }
}

}  // namespace

std::vector<Cell> motion(Extent extent) {
  std::vector<Cell> cells;
  add_impacts(cells, extent);
  add_places(cells, extent);
  add_pressed_nets(cells);
  add_known(cells);
  const int runs = extent == Extent::full ? 50000 : 300;
  cells.emplace_back("motion", "random scenes", std::to_string(runs), Must::hold,
                     [=] { return random_runs(runs); });
  const std::int64_t steps = extent == Extent::full ? 10000000 : 100000;
  cells.emplace_back("motion", "quiet hanging net, steps", words(static_cast<double>(steps)), Must::hold,
                     [=] { return quiet_net(steps); });
  return cells;
}

}  // namespace cinch::matrix
