// SPDX-License-Identifier: Apache-2.0
// Metres between the samples of a placed raster. It follows the command line
// (apps/tools/files/place).
#pragma once

#include <gdal_priv.h>
#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// States how many metres lie between columns and between rows, at the middle of the raster: of
/// degrees on the ellipsoid of the system, of maps on the ground below, unless the map is as good.
/// States nothing where the system or the place are unknown, or a distance is none.
void setGroundSpacing(const OGRSpatialReference* system, tks_heights& heights);

}  // namespace tetrakis::gdal
