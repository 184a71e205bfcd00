// SPDX-License-Identifier: Apache-2.0
// Which samples of a band are no heights, by its nodata value, its mask or what files write there,
// and how a stream says so. The rules are those of the command line (tools/files), whose files GDAL
// writes and reads too.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "doors/gdal/copied_raster.hpp"

namespace tetrakis::gdal {

/// As GDAL compares samples with a nodata value.
template <class T>
bool nearlyEqual(T sample, T nodata) {
  constexpr T kRelative = 2 * std::numeric_limits<float>::epsilon();
  return sample == nodata || std::abs(sample - nodata) < kRelative * std::abs(sample + nodata);
}

/// The nodata value of a band; nothing if it declares none.
std::optional<double> nodataOf(GDALRasterBand& band);

/// A nodata value as floats hold it.
float floatNodata(double nodata);

/// Whether the band has a mask that is more than its nodata value.
bool hasMask(GDALRasterBand& band);

/// Declares the nodata value; floats that GDAL takes for it become it.
void takeNodata(GDALRasterBand& band, CopiedHeights& copy);

/// Samples that a mask band leaves out become the nodata value; one is chosen if there is none.
bool applyMask(const std::string& name, GDALRasterBand& band, CopiedHeights& copy);

/// A copy that need not be strict declares what files write where they have no height, as
/// gdal_translate -a_nodata would.
void takeFill(const std::string& name, CopiedHeights& copy);

}  // namespace tetrakis::gdal
