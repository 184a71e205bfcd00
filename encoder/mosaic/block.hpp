// SPDX-License-Identifier: Apache-2.0
// readBlock() fetches what the task of a tile lifts: the samples of the tile and of its halo in
// steps, or as much of the low bands that the group before has left. A Block is a plane of its own
// for the transform.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/mosaic/mosaic_plan.hpp"
#include "encoder/mosaic/part.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline mosaic {

struct Block {
  Window window;                ///< of the plane of the group
  std::vector<int32_t> values;  ///< as the transform takes them; 0 where there is none
  PartMask valid;
};

/// The heights of a window of the source, as the plan describes them. samples: outlives this.
tks_heights heightsOf(const MosaicPlan& plan, const Window& window, const void* samples);

/// Steps of heights, with the fraction bits of the transform. valid: the samples that are not void.
/// window: where they lie, for messages. TKS_USAGE: a sample does not come back as the target of
/// the plan promises.
Result<std::vector<int32_t>> stepsOf(const MosaicPlan& plan, const tks_heights& heights, Mask valid,
                                     const Window& window);

/// TKS_IO: samples or parts cannot be read. TKS_USAGE: samples that the plan does not allow: voids
/// where it says that there are none, infinities, or as stepsOf() says.
Result<Block> readBlock(const MosaicPlan& plan, const MosaicGrid& grid, const Tile& tile,
                        const ReadSamples& read, const MosaicFiles& files);

}  // namespace tetrakis::inline mosaic
