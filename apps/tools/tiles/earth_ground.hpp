// SPDX-License-Identifier: Apache-2.0
// EarthGround gives the heights of a stream by longitude and latitude.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "apps/tools/files/place/raster_place.hpp"
#include "apps/tools/tiles/geographic_tile.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// Heights in units of the stream, NaN where void, of a mip level.
struct LevelSurface {
  std::vector<float> heights;
  uint32_t width = 0, height = 0;
  uint32_t level = 0;  ///< sample (x, y) lies on sample (x 2^level, y 2^level) of level 0

  bool allVoid() const {
    return std::all_of(heights.begin(), heights.end(), [](float h) { return std::isnan(h); });
  }
};

/// Not thread safe.
class EarthGround {
 public:
  /// TKS_USAGE if the stream does not say where its heights lie, PROJ does not know the CRS, or the
  /// ground holds a pole or crosses the antimeridian, where tiles would have to be of both sides.
  static Result<EarthGround> create(const tks_info& info);

  const GeographicBounds& bounds() const { return bounds_; }

  /// Degrees of latitude between samples.
  double spacing() const { return spacing_; }

  /// Heights along a parallel, bilinear between the samples that are no voids; NaN outside, and
  /// where no sample is.
  void sampleParallel(const LevelSurface& surface, double latitude,
                      std::span<const double> longitudes, std::span<float> heights) const;

 private:
  EarthGround(RasterPlace place, uint32_t width, uint32_t height)
      : place_(std::move(place)), width_(width), height_(height) {}
  Status findBounds();
  /// Grids in degrees may count longitudes from 0 to 360.
  double unwrapped(double longitude) const {
    constexpr double kSlack = 1e-6;
    return longitude < west_ - kSlack ? longitude + 360 : longitude;
  }

  RasterPlace place_;
  uint32_t width_, height_;
  double spacing_ = 0;
  double west_ = 0;  ///< as the raster counts
  GeographicBounds bounds_;
};

}  // namespace tetrakis::tools
