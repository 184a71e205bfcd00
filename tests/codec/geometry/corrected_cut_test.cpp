// SPDX-License-Identifier: Apache-2.0
// Cuts of coefficients with corrections behind them.
#include "codec/geometry/coding_choice/cuts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"

namespace tetrakis::test {
namespace {

constexpr Extent kRough = {120, 90};

/// Noisy waves, and their coefficients.
class CorrectedCuts : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 6);
    for (uint32_t y = 0; y < kRough.height; ++y)
      for (uint32_t x = 0; x < kRough.width; ++x)
        steps_.steps.push_back(
            static_cast<int32_t>(400 * std::sin(0.05 * x) * std::cos(0.07 * y) + noise(random)));
    steps_.range_bits = 10;
    const PlaneView<const int32_t> plane(steps_.steps, kRough);
    header_.width = kRough.width;
    header_.height = kRough.height;
    header_.wavelet = chooseWavelet(plane, steps_.range_bits, Purpose::kLossy);
    track_ = encodeCoefficients(plane, header_.wavelet, {}).front();
    header_.planes = static_cast<uint8_t>(track_.planes);
  }

  CorrectedCut cuts(int32_t largest) const { return {steps_, flat_, header_, track_, largest}; }

  HeightSteps steps_;
  const FlatAreas flat_{};
  GeometryHeader header_;
  EncodedTrack track_;
};

/// What is remembered of some cuts is nothing that others would not find out by themselves.
TEST_F(CorrectedCuts, RememberNothingThatIsNotSo) {
  std::mt19937 random(8);
  std::uniform_int_distribution<uint64_t> any(0, track_.codeword.size());
  for (const int32_t largest : {0, 2, 9}) {
    CorrectedCut remembering = cuts(largest);
    for (int i = 0; i < 40; ++i) {
      const uint64_t bytes = any(random);
      CorrectedCut fresh = cuts(largest);
      ASSERT_EQ(remembering.total(bytes), fresh.total(bytes)) << bytes;
      ASSERT_EQ(remembering.correct(bytes).codewords, fresh.correct(bytes).codewords) << bytes;
    }
  }
}

/// What is foretold of the bytes behind a cut is near what they take. Coarse cuts take fewer bytes
/// than foretold, since their corrections tell of each other by more than the entropy counts.
TEST_F(CorrectedCuts, TotalsAreNearlyTrue) {
  for (const int32_t largest : {1, 4, 20}) {
    CorrectedCut cut = cuts(largest);
    for (const double rmse : {0.3, 0.45, 0.7, 1.5}) {
      const uint64_t bytes = cut.bytesFor(rmse * rmse * largest * largest);
      const auto taken = static_cast<double>(bytes + bytesOf(cut.correct(bytes).codewords));
      const auto total = static_cast<double>(cut.total(bytes));
      EXPECT_GT(total, 0.95 * taken) << largest << ", " << rmse;
      EXPECT_LT(total, (rmse < 0.5 ? 1.05 : 1.2) * taken) << largest << ", " << rmse;
    }
  }
}

/// The best cut has no better neighbour, unless a rival is out of reach.
TEST_F(CorrectedCuts, BestIsBestAboutItself) {
  for (const int32_t largest : {1, 4, 20}) {
    CorrectedCut cut = cuts(largest);
    const uint64_t best = cut.best(UINT64_MAX), least = cut.total(best);
    for (const double factor : {1 / 1.3, 1 / 1.1, 1 / 1.04, 1.04, 1.1, 1.3}) {
      const auto other = std::min<uint64_t>(
          static_cast<uint64_t>(factor * static_cast<double>(best)), track_.codeword.size());
      EXPECT_GE(cut.total(other), least) << largest << ", " << factor;
    }
    CorrectedCut beside = cuts(largest);
    const uint64_t near_enough = beside.best(1);
    EXPECT_GE(beside.total(near_enough), least);
    EXPECT_LE(static_cast<double>(beside.total(near_enough)), 1.1 * static_cast<double>(least));
  }
}

}  // namespace
}  // namespace tetrakis::test
