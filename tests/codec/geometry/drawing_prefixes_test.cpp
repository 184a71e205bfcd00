// SPDX-License-Identifier: Apache-2.0
// What encoders find out about all prefixes of a drawing at once is what a decoder shows of each.
#include <gtest/gtest.h>

#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::test {
namespace {

/// Rectangles of few values, some samples of which differ.
int32_t stepAt(uint32_t x, uint32_t y) {
  const uint32_t odd = samples::hash(x, y, 4) % 19 == 0;
  return static_cast<int32_t>(samples::hash(x / 5, y / 5, 9) % 40 * 300 + 100 * odd) - 6000;
}

void compareAllPrefixes(Extent extent, const std::vector<uint8_t>& valid) {
  std::vector<int32_t> heights(extent.samples());
  for (size_t i = 0; i < heights.size(); ++i) {
    const auto x = static_cast<uint32_t>(i % extent.width);
    heights[i] = stepAt(x, static_cast<uint32_t>(i / extent.width));
  }
  const auto track = encodeDrawnHeights({heights, extent, valid});
  ASSERT_TRUE(track);
  GeometryHeader header;
  header.width = extent.width;
  header.height = extent.height;
  header.drawn = true;
  const std::span<const uint8_t> codeword = track->codeword;
  const auto shown = prefixesOfDrawing(header, codeword, valid);
  const auto compare = [&](uint64_t bytes) {
    const DecodedGeometry of_encoder = shown(bytes);
    const DecodedGeometry decoded =
        decodeDrawnHeights(header, codeword.first(bytes), sharedBits(valid, header.extent()), {});
    ASSERT_EQ(of_encoder.heights, decoded.heights) << bytes << " of " << codeword.size();
    ASSERT_EQ(of_encoder.significant, decoded.significant) << bytes;
    ASSERT_EQ(of_encoder.valid, decoded.valid) << bytes;
    ASSERT_EQ(of_encoder.fraction_bits, decoded.fraction_bits);
  };
  for (uint64_t bytes = 0; bytes <= codeword.size(); ++bytes) compare(bytes);
  compare(codeword.size() / 3);  // prefixes may be asked for in any order
}

TEST(DrawingPrefixes, OfHeightsAreWhatDecodersShow) {
  for (const Extent extent : {Extent{1, 1}, {1, 60}, {17, 13}, {40, 3}, {33, 30}}) {
    compareAllPrefixes(extent, {});
    std::vector<uint8_t> valid(extent.samples());
    for (size_t i = 0; i < valid.size(); ++i) valid[i] = i % 7 != 3;
    compareAllPrefixes(extent, valid);
  }
}

}  // namespace
}  // namespace tetrakis::test
