// SPDX-License-Identifier: Apache-2.0
// GDAL's way of writing a file of a format that cannot be changed in place.
#pragma once

#include <gdal_priv.h>

namespace tetrakis::gdal {

/// Encodes heights (and the texture of the option TEXTURE) into `name` and opens that. On failure,
/// and where the progress function stops, there is no file.
GDALDataset* createCopy(const char* name, GDALDataset* source, int strict, char** options,
                        GDALProgressFunc progress, void* user);

}  // namespace tetrakis::gdal
