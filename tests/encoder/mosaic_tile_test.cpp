// SPDX-License-Identifier: Apache-2.0
// Tasks of tiles make the codewords of an encoder that holds the whole plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "codec/wavelet/lifting/lifting_kernel.hpp"
#include "encoder/mosaic/tile.hpp"
#include "tests/support/mosaic_memory.hpp"
#include "tests/support/mosaic_plane.hpp"

namespace tetrakis::test {
namespace {

/// Where all coefficients are 0 a task leaves no byte. P is a bound in a plan, and exact in
/// encodeCoefficients(): it is set to what that found.
void expectSameCodewords(const TileCase& given) {
  const WholePlane whole(given);
  const std::vector<EncodedTrack> expected = whole.tracks();
  MosaicPlan plan = whole.plan();
  plan.header.geometry->planes = static_cast<uint8_t>(expected.front().planes);
  MosaicMemory memory;
  const MosaicFiles files = memory.storage();
  const MosaicGrid grid = plan.grid();
  ASSERT_EQ(grid.regions().size(), expected.size());
  for (const Tile& tile : grid.tiles()) {
    const Result<CodedTile> coded = codeTile(plan, tile, whole.reader(), files, 1);
    ASSERT_TRUE(coded.ok()) << coded.status().message();
    const std::vector<uint32_t> tracks = grid.tracks(tile);
    const Part& part = coded->part;
    for (size_t i = 0; i < tracks.size(); ++i) {
      std::vector<uint8_t> coefficients = part.tracks[i].codeword;
      if (!part.openings.empty())
        coefficients.erase(coefficients.begin(),
                           coefficients.begin() + static_cast<ptrdiff_t>(part.openings[i]));
      const EncodedTrack& one = expected[tracks[i]];
      const bool is_zero = !grid.isBase(tile) && one.points.front().distortion == 0;
      ASSERT_EQ(coefficients, is_zero ? std::vector<uint8_t>() : one.codeword)
          << "filter " << +given.filter << ", track " << tracks[i] << " of " << given.plane.width
          << " x " << given.plane.height;
    }
    ASSERT_TRUE(runTask(plan, tile, whole.reader(), files, 2).ok());
  }
}

TEST(MosaicTile, HasTheCodewordsOfAWholePlaneForAllFilters) {
  for (uint8_t filter = 0; filter < kFilters; ++filter) {
    expectSameCodewords({.plane = {700, 420}, .region_log2 = 5, .tile_log2 = 6, .filter = filter});
    expectSameCodewords({.plane = {531, 600},
                         .region_log2 = 6,
                         .tile_log2 = 7,
                         .filter = filter,
                         .fraction_bits = 4});
  }
}

TEST(MosaicTile, HasTheCodewordsOfAWholePlaneOfWildValues) {
  for (uint8_t filter = 0; filter < kFilters; ++filter) {
    expectSameCodewords({.plane = {600, 333},
                         .region_log2 = 5,
                         .tile_log2 = 6,
                         .filter = filter,
                         .low = -(1 << 20),
                         .high = 1 << 20,
                         .wild = true});
  }
}

TEST(MosaicTile, HasTheCodewordsOfAWholePlaneWithVoids) {
  for (uint8_t filter = 0; filter < kFilters; ++filter) {
    expectSameCodewords(
        {.plane = {640, 431}, .region_log2 = 5, .tile_log2 = 6, .filter = filter, .voids = true});
  }
}

TEST(MosaicTile, HasTheCodewordsOfAWholePlaneOfAnySize) {
  for (const Extent plane : {Extent{1, 1}, Extent{5, 900}, Extent{900, 2}, Extent{33, 33},
                             Extent{1500, 40}, Extent{257, 255}}) {
    for (const bool voids : {false, true}) {
      int region_log2 = 4;
      const auto one = [&] { return regionCount(plane.width, plane.height, region_log2) <= 1; };
      while (voids && !one() && !takesRegionMasks(plane, region_log2)) ++region_log2;
      expectSameCodewords({.plane = plane,
                           .region_log2 = one() ? 0 : region_log2,
                           .tile_log2 = std::max(5, region_log2),
                           .filter = 3,
                           .first_doubled = 1,
                           .voids = voids});
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
