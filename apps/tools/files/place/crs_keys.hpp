// SPDX-License-Identifier: Apache-2.0
// The functions here make the GeoTIFF keys of a reference system, as GDAL writes them. A stream
// states a CRS by its EPSG code if the keys that this file would write for that code hold every key
// of the input file. Otherwise it keeps the keys as text, which is shorter than WKT2.
#pragma once

#include <string>

#include "apps/tools/files/place/geo_keys.hpp"

namespace tetrakis::tools {

/// Whether a CRS of longitude, latitude and height is this one with heights, both by EPSG codes.
/// The keys have both codes, that of three dimensions as that of the heights.
bool addsHeightsTo(const std::string& crs, const std::string& spatial);

/// Of a CRS ("EPSG:code", WKT, or a name; "" if unknown) and what the heights are above, likewise:
/// codes where PROJ has some, names and, of a CRS, WKT where it does not. unit: of heights above
/// something that has no code.
GeoKeys crsKeys(const std::string& crs, const std::string& vertical_datum, const std::string& unit);

/// All keys of heights: their geo_keys, or what their CRS, vertical datum and spacing make.
GeoKeys keysOf(const HeightFile& heights);

/// All keys of a raster without heights.
GeoKeys keysOf(const Georeference& place);

}  // namespace tetrakis::tools
