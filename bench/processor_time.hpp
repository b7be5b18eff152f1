// Time that one thread has computed: unlike time on the wall it leaves out what others did on a busy machine.
// Suites of one thread take their rates from it.
#pragma once
#include <ctime>

namespace cinch::bench {

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace cinch::bench
