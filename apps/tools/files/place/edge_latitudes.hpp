// SPDX-License-Identifier: Apache-2.0
// edgeLatitudes() gives the latitudes between which the rows of a raster lie.
#pragma once

#include <array>
#include <cstdint>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// In degrees, of the outer edges of the first row and of the last one, as tks_heights takes them;
/// both 0 where the CRS is not geographic, or rows are no parallels.
std::array<double, 2> edgeLatitudes(const Georeference& place, uint32_t height);

}  // namespace tetrakis::tools
