// Memory that this process holds.
#pragma once
#include <malloc.h>
#include <unistd.h>

#include <fstream>

namespace cinch::bench {

/// Bytes in memory now, as the system counts them.
inline double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double whole = 0, resident = 0;
  file >> whole >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// The same when what was freed has been given back: to be read before something is made.
inline double resident_bytes_in_use() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  return resident_bytes();
}

}  // namespace cinch::bench
