// SPDX-License-Identifier: Apache-2.0
// GDAL's way of writing a file of a format that cannot be changed in place.
#pragma once

#include <string>

#include <gdal_priv.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/settings.hpp"

namespace tetrakis::gdal {

/// Encodes heights (and the texture of the option TEXTURE) into `name` and opens that. On failure,
/// and where the progress function stops, there is no file.
GDALDataset* createCopy(const char* name, GDALDataset* source, int strict, char** options,
                        GDALProgressFunc progress, void* user);

/// The same of options that were read.
GDALDataset* writeCopy(const std::string& name, GDALDataset& source, bool strict,
                       const CopySettings& settings, const Progress& progress);

/// Writes the bands of a dataset as the frames of a sequence: read band by band, and written group
/// by group, in the memory of one. False after a reported error; there is no file then.
bool writeFrames(const std::string& name, GDALDataset& source, bool strict,
                 const CopySettings& settings, const Progress& progress);

}  // namespace tetrakis::gdal
