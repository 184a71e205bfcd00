// SPDX-License-Identifier: Apache-2.0
// Copies of heights that memory does not hold: read window by window, coded tile by tile, and
// merged into a file (include/tetrakis/mosaic.h).
#pragma once

#include <string>

#include <gdal_priv.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/settings.hpp"

namespace tetrakis::gdal {

/// Whether the option TILES asks for a mosaic, or heights are so large.
bool wantsMosaic(GDALDataset& source, const CopySettings& settings);

struct MosaicCopy {
  bool written = false;
  double rounding = 0;  ///< of the heights, in their unit
  std::string why_not;  ///< a sentence about what only a copy in memory does; "": nothing
};

/// Writes `name`. Neither `written` nor `why_not`: an error was reported, and there is no file.
MosaicCopy writeMosaic(const std::string& name, GDALDataset& source, bool strict,
                       const CopySettings& settings, const Progress& progress);

}  // namespace tetrakis::gdal
