// SPDX-License-Identifier: Apache-2.0
// Bridges over voids: which samples are lifted, what stands at voids, and what encoders choose.
#include <gtest/gtest.h>

#include <algorithm>

#include "codec/wavelet/choice/bridge_choice.hpp"
#include "codec/wavelet/morphology.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::validity;
using samples::VoidShape;

/// What FORMAT.md says, sample by sample.
std::vector<uint8_t> closing(const std::vector<uint8_t>& valid, Extent plane, int reach) {
  const auto all = [&](const std::vector<uint8_t>& marks, int x, int y, auto&& pred) {
    for (int v = std::max(y - reach, 0); v <= std::min<int>(y + reach, plane.height - 1); ++v)
      for (int u = std::max(x - reach, 0); u <= std::min<int>(x + reach, plane.width - 1); ++u)
        if (!pred(marks[size_t(v) * plane.width + u])) return false;
    return true;
  };
  std::vector<uint8_t> near, closed;
  for (int y = 0; y < int(plane.height); ++y)
    for (int x = 0; x < int(plane.width); ++x)
      near.push_back(!all(valid, x, y, [](uint8_t mark) { return mark == 0; }));
  for (int y = 0; y < int(plane.height); ++y)
    for (int x = 0; x < int(plane.width); ++x)
      closed.push_back(all(near, x, y, [](uint8_t mark) { return mark != 0; }));
  return closed;
}

TEST(Bridges, LiftTheClosingOfValidSamples) {
  for (const Size& size : kMaskedSizes) {
    if (size.count() > 4000) continue;
    for (const VoidShape shape : kVoidShapes) {
      const Extent plane{size.width, size.height};
      const std::vector<uint8_t> valid = validity(shape, size.width, size.height);
      for (const int reach : {1, 2, 3, 9, 254}) {
        std::vector<uint8_t> lifted = liftedSamples(valid, plane, static_cast<uint8_t>(reach));
        if (lifted.empty()) lifted.assign(plane.samples(), 1);
        ASSERT_EQ(lifted, closing(valid, plane, reach)) << size << ", " << shape << ", " << reach;
      }
    }
  }
}

TEST(Bridges, OfNoReachAreNoneAndOfTheLongestAll) {
  const std::vector<uint8_t> valid = validity(VoidShape::kHalf, 20, 10);
  EXPECT_EQ(liftedSamples(valid, {20, 10}, 0), valid);
  EXPECT_TRUE(liftedSamples(valid, {20, 10}, kBridgeAll).empty());
}

TEST(Bridges, HoldNothingBeyondTheRangeOfValidSamples) {
  Random random(4);
  for (const Size& size : kMaskedSizes) {
    for (const VoidShape shape : kVoidShapes) {
      const Extent plane{size.width, size.height};
      const std::vector<uint8_t> valid = validity(shape, size.width, size.height);
      const Plane values = randomPlane(random, size.count(), -(1 << 25), 1 << 25);
      const std::vector<int32_t> filled = bridged({values, plane, valid}, {});
      if (std::count(valid.begin(), valid.end(), 1) == 0) continue;
      int32_t least = INT32_MAX, most = INT32_MIN;
      for (size_t i = 0; i < values.size(); ++i) {
        if (!valid[i]) continue;
        ASSERT_EQ(filled[i], values[i]);
        least = std::min(least, values[i]);
        most = std::max(most, values[i]);
      }
      for (const int32_t value : filled) {
        ASSERT_GE(value, least);
        ASSERT_LE(value, most);
      }
    }
  }
}

TEST(Bridges, GoOnWithASlope) {
  const Extent plane{40, 30};
  std::vector<int32_t> slope;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) slope.push_back(100 * x + 37 * y);
  const std::vector<uint8_t> valid = validity(VoidShape::kSpeckle, 40, 30);
  const std::vector<int32_t> filled = bridged({slope, plane, valid}, {});
  for (uint32_t y = 2; y + 2 < plane.height; ++y)
    for (uint32_t x = 2; x + 2 < plane.width; ++x)
      ASSERT_NEAR(filled[y * 40 + x], slope[y * 40 + x], 25) << x << ", " << y;
}

TEST(Bridges, AreChosenOverHolesAndNotOverAFrame) {
  const Extent plane{200, 160};
  std::vector<int32_t> hills;
  for (uint32_t y = 0; y < plane.height; ++y)
    for (uint32_t x = 0; x < plane.width; ++x)
      hills.push_back(samples::valueNoise(x, y, 5, 3) / 16);
  for (const Purpose purpose : {Purpose::kLossless, Purpose::kLossy}) {
    const BridgeTarget target{purpose, 4000};
    const std::vector<uint8_t> holes = validity(VoidShape::kSpeckle, plane.width, plane.height);
    EXPECT_GT(chooseBridges({hills, plane, holes}, 13, target).reach, 0);
    const std::vector<uint8_t> half = validity(VoidShape::kHalf, plane.width, plane.height);
    EXPECT_EQ(chooseBridges({hills, plane, half}, 13, target).reach, 0);
    const std::vector<uint8_t> nothing = validity(VoidShape::kAll, plane.width, plane.height);
    EXPECT_EQ(chooseBridges({hills, plane, nothing}, 13, target).reach, 0);
  }
}

}  // namespace
}  // namespace tetrakis::test
