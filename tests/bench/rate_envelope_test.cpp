// SPDX-License-Identifier: Apache-2.0
// Bytes at an error, of what was coded with many settings.
#include "bench/meshes/rate_envelope.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tetrakis::bench {
namespace {

TEST(RateEnvelopes, AreStraightBetweenLogarithms) {
  const std::vector<ErrorCurve> curves{{{1, 1600}, {4, 100}}};
  EXPECT_NEAR(*costAt(curves, 2), 400, 1e-9);
  EXPECT_NEAR(*costAt(curves, 1), 1600, 1e-9);
  EXPECT_NEAR(*costAt(curves, 4), 100, 1e-9);
}

TEST(RateEnvelopes, EndWhereCurvesEnd) {
  const std::vector<ErrorCurve> curves{{{4, 100}, {1, 1600}}, {{9, 10}, {8, 20}}, {{20, 5}}, {}};
  for (const double error : {0.99, 4.01, 7.9, 9.1, 20.0}) EXPECT_FALSE(costAt(curves, error));
  for (const double error : {1.01, 3.9, 8.1}) EXPECT_TRUE(costAt(curves, error));
  EXPECT_FALSE(costAt({}, 1));
}

TEST(RateEnvelopes, TakeTheLeastOfAllCurves) {
  EXPECT_NEAR(*costAt({{{1, 1600}, {4, 100}}, {{1, 900}, {4, 300}}}, 4), 100, 1e-9);
  EXPECT_NEAR(*costAt({{{1, 1600}, {4, 100}}, {{1, 900}, {4, 300}}}, 1), 900, 1e-9);
  EXPECT_NEAR(*costAt({{{1, 1600}, {4, 100}}, {{0.5, 50}}}, 2), 50, 1e-9);
}

TEST(RateEnvelopes, AreNoMoreThanWhatServes) {
  std::mt19937 random(3);
  const auto draw = [&random] { return 1 + double(random() % 64); };
  for (int round = 0; round < 50; ++round) {
    std::vector<ErrorCurve> curves(3);
    for (ErrorCurve& curve : curves)
      for (int i = 0; i < 8; ++i) curve.push_back({draw(), draw()});
    for (double error = 1; error <= 64; ++error) {
      const auto bytes = costAt(curves, error);
      for (const ErrorCurve& curve : curves)
        for (const ErrorPoint& point : curve)
          EXPECT_TRUE(!bytes || point.error > error || *bytes <= point.cost * (1 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace tetrakis::bench
