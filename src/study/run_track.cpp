#include "study/run_track.hpp"

#include <cmath>
#include <random>

namespace cinch {
namespace {

void move_nodes(State& state, double nudge, unsigned seed) {
  std::mt19937 generator(seed);
  const auto next = [&] { return nudge * (static_cast<double>(generator()) / 2147483648.0 - 1); };
  for (std::size_t i = 0; i < state.x.size(); ++i)
    state.x[i] += next(), state.y[i] += next(), state.z[i] += next();
}

double sample_interval(const OutputSpec& output) {
  return output.probe_interval > 0 ? output.probe_interval : output.frame_interval;
}

}  // namespace

RunTrack follow(const Scene& scene, int threads, double nudge, unsigned seed) {
  Simulation simulation(scene, threads);
  if (nudge > 0) move_nodes(simulation.state(), nudge, seed);
  RunTrack track;
  const Timeline& timeline = simulation.preparation().timeline;
  const double interval = sample_interval(scene.output);
  const auto samples = static_cast<std::int64_t>(scene.time.end / interval * (1 + 1e-12));
  for (std::int64_t k = 0; k <= samples; ++k) {
    simulation.advance_to(timeline.step_at(static_cast<double>(k) * interval));
    const Look& now = simulation.look();
    simulation.note_events(now);
    track.probes.push_back(simulation.probe_row(now));
    simulation.check_energy(now);
  }
  simulation.advance_to(simulation.preparation().end_step);
  const Look& end = simulation.look();
  for (const Part& part : end.assembly().parts) {
    std::vector<Vec3>& places = track.nodes.emplace_back();
    for (const Index node : part.nodes) places.push_back(end.position(node));
  }
  return track;
}

}  // namespace cinch
