// SPDX-License-Identifier: Apache-2.0
// Whole streams of heights with flat water: it is exact as soon as it is known, in every prefix,
// window and level, whatever the type, the shape and the target; and land without water pays
// nothing.
#include <algorithm>
#include <span>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;
using samples::VoidShape;

constexpr tks_sample kTypes[] = {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32};

/// Ridges, with the height of their first sample where a shape leaves them out.
struct Flooded {
  Raster raster;
  std::vector<uint8_t> land;

  bool isWater(size_t i, const std::vector<std::byte>& heights) const {
    return sampleAt(heights, raster.sample, i) == sampleAt(raster.data, raster.sample, i);
  }
};

Flooded flooded(VoidShape shape, tks_sample sample, uint32_t width, uint32_t height) {
  Flooded f{make({Pattern::kRidges, width, height, 1, sample}),
            samples::validity(shape, width, height)};
  const size_t bytes = tks_sample_bytes(sample);
  for (size_t i = 0; i < f.land.size(); ++i) {
    if (!f.land[i]) std::copy_n(f.raster.data.begin(), bytes, f.raster.data.begin() + i * bytes);
  }
  return f;
}

GeometryLayers layersOf(const Bytes& stream) {
  return readHeader(stream)->header.layers;
}

TEST(FlatWater, ComesBackWithAllTypes) {
  for (const tks_sample type : kTypes) {
    const Flooded f = flooded(VoidShape::kCoast, type, 60, 45);
    const Bytes stream = encode(&f.raster, nullptr, lossless());
    Stream decoded(stream);
    EXPECT_EQ(decoded.heights(), f.raster.data) << type;
  }
}

/// From the end of the opening on, at every 61st byte.
TEST(FlatWater, IsExactInEveryPrefixThatHoldsItsShape) {
  for (const tks_encode_options& options :
       {lossless(), budget(9000), inRegions(lossless(), 32), inRegions(budget(9000), 32)}) {
    const Flooded f = flooded(VoidShape::kHalf, TKS_I16, 128, 100);
    const Bytes stream = encode(&f.raster, nullptr, options);
    const GeometryLayers layers = layersOf(stream);
    ASSERT_GT(layers.flat_bytes, 0u);
    const size_t known = readHeader(stream)->bytes + layers.openingBytes() + 40;
    for (size_t bytes = known; bytes <= stream.size(); bytes += 61) {
      Stream prefix(Prefix(stream).first(bytes));
      const std::vector<std::byte> heights = prefix.heights();
      for (size_t i = 0; i < f.land.size(); ++i) {
        if (f.land[i]) continue;
        ASSERT_TRUE(f.isWater(i, heights)) << bytes << ", " << i;
      }
    }
  }
}

TEST(FlatWater, DecodesAsTheReferenceDoesInAllPrefixesAndLevels) {
  for (const tks_encode_options& options :
       {lossless(), budget(3000), inRegions(budget(3000), 32)}) {
    const Flooded f = flooded(VoidShape::kCoast, TKS_U16, 90, 70);
    const Bytes stream = encode(&f.raster, nullptr, options);
    for (size_t bytes = readHeader(stream)->bytes; bytes <= stream.size(); bytes += 311) {
      const Prefix prefix = Prefix(stream).first(bytes);
      for (const int level : {0, 1, 2, 4}) {
        Stream decoded(prefix);
        ASSERT_EQ(tks_set_levels(decoded.get(), static_cast<uint32_t>(level), 0), TKS_OK);
        const uint32_t step = 1u << level;
        const size_t count = size_t{(90 - 1) / step + 1} * ((70 - 1) / step + 1);
        std::vector<uint8_t> heights(2 * count);
        ASSERT_EQ(tks_decode_heights(decoded.get(), heights.data(), heights.size()), TKS_OK);
        ASSERT_EQ(heights, reference::decode(prefix, 1 << 20, {level, 0}).heights)
            << bytes << ", level " << level;
      }
    }
  }
}

/// A bound may be kept by corrections behind coefficients that were coded beside water.
TEST(FlatWater, CorrectionsLieBesideIt) {
  const Flooded f = flooded(VoidShape::kHalf, TKS_U16, 130, 111);
  bool both = false;
  for (const double most : {20.0, 100.0, 500.0}) {
    tks_encode_options options = lossless();
    options.lossless = 0;
    options.max_error = most;
    const Bytes stream = encode(&f.raster, nullptr, options);
    const GeometryLayers layers = layersOf(stream);
    both |= layers.flat_bytes > 0 && layers.corrections == CorrectionKind::kSteps;
    for (size_t bytes = readHeader(stream)->bytes; bytes < stream.size(); bytes += 2999) {
      const Prefix prefix = Prefix(stream).first(bytes);
      Stream decoded(prefix);
      const std::vector<std::byte> heights = decoded.heights();
      const std::vector<uint8_t> expected =
          reference::decode(prefix, 1 << 20, {0, 0}).heights.value();
      ASSERT_TRUE(std::ranges::equal(std::as_bytes(std::span(expected)), heights)) << bytes;
    }
    ASSERT_LE(largestError(f.raster, Stream(stream).heights()), most);
  }
  EXPECT_TRUE(both);
}

TEST(FlatWater, WindowsAreThoseOfTheWhole) {
  for (const tks_encode_options& options :
       {lossless(), budget(5000), inRegions(budget(5000), 32)}) {
    const Flooded f = flooded(VoidShape::kCoast, TKS_I16, 130, 111);
    const Bytes stream = encode(&f.raster, nullptr, options);
    for (const size_t bytes : {stream.size(), stream.size() / 2}) {
      Stream decoded(Prefix(stream).first(bytes));
      const std::vector<std::byte> whole = decoded.heights();
      for (const tks_window& window :
           {tks_window{0, 0, 130, 111}, tks_window{5, 60, 33, 20}, tks_window{129, 110, 1, 1}})
        expectHeightsWindow(Stream(Prefix(stream).first(bytes)), window, whole);
    }
  }
}

TEST(FlatWater, CostsNothingWhereThereIsNone) {
  const Raster land = make({Pattern::kRidges, 120, 90, 1, TKS_U16});
  for (const tks_encode_options& options : {lossless(), budget(3000)})
    EXPECT_EQ(layersOf(encode(&land, nullptr, options)).flat_bytes, 0u);
}

/// Areas of few heights that leave next to nothing to coefficients: a cut of these, which exact
/// corrections follow, keeps the areas.
TEST(FlatWater, CutsOfCoefficientsKeepTheAreas) {
  Raster bands = make({Pattern::kFlat, 4, 131, 1, TKS_U32});
  constexpr uint32_t kHeights[] = {0, 153, 143, 157, 163};
  for (uint32_t i = 0; i < 4 * 131; ++i) {
    const uint32_t height = kHeights[(i + 8 * (i % 4)) * 5 / (4 * 131 + 24)];
    std::memcpy(bands.data.data() + i * sizeof height, &height, sizeof height);
  }
  for (const uint32_t regions : {0u, 64u}) {
    for (const uint64_t bytes : {200u, 300u, 766u}) {
      Stream stream(encode(&bands, nullptr, inRegions(budget(bytes), regions)));
      EXPECT_TRUE(stream.heights() == bands.data) << regions << ", " << bytes;
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
