#include "app/signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <initializer_list>

#include "base/error.hpp"

namespace cinch::app {
namespace {

// Any thread may catch a signal.
std::atomic<int> caught = 0;
std::atomic<std::int64_t> caught_at = 0;  // ms
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

// `timeout` and terminals that close send each signal twice, at once: that is one request.
constexpr std::int64_t one_request = 100;  // ms

std::int64_t now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1000 + time.tv_nsec / 1'000'000;
}

extern "C" void on_signal(int signal) {
  int none = 0;
  if (caught.compare_exchange_strong(none, signal)) {
    caught_at = now();
  } else if (caught_at != 0 && now() - caught_at > one_request) {  // as a kill
    _exit(static_cast<int>(signal == SIGTERM ? ExitCode::terminated : ExitCode::interrupted));
  }
}

// What is ignored stays so: nohup, and shells for what runs in the background, ask for that.
void watch(int signal, const struct sigaction& action) {
  struct sigaction old {};
  sigaction(signal, nullptr, &old);
  if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}

}  // namespace

void watch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;  // a write that a signal interrupts has not failed
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) watch(signal, action);
  signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
  signal(SIGPIPE, SIG_IGN);  // and so is a pipe that nobody reads: behind stderr it costs no run
}

int stop_signal() { return caught; }

}  // namespace cinch::app
