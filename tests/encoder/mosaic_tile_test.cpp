// SPDX-License-Identifier: Apache-2.0
// Tasks of tiles make the codewords of an encoder that holds the whole plane.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/lifting/lifting_kernel.hpp"
#include "encoder/mosaic/tile.hpp"
#include "tests/support/mosaic_memory.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis::test {
namespace {

/// Heights whose step is 1 and whose base is 0, with the filter of all levels.
struct TileCase {
  Extent plane;
  int region_log2, tile_log2;
  uint8_t filter = 0, fraction_bits = 0, first_doubled = 3;
  int low = -500, high = 500;
  bool voids = false, wild = false;
};

class WholePlane {
 public:
  explicit WholePlane(const TileCase& given) : case_(given) {
    Random random(given.filter + given.plane.width);
    values_ = given.wild ? extremePlane(random, given.plane.samples(), given.low, given.high)
                         : hills(random);
    if (!given.voids) return;
    valid_.assign(values_.size(), 1);
    for (size_t i = 0; i < values_.size(); ++i) {
      const uint32_t x = static_cast<uint32_t>(i % given.plane.width),
                     y = static_cast<uint32_t>(i / given.plane.width);
      if ((x / 37 + y / 23) % 5 == 0 || random() % 40 == 0) valid_[i] = 0;
    }
  }

  MosaicPlan plan() const {
    MosaicPlan plan;
    plan.tile_log2 = case_.tile_log2;
    GeometryHeader& header = plan.header.geometry.emplace();
    header.width = case_.plane.width;
    header.height = case_.plane.height;
    header.sample = TKS_I32;
    header.regions.side_log2 = static_cast<uint8_t>(case_.region_log2);
    header.wavelet.filters = {case_.filter, case_.filter, case_.filter};
    header.wavelet.fraction_bits = case_.fraction_bits;
    header.wavelet.bits = static_cast<uint8_t>(
        std::bit_width(static_cast<uint32_t>(case_.high - case_.low)) + case_.fraction_bits);
    header.wavelet.first_doubled = case_.fraction_bits > 0 ? 0 : case_.first_doubled;
    header.planes = 30;
    plan.header.lossless = 1;
    if (case_.voids) {
      plan.header.layers.validity_bytes = 1;
      plan.header.layers.has_nodata = 1;
      plan.header.layers.nodata = kNodata;
    }
    return plan;
  }

  std::vector<EncodedTrack> tracks() const {
    const MosaicPlan plan = this->plan();
    CoefficientOptions options;
    options.region_log2 = case_.region_log2;
    return encodeCoefficients({values_, case_.plane, valid_}, plan.geometry().wavelet, options);
  }

  ReadSamples reader() const {
    return [this](const Window& window, void* samples) -> Status {
      auto* out = static_cast<int32_t*>(samples);
      for (uint32_t y = window.y; y < window.y + window.height; ++y) {
        for (uint32_t x = window.x; x < window.x + window.width; ++x) {
          const size_t i = size_t{y} * case_.plane.width + x;
          *out++ = Mask(valid_)[i] ? values_[i] : kNodata;
        }
      }
      return {};
    };
  }

 private:
  static constexpr int32_t kNodata = -99999;

  Plane hills(Random& random) const {
    Plane plane(case_.plane.samples());
    const double span = case_.high - case_.low;
    for (size_t i = 0; i < plane.size(); ++i) {
      const double x = static_cast<double>(i % case_.plane.width),
                   y = static_cast<double>(i / case_.plane.width);
      const double rise = 0.5 + 0.4 * std::sin(x / 17) * std::cos(y / 11);
      plane[i] = case_.low + static_cast<int32_t>(span * rise) + static_cast<int32_t>(random() % 8);
    }
    return plane;
  }

  TileCase case_;
  Plane values_;
  std::vector<uint8_t> valid_;
};

/// P is a bound in a plan, and exact in encodeCoefficients(): it is set to what that found.
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
    for (size_t i = 0; i < tracks.size(); ++i) {
      ASSERT_EQ(coded->part.tracks[i].codeword, expected[tracks[i]].codeword)
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
      const bool one = regionCount(plane.width, plane.height, 4) <= 1;
      expectSameCodewords({.plane = plane,
                           .region_log2 = one ? 0 : 4,
                           .tile_log2 = 5,
                           .filter = 3,
                           .first_doubled = 1,
                           .voids = voids});
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
