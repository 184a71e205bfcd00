// SPDX-License-Identifier: Apache-2.0
// EarthGround gives the heights of a stream by longitude and latitude.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
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

/// The next mip level, low-pass filtered. round: the last column lies beside the first.
LevelSurface coarser(const LevelSurface& surface, bool round);

/// Not thread safe.
class EarthGround {
 public:
  /// Of a cube: the grid that it was made of. TKS_USAGE if the stream does not say where its
  /// heights lie, PROJ does not know the CRS, or the ground holds a pole or crosses the
  /// antimeridian, where tiles would have to be of both sides, and does not go round the Earth.
  static Result<EarthGround> create(const tks_info& info);

  const GeographicBounds& bounds() const { return bounds_; }

  /// Degrees of latitude between samples.
  double spacing() const { return spacing_; }

  /// Columns once round the Earth, or 0.
  uint32_t columnsRound() const { return round_; }

  /// Heights along a parallel, bilinear between the samples that are no voids; NaN outside, and
  /// where no sample is. Where columns go round, the last lies beside the first, longitudes 180 and
  /// -180 have the same heights, and a pole has the mean height of the row beside it.
  void sampleParallel(const LevelSurface& surface, double latitude,
                      std::span<const double> longitudes, std::span<float> heights) const;

 private:
  EarthGround(RasterPlace place, uint32_t width, uint32_t height)
      : place_(std::move(place)), width_(width), height_(height) {}
  Status findBounds();
  /// What the mean height of the row beside a pole counts, at a place beyond that row.
  struct PoleShare {
    double share = 0, height = 0;
    float of(float beside) const {
      return static_cast<float>(share == 1 ? height : beside + share * (height - beside));
    }
  };
  /// down: the row of the surface.
  PoleShare poleShare(const LevelSurface& surface, double latitude, double down) const;
  /// Grids in degrees may count longitudes from 0 to 360.
  double unwrapped(double longitude) const {
    constexpr double kSlack = 1e-6;
    if (round_ > 0 && longitude >= 180) longitude -= 360;
    return longitude < west_ - kSlack ? longitude + 360 : longitude;
  }

  RasterPlace place_;
  uint32_t width_, height_;
  double spacing_ = 0;
  double west_ = 0;     ///< as the raster counts
  uint32_t round_ = 0;  ///< columns once round the Earth; 0: there is more than the raster
  /// Where the south pole and the north pole lie, of rasters that go round and reach them.
  std::array<std::optional<double>, 2> pole_rows_;
  GeographicBounds bounds_;
};

}  // namespace tetrakis::tools
