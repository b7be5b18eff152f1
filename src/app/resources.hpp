// What a command asks of the machine: threads and memory.
#pragma once
#include <new>

#include "scene/scene.hpp"

namespace cinch::app {

/// Warns where so many threads (0: automatic) cannot all run at once: they wait for each other in every step.
void warn_of_threads(int threads);

/// Throws the Error of a scene for which the memory does not suffice.
[[noreturn]] void refuse_for_memory(const Scene& scene);

/// Does `work` for a scene; where memory runs out, the error tells how large the scene is.
template <class Work>
auto with_memory_for(const Scene& scene, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    refuse_for_memory(scene);
  }
}

}  // namespace cinch::app
