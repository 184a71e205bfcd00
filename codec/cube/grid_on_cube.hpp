// SPDX-License-Identifier: Apache-2.0
// GridOnCube says where on a cube the samples of a geographic grid lie.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/cube/cube_sphere.hpp"
#include "codec/cube/geographic_grid.hpp"

namespace tetrakis::inline cube {

class GridOnCube {
 public:
  /// The samples of so many columns from `column` on.
  GridOnCube(const GeographicGrid& grid, uint32_t column, uint32_t columns) : grid_(&grid) {
    for (uint32_t i = 0; i < columns; ++i) {
      const double longitude = grid.longitudeOf(column + static_cast<double>(i));
      meridians_.push_back({cosineOfDegrees(longitude), sineOfDegrees(longitude)});
    }
  }

  /// Calls visit(i, place) for each of these columns. The grid must be there.
  template <class Visit>
  void forEach(uint32_t row, const Visit& visit) const {
    const double latitude = grid_->latitudeOf(row);
    const double off_axis = cosineOfDegrees(latitude), north = sineOfDegrees(latitude);
    for (uint32_t i = 0; i < meridians_.size(); ++i) {
      const auto& [x, y] = meridians_[i];
      visit(i, cubePlaceOf({off_axis * x, off_axis * y, north}));
    }
  }

 private:
  struct Meridian {
    double x, y;
  };

  const GeographicGrid* grid_;
  std::vector<Meridian> meridians_;
};

}  // namespace tetrakis::inline cube
