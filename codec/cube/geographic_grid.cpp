// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/geographic_grid.hpp"

#include <algorithm>
#include <cmath>

#include "base/coordinates.hpp"

namespace tetrakis::inline cube {

namespace {

/// Of a row: by so much the middles of the outermost rows may lie beyond the poles, as numbers of
/// few digits have it.
constexpr double kBeyondPole = 0.01;

Status refused(const char* sentence) {
  return {TKS_USAGE, sentence};
}

}  // namespace

Result<GeographicGrid> GeographicGrid::make(Extent extent,
                                            const std::array<double, 6>& geotransform) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (extent.width == 0 || extent.height < 2)
    return refused("The grid has no columns, or less than two rows.");
  if (!std::all_of(geotransform.begin(), geotransform.end(), finite))
    return refused("The geotransform of the grid is not finite.");
  const auto round = tetrakis::columnsRound({extent.width, extent.height, geotransform.data()}, 1);
  if (round == ColumnsRound::kNo)
    return refused("The columns of the grid do not go once round the Earth, in degrees.");
  GeographicGrid grid;
  grid.extent_ = extent;
  grid.round_ = extent.width - (round == ColumnsRound::kRepeating ? 1 : 0);
  grid.column_degrees_ = std::copysign(360.0 / grid.round_, geotransform[1]);
  grid.west_ = std::remainder(geotransform[0], 360) + grid.column_degrees_ / 2;
  grid.row_degrees_ = geotransform[5];
  grid.first_ = geotransform[3] + geotransform[5] / 2;
  const double last = grid.first_ + (extent.height - 1) * grid.row_degrees_;
  if (grid.row_degrees_ == 0 || std::max(std::abs(grid.first_), std::abs(last)) >
                                    90 + kBeyondPole * std::abs(grid.row_degrees_))
    return refused("The rows of the grid do not lie between the poles, in degrees.");
  return grid;
}

double GeographicGrid::latitudeOf(double row) const {
  return std::clamp(first_ + row * row_degrees_, -90.0, 90.0);
}

}  // namespace tetrakis::inline cube
