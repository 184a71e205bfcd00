// SPDX-License-Identifier: Apache-2.0
// The sample terrain: the same bytes everywhere, and what it promises to show.
#include "apps/tools/synth/synth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <span>
#include <vector>

#include "apps/tools/synth/drainage.hpp"
#include "apps/tools/synth/parcels.hpp"
#include "tests/support/synth_digest.hpp"

namespace tetrakis::tools {
namespace {

std::vector<uint16_t> samplesOf(const HeightFile& heights) {
  std::vector<uint16_t> samples(heights.data.size() / 2);
  std::memcpy(samples.data(), heights.data.data(), heights.data.size());
  return samples;
}

TEST(Synth, MakesTheSameBytesEverywhere) {
  EXPECT_EQ(test::digest(synthesize({65, 7})), 0x4034d9316f42ecb5u);
  EXPECT_EQ(test::digest(synthesize({150, 1})), 0xb7f0748379c5bd7du);
}

TEST(Synth, HasTheStatedShape) {
  for (const uint32_t size : {2u, 3u, 4u, 5u, 9u, 16u, 50u}) {
    const SynthTerrain terrain = synthesize({size, size});
    const HeightFile& heights = terrain.heights;
    EXPECT_EQ(heights.width, size);
    EXPECT_EQ(heights.height, size);
    EXPECT_EQ(heights.sample, TKS_U16);
    EXPECT_EQ(heights.data.size(), size_t{2} * size * size);
    EXPECT_EQ(heights.scale, 0.1);
    EXPECT_EQ(heights.offset, 0);
    EXPECT_EQ(heights.spacing_x, 30);
    EXPECT_EQ(heights.spacing_y, 30);
    EXPECT_EQ(heights.unit, "m");
    EXPECT_EQ(heights.vertical_datum, "");
    EXPECT_EQ(terrain.texture.width, 2 * (size - 1));
    EXPECT_EQ(terrain.texture.height, 2 * (size - 1));
    EXPECT_EQ(terrain.texture.channels, 3u);
    EXPECT_EQ(terrain.texture.sample, TKS_U8);
    EXPECT_EQ(terrain.texture.data.size(), size_t{12} * (size - 1) * (size - 1));
  }
}

TEST(Synth, MapsHaveFewColours) {
  const SynthTerrain terrain = synthesize({129, 1});
  const std::vector<std::byte>& map = terrain.map.data;
  ASSERT_EQ(map.size(), terrain.texture.data.size());
  std::set<std::array<std::byte, 3>> colours;
  for (size_t i = 0; i < map.size(); i += 3) colours.insert({map[i], map[i + 1], map[i + 2]});
  EXPECT_GE(colours.size(), 5u);
  EXPECT_LE(colours.size(), 11u);
}

TEST(Synth, SeedsDiffer) {
  std::vector<uint64_t> digests;
  for (const uint64_t seed : {uint64_t{0}, uint64_t{1}, uint64_t{2}, ~uint64_t{0}})
    digests.push_back(test::digest(synthesize({33, seed})));
  std::sort(digests.begin(), digests.end());
  EXPECT_TRUE(std::unique(digests.begin(), digests.end()) == digests.end());
}

/// Samples of the largest side-connected area of one level at `level` or above.
size_t largestLevelArea(const std::vector<uint16_t>& samples, uint32_t size, uint16_t level) {
  std::vector<bool> seen(samples.size());
  size_t largest = 0;
  for (size_t start = 0; start < samples.size(); ++start) {
    if (seen[start] || samples[start] < level) continue;
    std::vector<size_t> open{start};
    seen[start] = true;
    size_t area = 0;
    while (!open.empty()) {
      const size_t at = open.back();
      open.pop_back();
      ++area;
      const auto visit = [&](bool inside, size_t next) {
        if (!inside || seen[next] || samples[next] != samples[start]) return;
        seen[next] = true;
        open.push_back(next);
      };
      visit(at % size > 0, at - 1);
      visit(at % size + 1 < size, at + 1);
      visit(at >= size, at - size);
      visit(at + size < samples.size(), at + size);
    }
    largest = std::max(largest, area);
  }
  return largest;
}

class SynthScene : public testing::TestWithParam<uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, SynthScene, testing::Values(1, 2, 3));

TEST_P(SynthScene, HasSeaPlainLakeAndMountains) {
  constexpr uint32_t kSize = 161;
  const std::vector<uint16_t> samples = samplesOf(synthesize({kSize, GetParam()}).heights);
  size_t sea = 0, level_ground = 0, steep = 0;
  uint16_t highest = 0;
  for (uint32_t y = 0; y + 1 < kSize; ++y) {
    for (uint32_t x = 0; x + 1 < kSize; ++x) {
      const size_t at = size_t{y} * kSize + x;
      highest = std::max(highest, samples[at]);
      if (samples[at] == 0) {
        ++sea;
        continue;
      }
      const double east = (samples[at + 1] - samples[at]) * 0.1 / 30;
      const double south = (samples[at + kSize] - samples[at]) * 0.1 / 30;
      const double slope = std::sqrt(east * east + south * south);
      level_ground += slope < 0.05;
      steep += slope > 0.3;
    }
  }
  const double all = (kSize - 1) * (kSize - 1);
  EXPECT_GT(static_cast<double>(sea) / all, 0.03);
  EXPECT_LT(static_cast<double>(sea) / all, 0.4);
  EXPECT_GT(static_cast<double>(level_ground) / all, 0.1);
  EXPECT_GT(static_cast<double>(steep) / all, 0.1);
  EXPECT_GT(highest, 3000);                                              // 300 m over 4.8 km
  EXPECT_GT(largestLevelArea(samples, kSize, 1), samples.size() / 200);  // the lake
}

TEST_P(SynthScene, TextureHasTheStatisticsOfAPhotograph) {
  const ImageFile texture = synthesize({129, GetParam()}).texture;
  double sum = 0, squares = 0, products = 0, count = 0;
  for (uint32_t y = 0; y < texture.height; ++y) {
    for (uint32_t x = 0; x + 1 < texture.width; ++x) {
      const size_t at = 3 * (size_t{y} * texture.width + x) + 1;
      const double a = std::to_integer<int>(texture.data[at]);
      const double b = std::to_integer<int>(texture.data[at + 3]);
      sum += a;
      squares += a * a;
      products += a * b;
      count += 1;
    }
  }
  const double mean = sum / count, variance = squares / count - mean * mean;
  const double correlation = (products / count - mean * mean) / variance;
  EXPECT_GT(mean, 50);
  EXPECT_LT(mean, 160);
  EXPECT_GT(std::sqrt(variance), 15);
  EXPECT_GT(correlation, 0.85);   // neither noise
  EXPECT_LT(correlation, 0.995);  // nor a gradient
}

TEST(SynthDrainage, LeadsEveryCellDownToAnOutlet) {
  constexpr uint32_t kSide = 40;
  synth::Grid height(kSide);
  synth::Raster<uint8_t> outlet(kSide);
  for (uint32_t cell = 0; cell < height.size(); ++cell) {
    height[cell] = std::floor(8 * synth::unitHash(5, cell, 0));  // many pits and flats
    outlet[cell] = cell % 397 == 7;
  }
  const synth::Drainage drainage = synth::drain(height, outlet);
  std::vector<bool> visited(height.size());
  size_t drained = 0, cells = 0;
  synth::forUpstream(drainage.receiver, [&](uint32_t cell) {
    ++cells;
    EXPECT_FALSE(visited[cell]);
    visited[cell] = true;
    const uint32_t to = drainage.receiver[cell];
    EXPECT_TRUE(visited[to]) << cell;
    EXPECT_EQ(to == cell, outlet[cell] != 0);
    EXPECT_GE(drainage.level[cell], height[cell]);
    EXPECT_LE(drainage.level[to], drainage.level[cell]);
    if (to == cell) drained += drainage.area[cell];
  });
  EXPECT_EQ(cells, height.size());
  EXPECT_EQ(drained, height.size());
}

TEST(SynthDrainage, FillsAPitToItsPass) {
  synth::Grid height(5, 9.0);
  height.at(2, 2) = 1;  // pit
  height.at(3, 2) = 4;  // its pass
  height.at(4, 2) = 0;  // outlet
  synth::Raster<uint8_t> outlet(5);
  outlet.at(4, 2) = 1;
  const synth::Drainage drainage = synth::drain(height, outlet);
  EXPECT_EQ(drainage.level.at(2, 2), 4);
  EXPECT_EQ(drainage.receiver.at(2, 2), 2u * 5 + 3);
  EXPECT_EQ(drainage.area.at(4, 2), 25u);
}

TEST(SynthDrainage, WithoutOutletsUsesTheLowestCell) {
  synth::Grid height(3, 2.0);
  height.at(1, 0) = 1;
  const synth::Drainage drainage = synth::drain(height, synth::Raster<uint8_t>(3));
  EXPECT_EQ(drainage.receiver[1], 1u);
  EXPECT_EQ(drainage.area.at(1, 0), 9u);
}

TEST(SynthParcels, BoundariesAreWhereParcelsMeet) {
  int boundaries = 0;
  for (int i = 0; i < 20000; ++i) {
    const synth::Point p{5000 * synth::unitHash(1, i, 0), 5000 * synth::unitHash(1, i, 1)};
    const synth::Parcel here = synth::parcelAt(3, p);
    const synth::Parcel there = synth::parcelAt(3, {p.x + 1, p.y});
    EXPECT_GE(here.edge, 0);
    if (here.id == there.id) continue;
    ++boundaries;
    EXPECT_LT(here.edge, 1.5);
    EXPECT_LT(there.edge, 1.5);
  }
  EXPECT_GT(boundaries, 50);
}

}  // namespace
}  // namespace tetrakis::tools
