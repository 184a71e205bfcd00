// SPDX-License-Identifier: Apache-2.0
// codeTile() is the task of a tile: it lifts the block around the tile, codes the tracks of the
// regions in it, proves that they decode to what was coded, and leaves a part for the merge and a
// low band for the next group. Or it restores what decoders will have, and codes corrections
// (restored_plane.hpp).
#pragma once

#include <cstdint>

#include "encoder/mosaic/mosaic_plan.hpp"
#include "encoder/mosaic/part.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline mosaic {

struct CodedTile {
  Part part;
  LowPart low;  ///< where MosaicGrid::leavesLow()
};

/// read: samples of the source; asked where MosaicGrid::readsSource(). files: what the tiles that
/// it needs have left. threads: nothing depends on them. Errors as of readBlock(); TKS_MISMATCH: a
/// fault of the encoder.
Result<CodedTile> codeTile(const MosaicPlan& plan, const Tile& tile, const ReadSamples& read,
                           const MosaicFiles& files, uint32_t threads);

/// The same, left in the files; its part comes last, so that a part tells that its task is done.
Status runTask(const MosaicPlan& plan, const Tile& tile, const ReadSamples& read,
               const MosaicFiles& files, uint32_t threads);

}  // namespace tetrakis::inline mosaic
