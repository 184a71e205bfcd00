// SPDX-License-Identifier: Apache-2.0
// Paths through the plane of heights and textures.
#include "apps/tools/report/pair_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "apps/tools/synth/synth.hpp"

namespace tetrakis::tools {
namespace {

/// Squared errors a / heights + b / texture, of which exhaustive search and marginal analysis know
/// the answer: bytes shared as the roots of a and b.
PairPlane separable(double a, double b, size_t rates) {
  PairPlane plane;
  for (size_t i = 0; i < rates; ++i) {
    plane.heights.push_back(64ull << i);
    plane.textures.push_back(64ull << i);
  }
  for (const uint64_t heights : plane.heights)
    for (const uint64_t texture : plane.textures)
      plane.psnr.push_back(
          -10 * std::log10(a / static_cast<double>(heights) + b / static_cast<double>(texture)));
  return withPaths(std::move(plane));
}

PairPlane rising(std::mt19937& random, size_t heights, size_t textures) {
  std::uniform_real_distribution<double> step(0.01, 3);
  PairPlane plane;
  for (size_t i = 0; i < heights; ++i) plane.heights.push_back(100 * (i + 1));
  for (size_t i = 0; i < textures; ++i) plane.textures.push_back(130 * (i + 1));
  for (size_t h = 0; h < heights; ++h)
    for (size_t t = 0; t < textures; ++t) {
      const double west = h > 0 ? plane.at(h - 1, t) : 10, south = t > 0 ? plane.psnr.back() : 10;
      plane.psnr.push_back(std::max(west, south) + step(random));
    }
  return withPaths(std::move(plane));
}

void expectPaths(const PairPlane& plane) {
  ASSERT_FALSE(plane.hull.empty());
  for (size_t i = 1; i < plane.hull.size(); ++i) {
    EXPECT_GT(plane.hull[i].split.total(), plane.hull[i - 1].split.total());
    EXPECT_GT(plane.hull[i].psnr, plane.hull[i - 1].psnr);
  }
  const size_t steps = plane.heights.size() + plane.textures.size() - 1;
  ASSERT_EQ(plane.greedy.size(), steps);
  EXPECT_LE(plane.looked, 2 * steps);
  EXPECT_EQ(plane.greedy.front().split, (Split{plane.heights.back(), plane.textures.back()}));
  EXPECT_EQ(plane.greedy.back().split, (Split{plane.heights.front(), plane.textures.front()}));
  for (size_t i = 1; i < steps; ++i) {
    const Split &before = plane.greedy[i - 1].split, &after = plane.greedy[i].split;
    EXPECT_NE(before.heights == after.heights, before.texture == after.texture);
    EXPECT_LT(after.total(), before.total());
  }
}

TEST(PairPlane, PathsOfAnyPlane) {
  std::mt19937 random(7);
  for (const size_t heights : {1, 2, 7})
    for (const size_t textures : {1, 3, 8}) expectPaths(rising(random, heights, textures));
}

TEST(PairPlane, NoPairIsBelowTheHull) {
  std::mt19937 random(8);
  const PairPlane plane = rising(random, 6, 9);
  const auto square = [](double psnr) { return std::pow(10, -psnr / 10); };
  for (size_t i = 1; i < plane.hull.size(); ++i) {
    const SeenPair &a = plane.hull[i - 1], &b = plane.hull[i];
    for (size_t h = 0; h < plane.heights.size(); ++h)
      for (size_t t = 0; t < plane.textures.size(); ++t) {
        const uint64_t bytes = plane.heights[h] + plane.textures[t];
        if (bytes < a.split.total() || bytes > b.split.total()) continue;
        const double way = static_cast<double>(bytes - a.split.total()) /
                           static_cast<double>(b.split.total() - a.split.total());
        const double chord = square(a.psnr) + way * (square(b.psnr) - square(a.psnr));
        EXPECT_GE(square(plane.at(h, t)), chord * (1 - 1e-9));
      }
  }
}

TEST(PairPlane, MarginalAnalysisFollowsTheBestSplit) {
  const PairPlane plane = separable(16, 1, 12);  // four times as many bytes for the heights
  expectPaths(plane);
  for (const SeenPair& pair : plane.greedy) {
    if (pair.split.heights == plane.heights.back() || pair.split.texture == plane.textures.front())
      continue;
    const double ratio =
        static_cast<double>(pair.split.heights) / static_cast<double>(pair.split.texture);
    EXPECT_GE(ratio, 2);
    EXPECT_LE(ratio, 8);
  }
}

TEST(PairPlane, ExactPairsEndTheHull) {
  std::mt19937 random(9);
  PairPlane exact = rising(random, 4, 4);
  exact.psnr.back() = std::numeric_limits<double>::infinity();
  const PairPlane plane = withPaths(std::move(exact));
  expectPaths(plane);
  EXPECT_TRUE(std::isinf(plane.hull.back().psnr));
}

/// Tracks that are decoded once, and textures that are drawn at once, give what each stream of two
/// prefixes gives by itself, but for the rounding of a graphics card's driver.
TEST(PairPlane, PairsAreStreamsOfTheirPrefixes) {
  SynthOptions options;
  options.size = 65;
  SynthTerrain terrain = synthesize(options);
  const Reference original{std::move(terrain.heights), std::move(terrain.texture)};
  const tks_heights heights = asHeights(*original.heights);
  const tks_image image = asImage(*original.image);
  tks_encode_options target = makeEncodeOptions();
  target.bytes = 6000;
  const Result<Buffer> stream = encode(&heights, &image, target);
  ASSERT_TRUE(stream.ok());
  const Result<Decoder> decoder = Decoder::open(stream->bytes());
  ASSERT_TRUE(decoder.ok());
  Result<Comparer> comparer = Comparer::create(original, decoder->info());
  ASSERT_TRUE(comparer.ok() && comparer->look({"", "all"}).ok());
  const Result<SplitStream> tracks = SplitStream::take(stream->bytes());
  ASSERT_TRUE(tracks.ok());
  std::vector<double> progress;
  const auto tell = [&](double done) { progress.push_back(done); };
  const Result<PairPlane> plane = lookAtPairs(*comparer, *tracks, {.most = 3, .ratio = 3}, 0, tell);
  ASSERT_TRUE(plane.ok());
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()) && progress.back() == 1);
  for (size_t h = 0; h < plane->heights.size(); ++h)
    for (size_t t = 0; t < plane->textures.size(); ++t) {
      const std::vector<uint8_t> cut = tracks->cut({plane->heights[h], plane->textures[t]});
      const Result<Measurement> seen = comparer->measure(cut, 0);
      ASSERT_TRUE(seen.ok());
      EXPECT_NEAR(plane->at(h, t), *seen->screen_psnr, 0.01) << h << ", " << t;
    }
}

}  // namespace
}  // namespace tetrakis::tools
