// SPDX-License-Identifier: Apache-2.0
// showColours() turns samples as a TIFF stores them into colours as textures have them.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/raster.hpp"

namespace tetrakis::tools {

/// Shades that store white as 0 are turned over, places in a palette looked up, inks mixed; fewer
/// than 8 bits become 8. Colours of 9 to 15 bits stay as they are below a white level, and their
/// alpha becomes one of 16. TKS_IO for a place that the palette lacks.
Status showColours(const Raster& raster, ImageFile& image);

}  // namespace tetrakis::tools
