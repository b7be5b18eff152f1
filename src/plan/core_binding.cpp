#include "plan/core_binding.hpp"

#include <omp.h>

#ifdef __linux__
#include <sched.h>

#include <cstdlib>
#include <vector>
#endif

namespace cinch {

#ifdef __linux__
namespace {

// Of the process, by number; none where the kernel does not tell.
struct Cores {
  cpu_set_t set;
  std::vector<int> numbers;

  Cores() {
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) != 0) return;
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(core, &set)) numbers.push_back(core);
  }
};

const Cores& cores() {
  static const Cores all;  // asked for before any thread is bound
  return all;
}

thread_local int bound_to = -1;

}  // namespace

bool binds_threads(int threads) {
  return threads > 1 && static_cast<std::size_t>(threads) == cores().numbers.size() &&
         omp_get_proc_bind() == omp_proc_bind_false && std::getenv("OMP_PROC_BIND") == nullptr;
}

CoreBinding::CoreBinding(int thread, int threads) {
  if (!binds_threads(threads)) return;
  const int core = cores().numbers[static_cast<std::size_t>(thread)];
  restore_ = thread == 0;
  if (bound_to == core) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  if (sched_setaffinity(0, sizeof one, &one) == 0) bound_to = core;
}

CoreBinding::~CoreBinding() {
  if (!restore_) return;
  sched_setaffinity(0, sizeof(cpu_set_t), &cores().set);
  bound_to = -1;
}
#else
bool binds_threads(int) { return false; }
CoreBinding::CoreBinding(int, int) {}
CoreBinding::~CoreBinding() = default;
#endif

}  // namespace cinch
