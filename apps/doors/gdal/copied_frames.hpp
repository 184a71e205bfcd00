// SPDX-License-Identifier: Apache-2.0
// Copies of the bands of a dataset as the frames of a sequence: read band by band, and written
// group by group, in the memory of one.
#pragma once

#include <string>

#include <gdal_priv.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/settings.hpp"

namespace tetrakis::gdal {

/// Writes `name`. False after a reported error; there is no file then.
bool writeFrames(const std::string& name, GDALDataset& source, bool strict,
                 const CopySettings& settings, const Progress& progress);

}  // namespace tetrakis::gdal
