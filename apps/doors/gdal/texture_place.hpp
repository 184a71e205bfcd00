// SPDX-License-Identifier: Apache-2.0
// Where a texture lies that has a place of its own, against that of the heights.
#pragma once

#include <gdal_priv.h>

namespace tetrakis::gdal {

/// Whether no sample of the heights has a texel, as the command line decides it
/// (apps/tools/files/place/texture_place.cpp). False where one of the two has no place, or nothing
/// tells how these lie to each other.
bool liesBeside(GDALDataset& texture, GDALDataset& heights);

}  // namespace tetrakis::gdal
