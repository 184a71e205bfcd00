// SPDX-License-Identifier: Apache-2.0
// What a name opens: a stream, a sequence of frames, or a part of either.
#pragma once

#include <gdal_priv.h>

namespace tetrakis::gdal {

int identify(GDALOpenInfo* info);
/// Null after a reported error, or where identify() is 0.
GDALDataset* open(GDALOpenInfo* info);

}  // namespace tetrakis::gdal
