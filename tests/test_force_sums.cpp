// The rivals of bench/bench_reduction.cpp compute the same motion, with the same bits for any number of
// threads.
#include <gtest/gtest.h>

#include <cmath>

#include "../bench/force_sums.hpp"

namespace {

using namespace cinch;
using bench::SummedNet;
using bench::SumWay;

constexpr SumWay ways[] = {SumWay::gather, SumWay::coloured_scatter, SumWay::private_sums};

// Pulled together from all sides: the corner comes in by its own stretch, the middle stays.
TEST(ForceSums, WaysComeToTheSamePlaces) {
  SummedNet first(9, SumWay::gather, 1);
  const double corner = first.places(0)[0];
  first.advance(20000);
  EXPECT_GT(std::abs(first.places(0)[0] - corner), 1e-10) << "nothing has moved";
  for (const SumWay way : ways) {
    SummedNet other(9, way, 1);
    other.advance(20000);
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < other.places(axis).size(); ++i)
        EXPECT_NEAR(other.places(axis)[i], first.places(axis)[i], 1e-15) << axis << " " << i;
  }
}

TEST(ForceSums, BitsAreThoseOfAnyNumberOfThreads) {
  for (const SumWay way : ways) {
    SummedNet one(9, way, 1), three(9, way, 3);
    one.advance(100), three.advance(100);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(one.places(axis), three.places(axis));
  }
}

}  // namespace
