// SPDX-License-Identifier: Apache-2.0
// From coded components to the packets that meet the target of the options. Where a target lies
// next to the last bit, or where coding does not pay, other attempts become candidates beside the
// ones that are given.
#pragma once

#include <memory>

#include "base/status.hpp"
#include "encoder/inputs.hpp"
#include "encoder/selection.hpp"

namespace tetrakis {

/// heights, texture: null where there are none; coded for the target. TKS_USAGE: the PSNR is above
/// what the step of the heights allows.
Result<Selection> meetTarget(const EncodeInputs& inputs,
                             std::shared_ptr<const CodedHeights> heights,
                             std::shared_ptr<const CodedTexture> texture);

}  // namespace tetrakis
