// Whether a scene is one of the paper's: what the paper says of its scenes tells nothing about any other.
#pragma once
#include <string>

#include "scene/scene.hpp"

namespace cinch {

/// The paper's simulations, Secs. 5.1 to 5.3.
enum class PaperCase { ring_pull, edge_closure, capture, none };

struct Recognised {
  PaperCase as = PaperCase::none;
  /// What sets a scene of the same parts apart: "ball's mass 5 kg, the paper's 0.1 kg (Sec. 5.1)"; empty for
  /// the paper's scenes and for scenes of other parts.
  std::string difference;
};

/// Compares what the paper fixes: masses, lengths, places, velocities, materials. Names, whatever only the
/// computation needs and what the paper leaves open (cases/README.md) may be anything.
Recognised recognise(const Scene& scene);

}  // namespace cinch
