// SPDX-License-Identifier: Apache-2.0
// openWithMask() puts the mask of a region, or of the base, in front of its coefficients. So no
// task and no merge holds the mask of a whole plane (codec/geometry/region_masks.hpp).
#pragma once

#include <cstdint>

#include "bitstream/track/track_encoder.hpp"
#include "encoder/mosaic/block.hpp"

namespace tetrakis::inline mosaic {

/// Returns how many bytes the mask takes. block: of the plane that the tile codes; the region lies
/// in it. track: of the region's coefficients; it stays empty where nothing has to be told.
uint64_t openWithMask(const TaskInputs& inputs, const Block& block, const Region& region,
                      EncodedTrack& track);

}  // namespace tetrakis::inline mosaic
