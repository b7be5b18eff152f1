// The same scene with finer threads, to see what their elements cost in accuracy.
#pragma once
#include "scene/scene.hpp"

namespace cinch {

/// The scene with `factor` times as many elements in its threads and towing threads. Named places stay where
/// they are: node K of a thread is then node factor x K. A thread that carries a ring keeps its elements, and
/// so do nets: rings ride in the middle of an element, and a finer one would lie elsewhere.
Scene finer_threads(Scene scene, int factor);

}  // namespace cinch
