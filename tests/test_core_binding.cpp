// Threads that meet in every step have a core each, where there are as many; what runs elsewhere is left
// alone.
#include <gtest/gtest.h>

#ifdef __linux__
#include <omp.h>
#include <sched.h>

#include <set>

#include "plan/core_binding.hpp"
#include "support/scenes.hpp"

namespace cinch {
namespace {

std::set<int> allowed_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  EXPECT_EQ(sched_getaffinity(0, sizeof set, &set), 0);
  std::set<int> found;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &set)) found.insert(core);
  return found;
}

TEST(CoreBinding, GivesEachThreadACoreAndThemBack) {
  const std::set<int> all = allowed_cores();
  const int threads = static_cast<int>(all.size());
  if (!can_bind(threads)) GTEST_SKIP() << "one core, or OMP_PROC_BIND is set";
  std::vector<std::set<int>> cores(all.size());
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    const CoreBinding bound(true, thread, threads);
    cores[static_cast<std::size_t>(thread)] = allowed_cores();
  }
  std::set<int> used;
  for (const std::set<int>& own : cores) {
    EXPECT_EQ(own.size(), 1u);
    used.insert(own.begin(), own.end());
  }
  EXPECT_EQ(used, all);
  EXPECT_EQ(allowed_cores(), all) << "what the first thread starts next would share its core";
}

TEST(CoreBinding, LeavesFewerThreadsToTheScheduler) {
  const std::set<int> all = allowed_cores();
  const int threads = static_cast<int>(all.size());
  EXPECT_FALSE(can_bind(threads + 1));
  EXPECT_FALSE(can_bind(threads - 1));
  const CoreBinding many(true, 0, threads + 1);
  EXPECT_EQ(allowed_cores(), all);
  const CoreBinding unwanted(false, 0, threads);
  EXPECT_EQ(allowed_cores(), all);
}

TEST(CoreBinding, ARunLeavesItsCallerAllCores) {
  const std::set<int> all = allowed_cores();
  Simulation simulation(test::slackening_thread(1e-6), static_cast<int>(all.size()));
  simulation.advance_to(1000);
  EXPECT_EQ(allowed_cores(), all);
}

}  // namespace
}  // namespace cinch
#endif
