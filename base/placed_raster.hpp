// SPDX-License-Identifier: Apache-2.0
// liesOn() and fineness() compare two rasters on one ground: whether one lies on the other, and how
// much finer it is.
#pragma once

#include <cstdint>

namespace tetrakis::inline base {

/// A raster and its geotransform, as GDAL has it: six numbers, from columns and rows to x and y.
struct PlacedRaster {
  uint32_t width, height;
  const double* geotransform;  ///< null: it covers what it is laid over
};

/// Whether all corners of a raster lie on the ground of another one, or beside it by less than a
/// sample of that. Both have geotransforms of one reference system.
bool liesOn(const PlacedRaster& ground, const PlacedRaster& raster);

/// How many samples of a raster lie along one of the ground that is under it, at least 1.
double fineness(const PlacedRaster& ground, const PlacedRaster& raster);

}  // namespace tetrakis::inline base
