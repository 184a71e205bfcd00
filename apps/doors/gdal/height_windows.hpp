// SPDX-License-Identifier: Apache-2.0
// A band of GDAL as heights that come by windows, for those that memory does not hold. Samples and
// voids are those of copyHeights().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/narrowed_band.hpp"
#include "tetrakis/mosaic.h"

namespace tetrakis::gdal {

/// Move only.
class HeightWindows {
 public:
  /// Doubles are read once, since their rounding depends on all of them. strict: as of
  /// copyHeights(). Null after a reported error.
  static std::unique_ptr<HeightWindows> of(const std::string& name, GDALDataset& dataset,
                                           bool strict, const ProgressPart& progress);

  /// Without samples.
  CopiedHeights& heights() { return *copy_; }

  /// Reads samples of the type of the heights, row by row. False after an error of GDAL.
  bool read(const tks_window& window, void* samples);

 private:
  HeightWindows(GDALRasterBand& band, std::unique_ptr<CopiedHeights> copy);

  bool narrow(const std::string& name, bool strict, const ProgressPart& progress);
  bool readPlain(const tks_window& window, void* samples);
  bool hideMasked(const tks_window& window, void* samples);

  GDALRasterBand& band_;
  std::unique_ptr<CopiedHeights> copy_;
  std::optional<NarrowedBand> doubles_;
  std::optional<double> hidden_;  ///< what the mask makes of samples
  std::vector<GByte> mask_;
};

/// Whether a mask hides samples, and no nodata value is there for them: to choose one takes all
/// samples.
bool lacksNodata(GDALRasterBand& band, const tks_heights& heights);

}  // namespace tetrakis::gdal
