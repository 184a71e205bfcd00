// SPDX-License-Identifier: Apache-2.0
// Some of the cases that `awkward_hunt` goes through for as long as one likes.
#include <gtest/gtest.h>

#include "tests/awkward/promises.hpp"

namespace tetrakis::test {
namespace {

class AwkwardTerrain : public testing::TestWithParam<uint64_t> {};

/// ctest ends what takes too long.
TEST_P(AwkwardTerrain, PromisesHold) {
  constexpr uint64_t kCases = 8;
  for (uint64_t seed = kCases * GetParam(); seed < kCases * (GetParam() + 1); ++seed) {
    const AwkwardCase c = awkwardCase(seed, 4000);
    EXPECT_EQ(brokenPromise(c), "") << "seed " << seed << ": " << c.description;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, AwkwardTerrain, testing::Range<uint64_t>(0, 12));

}  // namespace
}  // namespace tetrakis::test
