#include "app/resources.hpp"

#include <omp.h>

#include <algorithm>
#include <iostream>

namespace cinch::app {

void warn_of_threads(int threads) {
  const int processors = omp_get_num_procs();
  if (std::min(threads, omp_get_thread_limit()) <= processors) return;
  std::cerr << "warning: --threads " << threads << ": this process may use " << processors << " processor"
            << (processors == 1 ? "" : "s") << "; more threads than that wait for each other\n";
}

}  // namespace cinch::app
