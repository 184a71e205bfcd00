// SPDX-License-Identifier: Apache-2.0
// noteStoredForm() finds out how the samples of an open picture file are stored, because
// OpenImageIO does not tell, and refuses a file that ends before its samples do.
#pragma once

#include "apps/tools/files/pictures/raster.hpp"

namespace tetrakis::tools {

/// Fills in how the samples of an open file are stored. TKS_IO if the file ends before they do,
/// which OpenImageIO does not tell; TKS_USAGE if it would hand over other samples than the file
/// means.
Status noteStoredForm(Raster& raster);

}  // namespace tetrakis::tools
