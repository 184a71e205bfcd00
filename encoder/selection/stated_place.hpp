// SPDX-License-Identifier: Apache-2.0
// georeferenceOf() and positionsOf() make the part of the header that says where heights and
// texture lie, from the places that the caller gives. A texture over the same ground takes one
// byte.
#pragma once

#include <string>

#include "bitstream/stream/georeference.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline selection {

/// Either may be null. A texture in the reference system of the heights has none of its own.
Georeference georeferenceOf(const tks_heights* heights, const tks_image* image);

/// The positions of heights or of an image, which may be null; "" if it has none.
template <class Raster>
std::string positionsOf(const Raster* raster) {
  if (raster == nullptr || raster->positions == nullptr) return {};
  return {reinterpret_cast<const char*>(raster->positions), raster->positions_size};
}

}  // namespace tetrakis::inline selection
