// SPDX-License-Identifier: Apache-2.0
// Maps of priorities: what is written comes back, whatever the bytes are, and coefficients have the
// priorities of the tiles around them.
#include "codec/wavelet/priority_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace tetrakis {
namespace {

using Random = std::mt19937;

PriorityMap randomMap(Random& random) {
  PriorityMap map;
  map.plane = {1 + static_cast<uint32_t>(random() % 300),
               1 + static_cast<uint32_t>(random() % 300)};
  map.tile_log2 = PriorityHeader::kLeastTileLog2 + static_cast<int>(random() % 4);
  map.priorities.resize(size_t{map.columns()} * map.rows());
  const uint32_t most = 1 + random() % kPriorities;
  for (uint8_t& priority : map.priorities) priority = static_cast<uint8_t>(random() % most);
  return map;
}

TEST(PriorityMap, ComesBack) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const PriorityMap map = randomMap(random);
    const PriorityMap decoded = priorityMapOf(headerOf(map), map.plane);
    EXPECT_EQ(decoded.priorities, map.priorities);
    EXPECT_EQ(decoded.tile_log2, map.tile_log2);
  }
  EXPECT_TRUE(headerOf({}).none());
  EXPECT_TRUE(priorityMapOf({}, {9, 9}).empty());
}

TEST(PriorityMap, TakesFewBytesWhereTilesAreAlike) {
  PriorityMap map{{1024, 1024}, 6, std::vector<uint8_t>(256, 0)};
  for (size_t i = 0; i < 32; ++i) map.priorities[i] = 7;
  EXPECT_LT(headerOf(map).code.size(), 16u);
}

TEST(PriorityMap, AnyCodeIsAMap) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const PriorityMap map = randomMap(random);
    PriorityHeader header = headerOf(map);
    if (trial % 2 == 0) header.code.resize(random() % (header.code.size() + 1));
    for (char& byte : header.code)
      if (random() % 4 == 0) byte = static_cast<char>(random());
    const PriorityMap decoded = priorityMapOf(header, map.plane);
    EXPECT_EQ(decoded.priorities.size(), map.priorities.size());
    EXPECT_TRUE(std::all_of(decoded.priorities.begin(), decoded.priorities.end(),
                            [](uint8_t priority) { return priority < kPriorities; }));
  }
}

TEST(PriorityMap, CoefficientsLieBetweenTheTilesAroundThem) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const PriorityMap map = randomMap(random);
    const CoefficientPriorities priorities(map);
    const auto [least, most] = std::minmax_element(map.priorities.begin(), map.priorities.end());
    for (int i = 0; i < 50; ++i) {
      const auto x = static_cast<uint32_t>(random() % map.plane.width);
      const auto y = static_cast<uint32_t>(random() % map.plane.height);
      const uint8_t coarse = priorities.at(x, y, static_cast<int>(random() % 10));
      EXPECT_GE(coarse, *least);
      EXPECT_LE(coarse, *most);
      const size_t tile = size_t{y >> map.tile_log2} * map.columns() + (x >> map.tile_log2);
      EXPECT_EQ(priorities.at(x, y, 0), map.priorities[tile]);
    }
  }
}

TEST(PriorityMap, ErrorsCountOneInTheMean) {
  Random random(4);
  const PriorityMap map = randomMap(random);
  const std::array<double, kPriorities> worth = worthOf(map);
  double sum = 0;
  for (const uint8_t priority : map.priorities) sum += worth[priority];
  EXPECT_NEAR(sum / static_cast<double>(map.priorities.size()), 1, 1e-9);
  EXPECT_EQ(worth[5], 4 * worth[4]);
}

}  // namespace
}  // namespace tetrakis
