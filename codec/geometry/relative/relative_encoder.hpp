// SPDX-License-Identifier: Apache-2.0
// This file codes the corrections of samples that have a relative step (relative_pass.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline relative {

/// The codeword that leads from decoded heights to the samples of a part, whatever these are.
/// steps: the heights in whole steps, and which of them are valid. header: base and step. relative:
/// a finite and positive step, 1 to 4 quarters.
std::vector<uint8_t> encodeRelative(const tks_heights& samples, PlaneView<const int32_t> steps,
                                    const Window& part, const GeometryHeader& header,
                                    const RelativeSteps& relative);

}  // namespace tetrakis::inline relative
