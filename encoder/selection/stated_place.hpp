// SPDX-License-Identifier: Apache-2.0
// georeferenceOf() and positionsOf() make the part of the header that says where heights and
// texture lie, from the places that the caller gives. A texture over the same ground takes one
// byte.
#pragma once

#include <vector>

#include "bitstream/stream/georeference.hpp"
#include "bitstream/stream/optional_parts.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline selection {

/// Either may be null. A texture in the reference system of the heights has none of its own.
Georeference georeferenceOf(const tks_heights* heights, const tks_image* image);

/// Their positions, as far as they have any. Either may be null.
std::vector<OptionalPart> positionsOf(const tks_heights* heights, const tks_image* image);

}  // namespace tetrakis::inline selection
