// SPDX-License-Identifier: Apache-2.0
// The samples of a band as a stream takes them.
#pragma once

#include <optional>
#include <string>

#include "apps/doors/gdal/copied_raster.hpp"

namespace tetrakis::gdal {

/// The type of the samples in a stream, where doubles are floats; nothing if no stream takes them.
std::optional<tks_sample> sampleOf(GDALRasterBand& band);

/// Reads the samples into the copy, whose type of samples is known. strict: doubles that no float
/// holds are refused; else a warning tells that they are rounded. The nodata value of doubles
/// becomes that of floats. False after a reported error.
bool readSamples(const std::string& name, GDALRasterBand& band, bool strict, CopiedHeights& copy,
                 const ProgressPart& progress);

}  // namespace tetrakis::gdal
