#include "app/resources.hpp"

#include <omp.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "base/error.hpp"
#include "scene/extent.hpp"

namespace cinch::app {
void warn_of_threads(int threads) {
  const int processors = omp_get_num_procs();
  if (std::min(threads, omp_get_thread_limit()) <= processors) return;
  std::cerr << "warning: --threads " << threads << ": this process may use " << processors << " processor"
            << (processors == 1 ? "" : "s") << "; more threads than that wait for each other\n";
}

void refuse_for_memory(const Scene& scene) {
  const Extent extent = extent_of(scene);
  throw Error(ExitCode::input_output, "error: not enough memory for this scene (" +
                                          std::to_string(extent.nodes) + " nodes, " +
                                          std::to_string(extent.elements) + " elements)");
}

}  // namespace cinch::app
