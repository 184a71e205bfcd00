// SPDX-License-Identifier: Apache-2.0
// This file says what the header tells of where the inputs lie.
#pragma once

#include "bitstream/stream/georeference.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline selection {

/// Either may be null. A texture in the reference system of the heights has none of its own.
Georeference georeferenceOf(const tks_heights* heights, const tks_image* image);

}  // namespace tetrakis::inline selection
