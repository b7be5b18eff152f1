#include "app/signals.hpp"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace cinch::app {
namespace {

volatile std::sig_atomic_t caught = 0;

extern "C" void on_signal(int signal) {
  if (caught != 0 && signal == SIGINT) _exit(130);  // frames are flushed: nothing is lost
  caught = signal;
}

}  // namespace

void watch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
}

int stop_signal() { return caught; }

}  // namespace cinch::app
