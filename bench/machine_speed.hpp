// What the machine itself can do: the limits that the solver's figures are held against.
#pragma once
#include <vector>

namespace cinch::bench {

/// Cores that this process may use.
int cores();

/// 1, 2, 4, ... and all cores.
std::vector<int> thread_counts();

/// a[i] = b[i] + s c[i] on arrays far larger than the caches, each part first touched by the thread that uses
/// it. Counts 24 bytes an element, as STREAM does: what the program reads and writes. (Where a store first
/// fetches the line that it overwrites, the memory moves 32.)
class Triad {
 public:
  explicit Triad(int threads);
  ~Triad();
  Triad(const Triad&) = delete;
  Triad& operator=(const Triad&) = delete;
  void pass();
  double bytes() const { return 24.0 * static_cast<double>(size_); }  ///< of one pass

 private:
  int threads_;
  long size_;
  double *a_, *b_, *c_;
};

/// The best of some passes, as STREAM takes it: others that use the machine only make it slower.
double triad_bytes_per_second(int threads);

/// Nanoseconds until a thread on one core sees what one on another core has written: half the round trip of
/// two pinned threads that wait for each other's flags as the solver's threads do (plan/exchange.cpp). Median
/// over some stretches; 0 where there is only one core.
double handover_ns();

}  // namespace cinch::bench
