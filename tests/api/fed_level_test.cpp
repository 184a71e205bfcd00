// SPDX-License-Identifier: Apache-2.0
// tks_fed_level: how finely the bytes that are there tell of heights and texture.
#include <algorithm>

#include "tests/support/indexed_terrain.hpp"

namespace tetrakis::test {
namespace {

uint32_t fed(const Stream& stream, tks_part part) {
  uint32_t level = ~0U;
  EXPECT_EQ(tks_fed_level(stream.get(), part, &level), TKS_OK) << stream.message();
  return level;
}

TEST(FedLevel, FallsAsBytesComeAndIsZeroInTheEnd) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 300, 260, 1, TKS_I16});
  const samples::Raster image = samples::make({samples::Pattern::kRidges, 512, 512, 3, TKS_U8});
  for (const bool in_regions : {false, true}) {
    const Bytes bytes = in_regions ? encodeRegions(&heights, &image, lossless())
                                   : encode(&heights, &image, lossless());
    const tks_info whole = Stream(bytes).info();
    for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE}) {
      const bool of_texture = part == TKS_PART_TEXTURE;
      const uint64_t samples = of_texture ? 512 * 512 : 300 * 260;
      uint32_t last = of_texture ? whole.texture_coarsest_level : whole.coarsest_level;
      for (size_t size = whole.header_bytes; size < bytes.size(); size += size / 5 + 1) {
        const Stream stream(Prefix(bytes).first(size));
        const uint32_t level = fed(stream, part);
        EXPECT_LE(level, last) << size;
        last = level;
        const tks_info info = stream.info();
        const uint64_t known = of_texture ? info.texture_bytes : info.geometry_bytes;
        if (in_regions || known == 0) continue;  // a track has but a part of these bytes
        EXPECT_LE(samples >> (2 * level), 64 * known) << size;
        if (level > 0) {
          EXPECT_GT(samples >> (2 * (level - 1)), 64 * known) << size;
        }
      }
      EXPECT_EQ(fed(Stream(bytes), part), 0U);
    }
  }
}

TEST(FedLevel, IsThatOfTheRegionThatIsKnownBest) {
  const IndexedTerrain terrain;
  Stream stream(Prefix(terrain.bytes).first(terrain.header));
  EXPECT_EQ(fed(stream, TKS_PART_TEXTURE), stream.info().texture_coarsest_level);
  const tks_window corner{0, 0, 8, 8};
  tks_ranges ranges{};
  ASSERT_EQ(tks_needed_ranges(stream.get(), TKS_PART_TEXTURE, &corner, &ranges), TKS_OK);
  for (size_t i = 0; i < ranges.count; ++i) {
    const tks_range& range = ranges.ranges[i];
    ASSERT_EQ(tks_put(stream.get(), range.offset, terrain.bytes.data() + range.offset, range.size),
              TKS_OK);
  }
  tks_free_ranges(&ranges);
  EXPECT_EQ(fed(stream, TKS_PART_TEXTURE), 0U);
  EXPECT_GT(fed(stream, TKS_PART_HEIGHTS), 0U);
}

TEST(FedLevel, OtherPartsAreRefused) {
  const samples::Raster image = samples::make({samples::Pattern::kRidges, 40, 30, 3, TKS_U8});
  const Bytes bytes = encode(nullptr, &image, lossless());
  Stream stream(bytes);
  uint32_t level = 7;
  EXPECT_EQ(tks_fed_level(stream.get(), TKS_PART_HEIGHTS, &level), TKS_USAGE);
  EXPECT_EQ(tks_fed_level(stream.get(), TKS_PART_BUDGET_MESH, &level), TKS_USAGE);
  EXPECT_EQ(tks_fed_level(stream.get(), TKS_PART_TEXTURE, nullptr), TKS_USAGE);
  EXPECT_EQ(tks_fed_level(nullptr, TKS_PART_TEXTURE, &level), TKS_USAGE);
  EXPECT_EQ(level, 7U);
  EXPECT_EQ(tks_fed_level(stream.get(), TKS_PART_TEXTURE, &level), TKS_OK);
  EXPECT_EQ(level, 0U);
}

}  // namespace
}  // namespace tetrakis::test
