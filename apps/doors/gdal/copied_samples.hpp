// SPDX-License-Identifier: Apache-2.0
// The samples of a band as a stream takes them.
#pragma once

#include <optional>
#include <string>

#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/narrowed_band.hpp"

namespace tetrakis::gdal {

/// The type of the samples in a stream, where doubles are floats; nothing if no stream takes them.
std::optional<tks_sample> sampleOf(GDALRasterBand& band);

/// Reads the samples into the copy, whose type of samples is known. strict: doubles that no float
/// holds are refused; else a warning tells that they are rounded. The nodata value of doubles
/// becomes that of floats. False after a reported error.
bool readSamples(const std::string& name, GDALRasterBand& band, bool strict, CopiedHeights& copy,
                 const ProgressPart& progress);

/// What doubles that were all read have become: refused or warned of as above, and their nodata
/// value. False after a reported error.
bool takeNarrowed(const std::string& name, const NarrowedBand& doubles, bool strict,
                  CopiedHeights& copy);

/// What rounding leaves of a largest error, in samples, to the stream, in the unit of the heights.
/// heights: null without any. Nothing after a reported error.
std::optional<double> boundOf(const std::string& name, const CopiedHeights* heights,
                              double max_z_error);

/// Reports a failure that GDAL has not reported: it is the user's who stops. False.
bool reportStop(const std::string& name);

}  // namespace tetrakis::gdal
