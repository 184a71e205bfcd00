// SPDX-License-Identifier: Apache-2.0
// meetTarget() takes the coded components and returns the packets of both that meet the target of
// the options. Where the target lies next to the last bit, or where coding saves no bytes, it codes
// a component in another way as well and takes the way of fewer bytes.
#pragma once

#include <memory>

#include "base/status.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"

namespace tetrakis::inline targets {

/// heights, texture: null where the stream has none; coded for the target. TKS_USAGE: the PSNR is
/// higher than the step of the heights allows.
Result<Selection> meetTarget(const EncodeInputs& inputs,
                             std::shared_ptr<const CodedHeights> heights,
                             std::shared_ptr<const CodedTexture> texture);

}  // namespace tetrakis::inline targets
