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

std::vector<int> numbers_of(const cpu_set_t& set) {
  std::vector<int> numbers;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &set)) numbers.push_back(core);
  return numbers;
}

// Those of the process, by number: asked for before any thread is bound. None where the kernel does not tell.
const std::vector<int>& cores() {
  static const std::vector<int> all = [] {
    cpu_set_t set;
    CPU_ZERO(&set);
    return sched_getaffinity(0, sizeof set, &set) == 0 ? numbers_of(set) : std::vector<int>();
  }();
  return all;
}

thread_local int bound_to = -1;
thread_local cpu_set_t callers;  ///< of the first thread, as it was before

}  // namespace

bool can_bind(int threads) {
  return threads > 1 && static_cast<std::size_t>(threads) == cores().size() &&
         omp_get_proc_bind() == omp_proc_bind_false && std::getenv("OMP_PROC_BIND") == nullptr;
}

CoreBinding::CoreBinding(bool wanted, int thread, int threads) {
  if (!wanted || !can_bind(threads)) return;
  const int core = cores()[static_cast<std::size_t>(thread)];
  restore_ = thread == 0 && sched_getaffinity(0, sizeof callers, &callers) == 0;
  if (bound_to == core || (thread == 0 && !restore_)) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  if (sched_setaffinity(0, sizeof one, &one) == 0) bound_to = core;
}

CoreBinding::~CoreBinding() {
  if (!restore_) return;
  sched_setaffinity(0, sizeof callers, &callers);
  bound_to = -1;
}
#else
bool can_bind(int) { return false; }
CoreBinding::CoreBinding(bool, int, int) {}
CoreBinding::~CoreBinding() = default;
#endif

}  // namespace cinch
