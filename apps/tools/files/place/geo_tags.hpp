// SPDX-License-Identifier: Apache-2.0
// readTransform() and the functions beside it read and write the tags that place a TIFF's pixels
// (OGC GeoTIFF 1.1, 19-008r4, 7.3; GDAL's GTiff driver).
#pragma once

#include <tiffio.h>

#include <optional>
#include <span>
#include <string>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

template <class T>
bool setTag(TIFF* tiff, uint32_t tag, std::span<const T> values) {
  return TIFFSetField(tiff, tag, static_cast<uint32_t>(values.size()), values.data()) == 1;
}

/// With its terminating zero, which TIFF counts.
bool setTag(TIFF* tiff, uint32_t tag, const std::string& text);

/// Has to come before setTag.
void announceGeoTags(TIFF* tiff);

/// As GDAL reads it: pixel scale and tiepoint, or a matrix; nothing if there are neither. The
/// origin is NaN where a tiepoint is missing. Tags whose numbers make no place are noted.
/// point: the tags speak of the middles of pixels.
std::optional<GeoTransform> readTransform(TIFF* tiff, bool point, Notes& notes);

/// The reverse, as GDAL writes it: GDAL reads the same numbers.
bool writeTransform(TIFF* tiff, const GeoTransform& transform, bool point);

}  // namespace tetrakis::tools
