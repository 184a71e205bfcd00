// SPDX-License-Identifier: Apache-2.0
// groundSpacing() gives the metres between the samples of a placed raster. It is the only function
// that turns degrees and feet of a grid into metres. columnsRound() tells whether degrees make a
// whole turn, edgeLatitudes() between which of them the rows lie.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tetrakis/tetrakis.h"

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/earth.hpp"
#include "apps/tools/files/place/geo_keys.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {

/// Of the coordinates of a grid.
struct GridUnit {
  double degrees = 0;     ///< in one unit of an angle; 0: it is none
  double metres = 0;      ///< in one unit of a length; 0: unknown
  Ellipsoid ellipsoid{};  ///< of angles

  bool known() const { return degrees > 0 || metres > 0; }
};

/// Along rows and columns, of angles at the middle of the raster (earth.hpp), of maps on the
/// ground below it (map_scale.hpp); nothing if the unit is unknown, the middle is no latitude, or a
/// distance is none. crs: empty where it is unknown.
std::optional<std::array<double, 2>> groundSpacing(const GeoTransform& transform, uint32_t width,
                                                   uint32_t height, const GridUnit& unit,
                                                   const std::string& crs);

/// As the keys of a GeoTIFF say: of any grid in a unit that they state, else in that of the CRS.
GridUnit gridUnitOf(const GeoKeys& keys);

/// Unknown for a CRS that PROJ does not know (crs_units.hpp).
GridUnit gridUnitOf(const std::string& crs);

/// As the keys say, in the form of a text, or else the CRS.
GridUnit gridUnitOf(const std::string& geo_keys, const std::string& crs);

/// Whether the columns of a file go round the Earth, by its transform and the unit of its CRS.
/// Files without a place, and maps, do not go round.
ColumnsRound columnsRound(const Georeference& place, uint32_t width);

/// The latitudes between which the rows of a file lie (base/coordinates.hpp), by the same.
std::array<double, 2> edgeLatitudes(const Georeference& place, uint32_t height);

/// Of heights, as the stream states it, or else from their place, keys and CRS as far as these
/// tell: not every encoder knows what a CRS means. 0: unknown.
std::array<double, 2> spacingOf(const tks_info& info);

/// Sets the spacing of heights from their place and CRS, as far as these tell.
void setGroundSpacing(HeightFile& heights);

}  // namespace tetrakis::tools
