// SPDX-License-Identifier: Apache-2.0
// RasterPlace tells where the columns and rows of a raster lie in longitude and latitude.
#pragma once

#include <array>
#include <string>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/proj_objects.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Pixels are areas: (0, 0) is the outer corner of the first. Not thread safe.
class RasterPlace {
 public:
  /// TKS_USAGE if the transform has no inverse, or PROJ does not know the CRS.
  static Result<RasterPlace> create(const GeoTransform& transform, const std::string& crs);

  /// Column and row. Far from its place a projection may give anything, numbers that are not finite
  /// too.
  std::array<double, 2> pixelAt(double longitude, double latitude) const;

  /// Longitude and latitude.
  std::array<double, 2> earthAt(double column, double row) const;

 private:
  RasterPlace() = default;

  ProjContext context_;
  ProjObject transformation_;  ///< from longitude and latitude to the CRS
  GeoTransform transform_{}, inverse_{};
};

}  // namespace tetrakis::tools
