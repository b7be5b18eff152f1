// What the machine has.
#pragma once
#include <cstddef>

namespace cinch {

/// Bytes of memory that this process can have: the machine's, or less where a control group says so.
std::size_t machine_memory();

}  // namespace cinch
