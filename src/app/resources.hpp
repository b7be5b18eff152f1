// What a command asks of the machine.
#pragma once

namespace cinch::app {

/// Warns where so many threads (0: automatic) cannot all run at once: they wait for each other in every step.
void warn_of_threads(int threads);

}  // namespace cinch::app
