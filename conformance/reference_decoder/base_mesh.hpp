// SPDX-License-Identifier: Apache-2.0
// Reference decoder: what the heights of an object lie over (docs/FORMAT.md, section 11,
// "Objects").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder.hpp"
#include "conformance/reference_decoder/forest.hpp"

namespace tetrakis::reference {

/// C of all corners, four a patch.
std::vector<Vector> readCorners(std::span<const uint8_t> codeword, int bits, const Forest& forest);

/// P and the normal of all samples of the raster.
std::vector<BasePoint> bentBase(const std::vector<Vector>& corners, const Forest& forest);

}  // namespace tetrakis::reference
