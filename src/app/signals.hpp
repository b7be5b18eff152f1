// SIGINT, SIGTERM and SIGHUP ask a run to stop after the step at hand, unless it was started with them
// ignored; a second one ends it at once. Files that may not grow and pipes that nobody reads are errors of
// writing.
#pragma once

namespace cinch::app {

void watch_signals();
/// The signal that asked to stop, 0 while none has.
int stop_signal();

}  // namespace cinch::app
