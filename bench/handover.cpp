#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#include "machine_speed.hpp"
#include "plan/stage_clock.hpp"

namespace cinch::bench {
namespace {

constexpr int stretches = 15, rounds = 200;  // some milliseconds in all

struct alignas(128) Flag {
  std::atomic<int> round{0};
};

// Waits as the solver's threads do: spins, and after a while leaves the core to whoever needs it.
void wait_for(const Flag& flag, int wanted) {
  constexpr int patient_spins = 4096;
  for (int spin = 0; flag.round.load(std::memory_order_acquire) < wanted; ++spin) {
    if (spin >= patient_spins) std::this_thread::yield();
#if defined(__x86_64__)
    else __builtin_ia32_pause();
#elif defined(__aarch64__)
    else asm volatile("yield");
#endif
  }
}

// The first two cores that this process may use.
std::array<int, 2> two_cores() {
  cpu_set_t allowed;
  std::array<int, 2> found{-1, -1};
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return found;
  std::size_t next = 0;
  for (int core = 0; core < CPU_SETSIZE && next < 2; ++core)
    if (CPU_ISSET(static_cast<unsigned>(core), &allowed)) found[next++] = core;
  return found;
}

void pin_to(int core) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  pthread_setaffinity_np(pthread_self(), sizeof one, &one);
}

}  // namespace

double handover_ns() {
  const std::array<int, 2> core = two_cores();
  if (core[1] < 0) return 0;
  Flag ping, pong;
  std::array<double, stretches> seconds{};
  std::thread answer([&] {
    pin_to(core[1]);
    for (int r = 1; r <= stretches * rounds; ++r) {
      wait_for(ping, r);
      pong.round.store(r, std::memory_order_release);
    }
  });
  std::thread ask([&] {  // a thread of its own, so that the caller stays free to move
    pin_to(core[0]);
    int r = 0;
    for (double& stretch : seconds) {
      const double begin = clock_seconds();
      for (int k = 0; k < rounds; ++k) {
        ping.round.store(++r, std::memory_order_release);
        wait_for(pong, r);
      }
      stretch = clock_seconds() - begin;
    }
  });
  ask.join();
  answer.join();
  std::nth_element(seconds.begin(), seconds.begin() + stretches / 2, seconds.end());
  return 1e9 * seconds[stretches / 2] / (2.0 * rounds);
}

}  // namespace cinch::bench
