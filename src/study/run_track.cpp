#include "study/run_track.hpp"

#include <cmath>

namespace cinch {
RunTrack follow(const Scene& scene, int threads, const Nudge& nudge) {
  Simulation simulation(scene, prepare(scene), threads, nudge);
  RunTrack track;
  const Timeline& timeline = simulation.preparation().timeline;
  const double interval = scene.output.sample_interval();
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
