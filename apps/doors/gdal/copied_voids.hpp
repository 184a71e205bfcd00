// SPDX-License-Identifier: Apache-2.0
// Which samples of a band are no heights, by its nodata value, its mask or what files write there,
// and how a stream says so. The rules are those of the command line (apps/tools/files), whose files
// GDAL writes and reads too.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "apps/doors/gdal/copied_raster.hpp"

namespace tetrakis::gdal {

/// The nodata value of a band; nothing if it declares none.
std::optional<double> nodataOf(GDALRasterBand& band);

/// Whether the band has a mask that is more than its nodata value.
bool hasMask(GDALRasterBand& band);

/// Declares the nodata value, that of doubles as their samples have it by now; floats that GDAL
/// takes for it become it. A warning tells of a value that makes nothing void, or that is another
/// one among floats of 32 bits.
void takeNodata(const std::string& name, GDALRasterBand& band, CopiedHeights& copy);

/// Whether a sample can have the nodata value that is declared.
bool canHaveNodata(const tks_heights& heights);

/// Gives samples of a type a value where a mask is 0.
void hide(tks_sample type, std::span<std::byte> samples, std::span<const GByte> mask, double value);

/// Floats that GDAL takes for the nodata value become it.
void settleNodata(std::span<float> samples, double nodata);

/// Samples that a mask band leaves out become the nodata value; one is chosen if there is none.
bool applyMask(const std::string& name, GDALRasterBand& band, CopiedHeights& copy);

/// Warns of samples that lie far from all others and are not the nodata value. Where none is
/// declared, a copy that need not be strict declares what files write where they have no height, as
/// gdal_translate -a_nodata would.
void takeFill(const std::string& name, bool strict, CopiedHeights& copy);

/// The same of a part of the samples: what stands in it for voids, if none is declared.
std::optional<double> fillIn(const tks_heights& part);
/// What takeFill() does with it.
void declareFill(const std::string& name, bool strict, double fill, CopiedHeights& copy);

}  // namespace tetrakis::gdal
