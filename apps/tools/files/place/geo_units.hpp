// SPDX-License-Identifier: Apache-2.0
// The functions here tell from the keys of a GeoTIFF in which units its grid and its heights are.
#pragma once

#include <optional>
#include <string>

#include "apps/tools/files/place/earth.hpp"
#include "apps/tools/files/place/geo_keys.hpp"

namespace tetrakis::tools {

/// Metres in one unit of a projected grid: as the unit keys say, else as the CRS says by its code
/// or citation; nothing if neither tells. GDAL leaves the unit keys out of compound CRSs.
std::optional<double> gridUnit(const GeoKeys& keys);

/// Of a grid that need not be projected, as of a building site: as the unit keys say, or nothing.
std::optional<double> statedGridUnit(const GeoKeys& keys);

/// Degrees in one unit of a geographic grid: as the unit keys say, else as the CRS says by its
/// code, else 1; 0 if the unit that is stated is none.
double angleUnit(const GeoKeys& keys);

/// That of the Earth where no axis is stated, as beside a code.
Ellipsoid statedEllipsoid(const GeoKeys& keys);

/// Where the model is neither projected nor geographic, Esri and GDAL write WKT; "" if none.
std::string wktIn(const GeoKeys& keys);

/// Whether a vertical CRS or unit is stated at all.
bool statesHeights(const GeoKeys& keys);

/// The unit of the heights, as the unit key or the vertical CRS says; nothing if neither tells.
std::optional<std::string> heightUnit(const GeoKeys& keys);

}  // namespace tetrakis::tools
