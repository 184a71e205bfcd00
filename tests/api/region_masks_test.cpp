// SPDX-License-Identifier: Apache-2.0
// Masks of regions: windows, prefixes, ranges and memory of streams whose regions have their own.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <random>

#include "base/bit_plane.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/track/track.hpp"
#include "codec/lattice/validity.hpp"
#include "conformance/reference_decoder.hpp"
#include "tests/support/mosaic_source.hpp"

namespace tetrakis::test {
namespace {

using samples::VoidShape;

constexpr VoidShape kShapes[] = {VoidShape::kCoast, VoidShape::kSpeckle, VoidShape::kHoles,
                                 VoidShape::kHalf,  VoidShape::kAll,     VoidShape::kOneVoid};

/// Two groups of regions.
Bytes mosaicWith(VoidShape shape, double max_error = 0,
                 tks_layout layout = TKS_LAYOUT_PROGRESSIVE) {
  Source source(hills(TKS_I16, 280, 215));
  dig(source, shape);
  tks_mosaic_options options = mosaicOptions();
  options.regions = 16;
  options.max_error = max_error;
  options.lossless = max_error == 0;
  const Bytes bytes = mosaicOf(source, options, layout);
  EXPECT_TRUE(readHeader(bytes)->header.layers.region_masks);
  return bytes;
}

tks_window randomWindow(std::mt19937& random) {
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  tks_window window = {};
  window.width = 1 + below(60);
  window.height = 1 + below(60);
  window.x = below(280 - window.width);
  window.y = below(215 - window.height);
  return window;
}

std::vector<int16_t> decodedWindow(Stream& stream, const tks_window& window) {
  std::vector<int16_t> samples(size_t{window.width} * window.height);
  EXPECT_EQ(tks_decode_heights_window(stream.get(), &window, samples.data(), 2 * samples.size()),
            TKS_OK)
      << stream.message();
  return samples;
}

std::vector<uint8_t> validIn(Stream& stream, const tks_window& window) {
  std::vector<uint8_t> valid(size_t{window.width} * window.height);
  EXPECT_EQ(tks_decode_validity_window(stream.get(), &window, valid.data(), valid.size()), TKS_OK);
  return valid;
}

std::vector<int16_t> cut(const std::vector<int16_t>& plane, const tks_window& window) {
  std::vector<int16_t> samples;
  for (uint32_t y = window.y; y < window.y + window.height; ++y) {
    const auto row = plane.begin() + static_cast<ptrdiff_t>(size_t{y} * 280 + window.x);
    samples.insert(samples.end(), row, row + window.width);
  }
  return samples;
}

std::vector<int16_t> plane(Stream& stream) {
  std::vector<int16_t> samples(size_t{280} * 215);
  EXPECT_EQ(tks_decode_heights(stream.get(), samples.data(), 2 * samples.size()), TKS_OK);
  return samples;
}

TEST(RegionMasks, WindowsOfPrefixesHoldWhatThePlaneHoldsThere) {
  std::mt19937 random(3);
  for (const VoidShape shape : {VoidShape::kCoast, VoidShape::kSpeckle, VoidShape::kHoles}) {
    for (const double max_error : {0., 3.}) {
      const Bytes bytes = mosaicWith(shape, max_error);
      for (const double part : {0.05, 0.3, 0.8, 1.}) {
        const auto end = static_cast<size_t>(part * static_cast<double>(bytes.size()));
        Stream stream(Prefix(bytes).first(end));
        if (stream.status() != TKS_OK) continue;
        const std::vector<int16_t> whole = plane(stream);
        for (int i = 0; i < 4; ++i) {
          const tks_window window = randomWindow(random);
          ASSERT_EQ(decodedWindow(stream, window), cut(whole, window))
              << static_cast<int>(shape) << ", " << part << " of the bytes, window " << window.x
              << ", " << window.y << ", " << window.width << " x " << window.height;
        }
      }
    }
  }
}

/// Levels of a stream with masks of regions are those of the reference decoder.
TEST(RegionMasks, LevelsAreThoseOfTheReference) {
  for (const VoidShape shape : {VoidShape::kCoast, VoidShape::kSpeckle}) {
    const Bytes bytes = mosaicWith(shape);
    for (const double part : {0.1, 0.5, 1.}) {
      const auto prefix =
          Prefix(bytes).first(static_cast<size_t>(part * static_cast<double>(bytes.size())));
      Stream stream(prefix);
      for (uint32_t level = 0; level <= stream.info().coarsest_level; ++level) {
        ASSERT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
        const auto expected = reference::decode(prefix, 1 << 20, {static_cast<int>(level), 0});
        std::vector<std::byte> heights(expected.heights->size());
        ASSERT_EQ(tks_decode_heights(stream.get(), heights.data(), heights.size()), TKS_OK);
        ASSERT_TRUE(std::equal(
            heights.begin(), heights.end(), expected.heights->begin(), expected.heights->end(),
            [](std::byte a, uint8_t b) { return std::to_integer<uint8_t>(a) == b; }))
            << level;
      }
    }
  }
}

/// A decoder that keeps what it decoded gives what one gives that has kept nothing.
TEST(RegionMasks, GrowingStreamsDecodeAsOthersDo) {
  std::mt19937 random(5);
  for (const VoidShape shape : {VoidShape::kCoast, VoidShape::kSpeckle}) {
    const Bytes bytes = mosaicWith(shape, 2);
    size_t end = readHeader(bytes)->bytes;
    Stream growing(Prefix(bytes).first(end));
    while (end < bytes.size()) {
      const size_t more = std::min<size_t>(bytes.size() - end, 1 + random() % 5000);
      ASSERT_EQ(tks_append(growing.get(), bytes.data() + end, more), TKS_OK);
      end += more;
      tks_info info = {};
      info.size = sizeof info;
      ASSERT_EQ(tks_get_info(growing.get(), &info), TKS_OK);
      ASSERT_EQ(info.voids_known, end == bytes.size());
      Stream fresh(Prefix(bytes).first(end));
      const tks_window window = randomWindow(random);
      ASSERT_EQ(decodedWindow(growing, window), decodedWindow(fresh, window)) << end;
      ASSERT_EQ(plane(growing), plane(fresh)) << end;
    }
  }
}

/// The ranges that a window needs give the window; those of windows before it change nothing.
TEST(RegionMasks, RangesOfAWindowGiveTheWindow) {
  std::mt19937 random(7);
  for (const VoidShape shape : kShapes) {
    const Bytes bytes = mosaicWith(shape, 0, TKS_LAYOUT_WINDOWS);
    Stream all((Prefix(bytes)));
    const std::vector<int16_t> whole = plane(all);
    const size_t header = readHeader(bytes)->bytes;
    Stream stream(Prefix(bytes).first(header));
    uint64_t fetched = 0;
    for (int i = 0; i < 5; ++i) {
      const tks_window window = randomWindow(random);
      tks_ranges ranges = {};
      ASSERT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &window, &ranges), TKS_OK);
      for (size_t k = 0; k < ranges.count; ++k) {
        const tks_range& range = ranges.ranges[k];
        if (i == 0) fetched += range.size;
        ASSERT_EQ(tks_put(stream.get(), range.offset, bytes.data() + range.offset, range.size),
                  TKS_OK);
      }
      tks_free_ranges(&ranges);
      ASSERT_EQ(decodedWindow(stream, window), cut(whole, window)) << static_cast<int>(shape);
      ASSERT_EQ(validIn(stream, window), validIn(all, window));
    }
    EXPECT_TRUE(shape != VoidShape::kCoast || fetched < bytes.size());
  }
}

/// Bytes of the masks of all regions and of the base.
size_t bytesInRegions(const BitPlane& mask, int region_log2) {
  size_t bytes = 0;
  BitPlane sparse = mask;
  for (const RegionGroup& group : regionGroups(mask.extent(), region_log2)) {
    const RegionGroup here{region_log2, group.columns, group.rows, 0, sparse.extent()};
    for (uint32_t row = 0; row < here.rows; ++row)
      for (uint32_t column = 0; column < here.columns; ++column)
        bytes += 1 + encodeFinerValidity(sparse.cut(here.samplesOf(column, row))).size();
    sparse = coarseMarks(sparse);
  }
  return bytes + encodeValidityBits(sparse).size();
}

/// Each region has models of its own.
TEST(RegionMasks, TakeLittleMoreThanOneMask) {
  constexpr Extent kPlane{2048, 1800};
  for (const auto& [shape, most] : {std::pair(VoidShape::kCoast, 1.15),
                                    {VoidShape::kHoles, 1.1},
                                    {VoidShape::kSpeckle, 1.02}}) {
    const std::vector<uint8_t> valid = samples::validity(shape, kPlane.width, kPlane.height);
    const BitPlane mask(valid, kPlane);
    const auto whole = static_cast<double>(encodeValidityBits(mask).size());
    EXPECT_LT(static_cast<double>(bytesInRegions(mask, 9)), most * whole + 40)
        << static_cast<int>(shape) << ", " << whole;
  }
}

/// What is valid is what is not the value of voids, in windows and levels as well.
TEST(RegionMasks, ValidityIsThatOfTheSamples) {
  const Bytes bytes = mosaicWith(VoidShape::kCoast);
  Stream stream((Prefix(bytes)));
  for (uint32_t level = 0; level <= stream.info().coarsest_level; ++level) {
    ASSERT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
    tks_info info = {};
    info.size = sizeof info;
    ASSERT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
    const tks_window all{0, 0, info.width, info.height};
    const std::vector<uint8_t> valid = validIn(stream, all);
    const std::vector<int16_t> samples = decodedWindow(stream, all);
    for (size_t i = 0; i < valid.size(); ++i) ASSERT_EQ(valid[i] == 0, samples[i] == 1) << level;
    std::vector<uint8_t> whole(valid.size());
    ASSERT_EQ(tks_decode_validity(stream.get(), whole.data(), whole.size()), TKS_OK);
    ASSERT_EQ(whole, valid);
  }
}

/// Tiles of which nothing exists, halo included, are not coded at all.
TEST(RegionMasks, WideVoidsComeBack) {
  for (const double max_error : {0., 2.}) {
    Source source(hills(TKS_I16, 620, 90));
    dig(source, VoidShape::kHalf);
    tks_mosaic_options options = mosaicOptions();
    options.lossless = max_error == 0;
    options.max_error = max_error;
    Stream stream(mosaicOf(source, options));
    std::vector<int16_t> samples(size_t{620} * 90), original(samples.size());
    ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), 2 * samples.size()), TKS_OK);
    std::memcpy(original.data(), source.raster.data.data(), 2 * samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
      ASSERT_LE(std::abs(samples[i] - original[i]), max_error) << i;
      ASSERT_EQ(samples[i] == 1, original[i] == 1) << i;
    }
  }
}

/// Narrow planes get regions that are long enough to be halved.
TEST(RegionMasks, NarrowPlanesKeepTheirVoids) {
  for (const auto& [width, height] : {std::pair(2000u, 5u), std::pair(17u, 900u)}) {
    Source source(hills(TKS_I16, width, height));
    dig(source, VoidShape::kHoles);
    tks_mosaic_options options = mosaicOptions();
    options.regions = 16;
    options.lossless = 1;
    Stream stream(mosaicOf(source, options));
    std::vector<std::byte> samples(stream.heightsBytes());
    ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
    EXPECT_TRUE(samples == source.raster.data) << width;
  }
}

}  // namespace
}  // namespace tetrakis::test
