#include "base/machine.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace cinch {

std::size_t machine_memory() {
  auto bytes =
      static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::size_t limit = 0;  // "max" where there is none
  if (std::ifstream group("/sys/fs/cgroup/memory.max"); group >> limit) bytes = std::min(bytes, limit);
  return bytes;
}

}  // namespace cinch
