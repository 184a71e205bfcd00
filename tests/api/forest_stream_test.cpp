// SPDX-License-Identifier: Apache-2.0
// Streams of heights on forests: what comes back, what patches share, and what is refused.
#include <cmath>

#include "base/forest.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kNone = TKS_BORDER;

/// A surface of patches by its sides.
struct Shape {
  const char* name;
  std::vector<uint32_t> sides;
};

/// The octahedron of the thesis, figure 4.8; a torus of one patch; four patches of a plane; a
/// patch alone; a cylinder; two sides of one corner that are glued, so that one patch meets itself.
const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {"octahedron", {5, 4, 7, 6, 1, 0, 3, 2}},
      {"torus", {2, 3, 0, 1}},
      {"plane",
       {kNone, 7, 8, kNone, kNone, kNone, 12, 1, 2, 15, kNone, kNone, 6, kNone, kNone, 9}},
      {"patch", {kNone, kNone, kNone, kNone}},
      {"cylinder", {kNone, 3, kNone, 1}},
      {"cone", {3, kNone, kNone, 0}}};
  return all;
}

/// Heights on a forest: hills with roughness, the same in all patches that share a sample.
struct Surface {
  Forest forest;
  std::vector<int16_t> samples;

  Surface(const Shape& shape, int depth)
      : forest(depth, shape.sides), samples(forest.raster().samples()) {
    const uint32_t side = forest.side();
    for (uint32_t i = 0; i < samples.size(); ++i) {
      const auto x = static_cast<double>(i % side), y = static_cast<double>(i / side);
      const double hills = 900 * std::sin(x / 9) + 700 * std::cos(y / 11 + x / 23);
      samples[i] = static_cast<int16_t>(std::lround(hills) + samples::hash(i, 3, 5) % 32);
    }
    shareOwned(forest, std::span(samples), side - 1);
  }
  tks_heights heights() const {
    tks_heights h{};
    h.size = sizeof h;
    h.width = forest.raster().width;
    h.height = forest.raster().height;
    h.sample = TKS_I16;
    h.data = samples.data();
    h.scale = 1;
    h.domain = TKS_DOMAIN_FOREST;
    h.forest = {static_cast<uint32_t>(forest.depth()), forest.patches(), forest.sides().data()};
    return h;
  }
};

std::vector<int16_t> decoded(Stream& stream) {
  const std::vector<std::byte> bytes = stream.heights();
  std::vector<int16_t> samples(bytes.size() / 2);
  std::memcpy(samples.data(), bytes.data(), bytes.size());
  return samples;
}

TEST(ForestStream, RestoresEverySampleOfEveryShape) {
  for (const Shape& shape : shapes()) {
    for (int depth = 1; depth <= 6; ++depth) {
      const Surface surface(shape, depth);
      const Bytes bytes = encodeHeights(surface.heights(), lossless());
      Stream stream(bytes);
      ASSERT_EQ(stream.info().domain, TKS_DOMAIN_FOREST);
      ASSERT_EQ(stream.info().forest.patches, surface.forest.patches());
      ASSERT_EQ(decoded(stream), surface.samples) << shape.name << ", depth " << depth;
    }
  }
}

TEST(ForestStream, SaysHowItsSidesAreGlued) {
  for (const Shape& shape : shapes()) {
    const Surface surface(shape, 3);
    const Bytes bytes = encodeHeights(surface.heights(), lossless());
    Stream stream(bytes);
    const tks_forest forest = stream.info().forest;
    ASSERT_EQ(forest.depth, 3u);
    EXPECT_EQ(std::vector<uint32_t>(forest.sides, forest.sides + 4 * forest.patches), shape.sides);
  }
}

TEST(ForestStream, GivesPatchesTheSamplesThatTheyShareAtEveryPrefix) {
  for (const Shape& shape : shapes()) {
    const Surface surface(shape, 5);
    for (const tks_encode_options& options : {lossless(), budget(1500), within(5)}) {
      const Bytes bytes = encodeHeights(surface.heights(), options);
      for (size_t cut = 0; cut <= bytes.size(); cut += 1 + cut / 16) {
        const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(cut));
        tks_decoder* decoder = nullptr;
        if (tks_open(prefix.data(), prefix.size(), nullptr, &decoder, nullptr, 0) != TKS_OK)
          continue;
        tks_close(decoder);
        Stream stream(prefix);
        std::vector<int16_t> samples = decoded(stream), shared = samples;
        shareOwned(surface.forest, std::span(shared), surface.forest.side() - 1);
        ASSERT_EQ(samples, shared) << shape.name << ", " << cut << " bytes";
      }
    }
  }
}

TEST(ForestStream, KeepsTheErrorThatItPromises) {
  for (const Shape& shape : shapes()) {
    const Surface surface(shape, 6);
    const Bytes bytes = encodeHeights(surface.heights(), within(7));
    Stream stream(bytes);
    const std::vector<int16_t> samples = decoded(stream);
    for (size_t i = 0; i < samples.size(); ++i)
      ASSERT_LE(std::abs(samples[i] - surface.samples[i]), 7) << shape.name;
  }
}

TEST(ForestStream, KeepsConstantsAsTheyAre) {
  for (const Shape& shape : shapes()) {
    Surface surface(shape, 5);
    std::fill(surface.samples.begin(), surface.samples.end(), int16_t{123});
    const Bytes bytes = encodeHeights(surface.heights(), budget(400));
    Stream stream(bytes);
    EXPECT_EQ(decoded(stream), surface.samples) << shape.name;
  }
}

}  // namespace
}  // namespace tetrakis::test
