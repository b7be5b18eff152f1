// A thread with a ball at its end that turns slack and taut: where explicit steps win or lose energy first.
#include "groups.hpp"
#include "scenes.hpp"
#include "watch.hpp"

namespace cinch::matrix {
namespace {

enum class Way { whipped, released };

Scene slackening(Way way, double damping, double fraction) {
  Scene scene = plain_scene();
  Material& m = scene.materials["m"];
  m.youngs_modulus = 1e8;
  m.damping_ratio = damping;
  const Vec3 ball = way == Way::whipped ? Vec3(0, 0, 0) : Vec3(0, 0.2, 0);
  Thread& thread = add_thread(scene, "main", {ball, Vec3(0, 1, 0)}, 200);
  thread.length = 1;
  thread.start.mass = 0.1;
  thread.start.velocity = way == Way::whipped ? Vec3(0, 0, -1) : Vec3(0, -2, 0.5);
  thread.end.support = Support::fixed;
  return at_fraction(scene, fraction);
}

/// With the default damping any step up to 0.8 of the bound holds, with a tenth of it the half, without any
/// 0.2 where nothing jerks the thread taut.
Must duty(Way way, double damping, double fraction) {
  if (damping < 0.01 && way == Way::released) return Must::either;
  const double sound = damping < 0.01 ? 0.2 : damping < 0.05 ? 0.4 : 0.8;
  return fraction <= sound ? Must::hold : Must::either;
}

}  // namespace

std::vector<Cell> slack(Extent extent) {
  const double until = extent == Extent::full ? 2 : 0.5;  // s
  std::vector<Cell> cells;
  for (const Way way : {Way::whipped, Way::released})
    for (const double damping : {0.0, 0.01, 0.106})
      for (const double fraction : {0.2, 0.4, 0.6, 0.8, 0.97}) {
        Cell cell(
            "slack and taut",
            way == Way::whipped ? "whipped, damping ratio, step" : "released slack, damping ratio, step",
            words(damping) + ", " + words(fraction), duty(way, damping, fraction));
        cell.run = [=] {
          const double step = slackening(way, damping, fraction).time.step;
          return watch([=] { return slackening(way, damping, fraction); },
                       {static_cast<std::int64_t>(until / step), 200});
        };
        cell.place = {{way == Way::whipped ? "whipped" : "released", 1},
                      {"damping", damping},
                      {"step_fraction", fraction}};
        cell.names = {"thread.main", "time step"};
        cells.push_back(cell);
      }
  return cells;
}

}  // namespace cinch::matrix
