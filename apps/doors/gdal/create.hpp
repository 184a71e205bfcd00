// SPDX-License-Identifier: Apache-2.0
// GDAL's way of writing a file piece by piece. A stream is written at once, from all samples: these
// are kept in a temporary file until the dataset is closed.
#pragma once

#include <gdal_priv.h>

namespace tetrakis::gdal {

/// A dataset to write and read, of which `name` becomes a copy when it is closed; until then there
/// is no such file, nor is there one where something failed. Null after a reported error.
GDALDataset* create(const char* name, int width, int height, int bands, GDALDataType type,
                    char** options);

}  // namespace tetrakis::gdal
