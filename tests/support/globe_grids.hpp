// SPDX-License-Identifier: Apache-2.0
// Grids of longitudes and latitudes that go round a globe, and the globe.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

/// In degrees, of the outer corner of the first sample and from one sample to the next.
struct Grid {
  uint32_t width, height;
  double west, north, column, row;
};
inline constexpr Grid kAreas{36, 18, -180, 90, 10, -10};
inline constexpr Grid kPoints{36, 19, -5, 95, 10, -10};
inline constexpr Grid kSouthUp{40, 20, 180, -90, 9, 9};
inline constexpr Grid kBand{50, 23, -180, 84, 7.2, -6.5};

inline tks_heights placed(const samples::Raster& raster, const Grid& grid) {
  tks_heights heights = raster.heights();
  heights.domain = TKS_DOMAIN_CYLINDER;
  heights.has_geotransform = 1;
  const double transform[] = {grid.west, grid.column, 0, grid.north, 0, grid.row};
  std::copy(std::begin(transform), std::end(transform), heights.geotransform);
  return heights;
}

inline samples::Raster rasterOf(const Grid& grid) {
  return samples::make({samples::Pattern::kRidges, grid.width, grid.height, 1, TKS_I16, 3});
}

inline tks_globe moon() {
  return {sizeof(tks_globe), 1737400, 1737400, 0, 0};
}

}  // namespace tetrakis::test
