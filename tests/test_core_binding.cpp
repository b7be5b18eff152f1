// Threads that meet in every step have a core each, where there are as many; what runs elsewhere is left
// alone.
#include <gtest/gtest.h>

#ifdef __linux__
#include <omp.h>
#include <sched.h>

#include <cstdlib>
#include <set>
#include <thread>

#include "plan/core_binding.hpp"
#include "support/quick_cases.hpp"
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
  const bool possible = threads > 1 && std::getenv("OMP_PROC_BIND") == nullptr;
  EXPECT_EQ(can_bind(threads), possible);
  std::vector<std::set<int>> cores(all.size());
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    const CoreBinding bound(true, thread, threads);
    cores[static_cast<std::size_t>(thread)] = allowed_cores();
  }
  std::set<int> used;
  for (const std::set<int>& own : cores) {
    EXPECT_EQ(own.size(), possible ? 1u : all.size());
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

// In a thread of its own, whose teams no other test has used: how many cores each has after a run.
std::vector<std::size_t> cores_after_run(int threads) {
  std::vector<std::size_t> cores(static_cast<std::size_t>(threads));
  std::thread([&] {
    Simulation simulation(test::slackening_thread(1e-6), threads);
    simulation.advance_to(1000);
#pragma omp parallel num_threads(threads)
    cores[static_cast<std::size_t>(omp_get_thread_num())] = allowed_cores().size();
  }).join();
  return cores;
}

TEST(CoreBinding, ARunBindsTheThreadsAskedForAndLeavesItsCallerAllCores) {
  const std::size_t all = allowed_cores().size();
  const std::vector<std::size_t> cores = cores_after_run(static_cast<int>(all));
  EXPECT_EQ(cores[0], all);
  for (std::size_t thread = 1; thread < all; ++thread)
    EXPECT_EQ(cores[thread], can_bind(static_cast<int>(all)) ? 1u : all);
}

TEST(CoreBinding, ARunThatTriesOutItsThreadsIsNotBound) {
  const Scene scene = test::read(test::capture());
  const bool tries = omp_get_max_threads() > 1;
  Simulation simulation(scene);
  EXPECT_EQ(simulation.stepper().binds_threads(), !tries);
  simulation.use_threads(2);
  EXPECT_TRUE(simulation.stepper().binds_threads());
  EXPECT_TRUE(Simulation(scene, 2).stepper().binds_threads());
}

}  // namespace
}  // namespace cinch
#endif
