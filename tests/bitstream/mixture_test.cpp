// SPDX-License-Identifier: Apache-2.0
// Several models that foretell one decision.
#include "bitstream/coder/mixture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace tetrakis {
namespace {

TEST(Mixture, OddsAreTheLeastOfTheirProbability) {
  const OddsTable table = makeOddsTable();
  for (int32_t p = 0; p < 4096; ++p) {
    const int32_t odds = table[static_cast<size_t>(p)];
    EXPECT_TRUE(odds == kMostOdds || probabilityOf(odds) >= p) << p;
    EXPECT_TRUE(odds == -kMostOdds || probabilityOf(odds - 1) < p) << p;
  }
}

/// Of two models the mixture believes the one that knows.
TEST(Mixture, LearnsWhomToBelieve) {
  std::mt19937 random(1);
  std::array<AdaptiveBit, 2> knowing;
  AdaptiveBit ignorant;
  auto weights = freshWeights<2>();
  const OddsTable odds = makeOddsTable();
  double bits = 0;
  constexpr int kDecisions = 4000;
  for (int i = 0; i < kDecisions; ++i) {
    const bool state = random() % 2 != 0, bit = random() % 16 == 0 ? !state : state;
    Mixture<2> mixture({&knowing[state], &ignorant}, weights, odds);
    const double zero = mixture.zero() / 65536.;
    bits -= std::log2(bit ? 1 - zero : zero);
    mixture.learn(bit);
  }
  EXPECT_LT(bits / kDecisions, 0.36);  // the entropy is 0.337
}

/// Whatever damaged bytes make of the decisions.
TEST(Mixture, StaysWithinItsLimits) {
  std::mt19937 random(1);
  std::array<AdaptiveBit, 3> models;
  auto weights = freshWeights<3>();
  const OddsTable odds = makeOddsTable();
  for (int i = 0; i < 200000; ++i) {
    Mixture<3> mixture({&models[0], &models[1], &models[random() % 3]}, weights, odds);
    ASSERT_GT(mixture.zero(), 0u);
    ASSERT_LT(mixture.zero(), 65536u);
    mixture.learn(i / 1000 % 2 != 0 ? mixture.zero() < 32768 : mixture.zero() >= 32768);
    for (const int32_t weight : weights) ASSERT_LE(std::abs(weight), 1 << 20);
  }
}

}  // namespace
}  // namespace tetrakis
