// SPDX-License-Identifier: Apache-2.0
// Whole streams of heights of few values in large shapes, which are drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/few_values.hpp"
#include "conformance/samples/patches.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::patches;
using samples::Pattern;
using samples::Raster;

Bytes encodeWithVoids(Raster& heights, samples::VoidShape shape) {
  const std::vector<uint8_t> valid = samples::validity(shape, heights.width, heights.height);
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) heights.data[i] = std::byte{255};
  }
  tks_heights given = heights.heights();
  given.has_nodata = 1;
  given.nodata = 255;
  return encodeHeights(given, lossless());
}

/// Heights that the encoder draws: plain, beside voids, with a table, with corrections of samples.
struct DrawnKind {
  std::string name;
  Raster heights;
  Bytes stream;
};

std::vector<DrawnKind> drawnKinds(uint32_t width, uint32_t height) {
  const Raster plain = patches(width, height);
  std::vector<DrawnKind> kinds = {{"plain", plain, encode(&plain, nullptr, lossless())}};
  Raster holed = plain;
  const Bytes beside = encodeWithVoids(holed, samples::VoidShape::kCoast);
  kinds.push_back({"voids", holed, beside});
  for (const samples::FewValues kind : {samples::FewValues::kRescaled, samples::FewValues::kRare}) {
    const Raster floats = samples::withFewValues(plain, kind);
    kinds.push_back({"floats", floats, encode(&floats, nullptr, lossless())});
  }
  return kinds;
}

TEST(DrawnHeights, ComeBackExactly) {
  for (const auto& [width, height] : {std::pair{70u, 53u}, {2u, 300u}, {301u, 9u}, {128u, 129u}}) {
    const Raster heights = patches(width, height);
    const Bytes stream = encode(&heights, nullptr, lossless());
    EXPECT_EQ(Stream(stream).info().heights_drawn, 1) << width;
    EXPECT_EQ(Stream(stream).info().lossless, 1);
    EXPECT_TRUE(Stream(stream).heights() == heights.data) << width;
  }
  for (const DrawnKind& kind : drawnKinds(90, 81)) {
    EXPECT_EQ(Stream(kind.stream).info().heights_drawn, 1) << kind.name;
    EXPECT_TRUE(Stream(kind.stream).heights() == kind.heights.data) << kind.name;
  }
}

/// Lossy coefficients of classes ring, and may never reach what a drawing has from the start.
TEST(DrawnHeights, NoTargetTakesMoreBytesThanTheLastBit) {
  for (const DrawnKind& kind : drawnKinds(61, 50)) {
    if (kind.name == "voids") continue;  // its nodata value is not in the raster
    SCOPED_TRACE(kind.name);
    const size_t least = kind.stream.size(), most = least + 16;
    for (const size_t bytes : {most, 4 * least}) {
      const Bytes stream = encode(&kind.heights, nullptr, budget(bytes));
      EXPECT_LE(stream.size(), most) << bytes;
      EXPECT_TRUE(Stream(stream).heights() == kind.heights.data) << bytes;
    }
    tks_encode_options psnr = budget(0), bound = budget(0);
    psnr.psnr = 70;
    bound.max_error = 0.4;
    EXPECT_LE(encode(&kind.heights, nullptr, psnr).size(), most);
    EXPECT_LE(encode(&kind.heights, nullptr, bound).size(), most);
  }
}

/// Of all bytes the texture gets those that the drawing leaves.
/// Budgets that hold most of the exact heights are no further from the samples than that part.
TEST(DrawnHeights, BudgetsBelowTheLastBitAreAsGoodAsItsPrefixes) {
  const Raster heights = patches(200, 160);
  const Bytes exact = encode(&heights, nullptr, lossless());
  for (const double part : {0.8, 0.9, 0.97}) {
    const auto bytes = static_cast<size_t>(part * static_cast<double>(exact.size()));
    Stream made(encode(&heights, nullptr, budget(bytes))), cut(Prefix(exact).first(bytes));
    EXPECT_LE(squaredError(heights, made.heights()), 1.05 * squaredError(heights, cut.heights()))
        << part;
  }
}

TEST(DrawnHeights, AreExactBesideATexture) {
  const Raster heights = patches(90, 81);
  const Raster image = make({Pattern::kRidges, 90, 81, 3, TKS_U8, 9});
  const size_t drawing = encode(&heights, nullptr, lossless()).size();
  const Bytes stream = encode(&heights, &image, budget(8 * drawing));
  EXPECT_LE(stream.size(), 8 * drawing);
  EXPECT_EQ(Stream(stream).info().heights_drawn, 1);
  EXPECT_TRUE(Stream(stream).heights() == heights.data);
}

TEST(DrawnHeights, TerrainIsNot) {
  for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_F32}) {
    const Raster ridges = make({Pattern::kRidges, 90, 81, 1, sample, 3});
    EXPECT_EQ(Stream(encode(&ridges, nullptr, lossless())).info().heights_drawn, 0);
  }
  const Raster ramp = make({Pattern::kRamp, 90, 81, 1, TKS_I16, 3});
  EXPECT_EQ(Stream(encode(&ramp, nullptr, lossless())).info().heights_drawn, 0);
}

TEST(DrawnHeights, DecodeAsTheReferenceDoesInAllPrefixesAndLevels) {
  for (const DrawnKind& kind : drawnKinds(61, 50)) {
    SCOPED_TRACE(kind.name);
    for (size_t n = readHeader(kind.stream)->bytes; n <= kind.stream.size(); n += n % 17 + 1) {
      const Prefix prefix = Prefix(kind.stream).first(n);
      for (const uint32_t level : {0u, 2u}) {
        Stream decoded(prefix);
        ASSERT_EQ(tks_set_levels(decoded.get(), level, 0), TKS_OK);
        const size_t samples = size_t{(60u >> level) + 1} * ((49u >> level) + 1);
        std::vector<uint8_t> shown(samples * tks_sample_bytes(kind.heights.sample));
        ASSERT_EQ(tks_decode_heights(decoded.get(), shown.data(), shown.size()), TKS_OK);
        ASSERT_EQ(shown, reference::decode(prefix, 1 << 20, {static_cast<int>(level), 0}).heights)
            << n << ", level " << level;
      }
    }
  }
}

/// With every sixteenth of the stream; all prefixes of small ones are those of stream_prefix_test.
TEST(DrawnHeights, PrefixesImprove) {
  const Raster heights = patches(150, 140);
  const Bytes stream = encode(&heights, nullptr, lossless());
  const size_t header = readHeader(stream)->bytes;
  double before = INFINITY;
  for (size_t part = 0; part <= 16; ++part) {
    const size_t size = header + (stream.size() - header) * part / 16;
    const double error = squaredError(heights, Stream(Prefix(stream).first(size)).heights());
    EXPECT_LE(error, before * 1.007) << part;
    before = error;
  }
  EXPECT_EQ(before, 0);
}

TEST(DrawnHeights, WindowsAreThoseOfTheWholeInAllPrefixes) {
  for (const DrawnKind& kind : drawnKinds(90, 70)) {
    for (size_t n = readHeader(kind.stream)->bytes; n <= kind.stream.size(); n += 197) {
      const std::vector<std::byte> whole = Stream(Prefix(kind.stream).first(n)).heights();
      expectHeightsWindow(Stream(Prefix(kind.stream).first(n)), {13, 9, 31, 20}, whole);
    }
  }
}

/// Levels hold every 2^k-th sample, and nothing that was filtered.
TEST(DrawnHeights, LevelsHoldSamples) {
  Raster heights = patches(97, 65);
  for (size_t x = 0; x < 97; ++x) heights.data[64 * 97 + x] = std::byte(x % 3);  // no line repeats
  for (size_t y = 0; y < 65; ++y) heights.data[97 * y + 96] = std::byte(y % 3);
  Stream stream(encode(&heights, nullptr, lossless()));
  ASSERT_EQ(stream.info().heights_drawn, 1);
  ASSERT_EQ(tks_set_levels(stream.get(), 3, 0), TKS_OK);
  std::vector<uint8_t> shown(size_t{13} * 9);
  ASSERT_EQ(tks_decode_heights(stream.get(), shown.data(), shown.size()), TKS_OK);
  for (size_t i = 0; i < shown.size(); ++i)
    EXPECT_EQ(std::byte{shown[i]}, heights.data[8 * (i / 13) * 97 + 8 * (i % 13)]);
}

/// Vertices of the coded mesh lie where heights are not those between their neighbours.
TEST(DrawnHeights, CodedMeshHasFewVerticesAndTheirHeights) {
  const Raster heights = patches(129, 129);
  Stream stream(encode(&heights, nullptr, lossless()));
  tks_mesh mesh = {};
  ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_CODED, 0, &mesh), TKS_OK);
  EXPECT_GT(mesh.vertex_count, 4u);
  EXPECT_LT(mesh.vertex_count, 129u * 129 * 3 / 4);
  for (uint32_t v = 0; v < mesh.vertex_count; ++v)
    ASSERT_EQ(mesh.height[v], sampleAt(heights.data, TKS_U8, mesh.grid_index[v]));
  tks_free_mesh(&mesh);
  ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, 500, &mesh), TKS_OK);
  EXPECT_LE(mesh.triangle_count, 500u);
  tks_free_mesh(&mesh);
}

TEST(DrawnHeights, DamagedBytesDecode) {
  for (const DrawnKind& kind : drawnKinds(40, 31)) {
    const size_t header = readHeader(kind.stream)->bytes;
    for (size_t at = header + 3; at < kind.stream.size(); at += 3) {
      Bytes damaged = kind.stream;
      damaged[at] ^= static_cast<uint8_t>(1 + at % 255);
      const tks_limits limits = smallLimits();
      Stream stream(damaged, &limits);
      if (stream.status() != TKS_OK) continue;
      EXPECT_EQ(stream.heights().size(), kind.heights.data.size());
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
