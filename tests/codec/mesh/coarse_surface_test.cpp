// SPDX-License-Identifier: Apache-2.0
// Coarse surfaces and where they lie in the whole.
#include "codec/mesh/surface/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tests/support/closed_sets.hpp"

namespace tetrakis {
namespace {

constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{33, 33}, {34, 33}, {40, 65},
                                                    {61, 38}, {90, 17}, {18, 31}};

int32_t planeAt(uint32_t sample, uint32_t width) {
  return 700 * static_cast<int32_t>(sample % width) - 300 * static_cast<int32_t>(sample / width);
}

std::vector<int32_t> plane(uint32_t width, uint32_t height) {
  std::vector<int32_t> heights;
  for (uint32_t i = 0; i < width * height; ++i) heights.push_back(planeAt(i, width));
  return heights;
}

void expectPlane(const CoarseSurface& coarse, uint32_t width, uint32_t height, uint32_t k) {
  ASSERT_EQ(coarse.heights.size(), size_t{coarse.width} * coarse.height);
  for (uint32_t i = 0; i < coarse.heights.size(); ++i)
    EXPECT_EQ(coarse.heights[i], planeAt(wholeSample(i, coarse.width, width, height, k), width));
}

/// Every 2^k-th sample and no others.
std::vector<int32_t> levelOf(const std::vector<int32_t>& heights, uint32_t width, uint32_t k) {
  std::vector<int32_t> level;
  for (size_t y = 0; y < heights.size() / width; y += size_t{1} << k)
    for (uint32_t x = 0; x < width; x += 1u << k) level.push_back(heights[y * width + x]);
  return level;
}

TEST(CoarseSurface, PlanesStayWhereTheyAre) {
  for (const auto& [width, height] : kSizes) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    const std::vector<int32_t> heights = plane(width, height);
    expectPlane(smoothed({width, height, heights}), width, height, 1);
    for (uint32_t k = 0; k < 4; ++k) {
      expectPlane(coarsen({width, height, heights}, k), width, height, k);
      expectPlane(ofMipLevel(levelOf(heights, width, k), width, height, k), width, height, k);
    }
  }
}

TEST(CoarseSurface, LatticesAreTheCoarsePartOfTheWhole) {
  std::minstd_rand random(1);
  for (const auto& [width, height] : kSizes)
    for (uint32_t k = 1; k < 4; ++k) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", level " << k);
      const std::vector<int32_t> heights = plane(width, height);
      const CoarseSurface coarse = coarsen({width, height, heights}, k);
      const Lattice whole = *Lattice::make(width, height);
      const Lattice part = *Lattice::make(coarse.width, coarse.height);
      std::vector<VertexId> seeds;
      for (VertexId v = 0; v < part.vertexCount(); ++v)
        if (random() % 5 == 0) seeds.push_back(v);
      const std::vector<VertexId> set = closureOf(part, seeds);
      EXPECT_EQ(set, closureOf(whole, seeds));
      const LatticeMesh expected = meshOf(whole, set);
      LatticeMesh mesh = meshOf(part, set);
      for (uint32_t& v : mesh.vertices) v = wholeSample(v, coarse.width, width, height, k);
      EXPECT_EQ(mesh.vertices, expected.vertices);
      EXPECT_EQ(mesh.triangles, expected.triangles);
    }
}

TEST(CoarseSurface, MeansLieBetweenTheirSamples) {
  std::minstd_rand random(2);
  std::vector<int32_t> heights(35 * 21);
  for (int32_t& h : heights) h = random() % 2 ? std::numeric_limits<int32_t>::max() : -5;
  const CoarseSurface means = smoothed({35, 21, heights});
  EXPECT_EQ(means.width, 18u);
  EXPECT_EQ(means.height, 11u);
  const auto [low, high] = std::minmax_element(means.heights.begin(), means.heights.end());
  EXPECT_GE(*low, -5);
  EXPECT_GT(*high, std::numeric_limits<int32_t>::max() / 2);
}

TEST(CoarseSurface, WildHeightsGoOnWithinTheirType) {
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max(),
                    kLeast = std::numeric_limits<int32_t>::min();
  std::vector<int32_t> level;  // level 2 of 16 x 16
  for (int i = 0; i < 16; ++i) level.push_back(i % 4 == 2 ? kLeast : kMost);
  const CoarseSurface coarse = ofMipLevel(level, 16, 16, 2);
  EXPECT_EQ(coarse.width, 5u);
  for (uint32_t y = 0; y < coarse.height; ++y) EXPECT_EQ(coarse.heights[5 * y + 4], kMost);
}

}  // namespace
}  // namespace tetrakis
