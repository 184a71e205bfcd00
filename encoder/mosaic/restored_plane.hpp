// SPDX-License-Identifier: Apache-2.0
// restorePlane() and codeCorrections() are the tasks behind a cut of the coefficients. The first
// decodes the samples of a tile as decoders of the finished stream will: from the codewords of the
// regions around it, above the low band that the group before has restored. The second codes the
// differences of the samples of the source from these, region by region, as the encoder of a whole
// plane does (encoder/heights/ways/).
#pragma once

#include <vector>

#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "encoder/mosaic/block.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline mosaic {

/// The samples of the tile, in the plane of its group, with the marks of the vertices that have a
/// significant coefficient. inputs: of a tile that restores. TKS_IO: parts are missing or damaged.
Result<DecodedGeometry> restorePlane(const TaskInputs& inputs);

/// The tracks of the corrections of a tile that restores samples. restored: restorePlane(). Points
/// of the tracks count squared steps. TKS_IO: samples cannot be read. TKS_USAGE: a sample that the
/// plan does not allow. TKS_MISMATCH: a fault of the encoder: corrected samples do not keep what
/// the target promises.
Result<std::vector<EncodedTrack>> codeCorrections(const TaskInputs& inputs,
                                                  DecodedGeometry restored);

}  // namespace tetrakis::inline mosaic
