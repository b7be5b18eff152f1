#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <new>

#include "machine_speed.hpp"
#include "plan/stage_clock.hpp"

namespace cinch::bench {
namespace {

constexpr std::align_val_t page{4096};

// Each array is four times the last-level cache, STREAM's rule. What virtual machines say of its size is that
// of whole sockets or nothing; few cores share more than 32 MiB.
long array_size() {
  const long cache = std::clamp(sysconf(_SC_LEVEL3_CACHE_SIZE), 16L << 20, 32L << 20);
  return 4 * cache / static_cast<long>(sizeof(double));
}

double* allocate(long size) {
  return static_cast<double*>(::operator new(static_cast<std::size_t>(size) * sizeof(double), page));
}

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
void triad(long begin, long end, double* __restrict a, const double* __restrict b, const double* __restrict c) {
#pragma omp simd
  for (long i = begin; i < end; ++i) a[i] = b[i] + 3.0 * c[i];
}

// Calls work(begin, end) for the part of each thread.
template <class Work>
void in_parts(long size, int threads, const Work& work) {
#pragma omp parallel num_threads(threads)
  {
    const long part = omp_get_thread_num(), parts = omp_get_num_threads();
    work(size * part / parts, size * (part + 1) / parts);
  }
}

}  // namespace

int cores() { return omp_get_num_procs(); }

std::vector<int> thread_counts() {
  std::vector<int> counts;
  for (int threads = 1; threads < cores(); threads *= 2) counts.push_back(threads);
  counts.push_back(cores());
  return counts;
}

Triad::Triad(int threads)
    : threads_(threads), size_(array_size()), a_(allocate(size_)), b_(allocate(size_)), c_(allocate(size_)) {
  in_parts(size_, threads_, [this](long begin, long end) {
    std::fill(a_ + begin, a_ + end, 0.0);
    std::fill(b_ + begin, b_ + end, 1.0);
    std::fill(c_ + begin, c_ + end, 2.0);
  });
}

Triad::~Triad() {
  for (double* array : {a_, b_, c_}) ::operator delete(array, page);
}

void Triad::pass() {
  in_parts(size_, threads_, [this](long begin, long end) { triad(begin, end, a_, b_, c_); });
}

double triad_bytes_per_second(int threads) {
  constexpr int passes = 6;
  Triad triad(threads);
  double best = 1e300;
  for (int k = 0; k < passes; ++k) {
    const double begin = clock_seconds();
    triad.pass();
    best = std::min(best, clock_seconds() - begin);
  }
  return triad.bytes() / best;
}

}  // namespace cinch::bench
