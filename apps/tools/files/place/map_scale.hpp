// SPDX-License-Identifier: Apache-2.0
// ellipsoidOf() and groundUnderMap() relate coordinates of a CRS to the ground: on which ellipsoid
// the CRS lies, and how much larger than the ground its map is (Web Mercator twice at 60 degrees).
#pragma once

#include <array>
#include <string>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/earth.hpp"

namespace tetrakis::tools {

/// That of the Earth for a CRS that PROJ does not know.
Ellipsoid ellipsoidOf(const std::string& crs);

/// Metres of the ground between the columns and between the rows of a raster, at its middle.
/// of_map: those of its map. They stay where none is off by a hundredth, as on grids of surveyors,
/// and where PROJ does not know the CRS.
std::array<double, 2> groundUnderMap(const std::array<double, 2>& of_map, const std::string& crs,
                                     const GeoTransform& transform, uint32_t width,
                                     uint32_t height);

}  // namespace tetrakis::tools
