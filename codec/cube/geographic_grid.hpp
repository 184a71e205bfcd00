// SPDX-License-Identifier: Apache-2.0
// A GeographicGrid is where the samples of a grid lie whose columns go round the Earth.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/plane.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline cube {

class GeographicGrid {
 public:
  /// geotransform: in degrees, in the order of GDAL. Columns go east or west, once round the Earth,
  /// and the last one may be the first one again; rows go south or north, from anywhere to
  /// anywhere between the poles.
  static Result<GeographicGrid> make(Extent extent, const std::array<double, 6>& geotransform);

  Extent extent() const { return extent_; }
  /// The columns that go round, without one that repeats the first.
  uint32_t columnsRound() const { return round_; }

  /// Of the middles of samples. Columns and rows may lie between samples, and outside.
  double longitudeOf(double column) const { return west_ + column * column_degrees_; }
  double latitudeOf(double row) const;
  double columnOf(double longitude) const { return (longitude - west_) / column_degrees_; }
  double rowOf(double latitude) const { return (latitude - first_) / row_degrees_; }
  /// The row that a pole would have: before the first one, or behind the last one.
  double poleBefore() const { return rowOf(std::copysign(90, -row_degrees_)); }
  double poleBehind() const { return rowOf(std::copysign(90, row_degrees_)); }

 private:
  GeographicGrid() = default;

  Extent extent_;
  uint32_t round_ = 0;
  double west_ = 0, column_degrees_ = 0;  ///< of the first column
  double first_ = 0, row_degrees_ = 0;    ///< of the first row
};

}  // namespace tetrakis::inline cube
