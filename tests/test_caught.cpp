// What is thrown within a region of threads reaches whoever called.
#include <gtest/gtest.h>

#include <new>
#include <string>

#include "base/caught.hpp"
#include "base/error.hpp"

namespace {

using namespace cinch;

TEST(Caught, TheFirstIsThrownAgainBehindTheRegion) {
  Caught caught;
  int done = 0;
#pragma omp parallel for num_threads(3) schedule(static, 1) reduction(+ : done)
  for (int p = 0; p < 6; ++p) {
    caught.run([p] {
      if (p % 3 == 1) throw CaseError("of thread " + std::to_string(p % 3));
    });
    ++done;
  }
  EXPECT_EQ(done, 6) << "the others go on";
  EXPECT_TRUE(caught.any());
  try {
    caught.rethrow();
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_STREQ(error.what(), "of thread 1");
  }
}

TEST(Caught, AnythingIsCaught) {
  Caught caught;
  caught.run([] { throw std::bad_alloc(); });
  EXPECT_THROW(caught.rethrow(), std::bad_alloc);
}

TEST(Caught, NothingIsThrownWhereNothingWas) {
  Caught caught;
  caught.run([] {});
  EXPECT_FALSE(caught.any());
  EXPECT_NO_THROW(caught.rethrow());
}

}  // namespace
