// SPDX-License-Identifier: Apache-2.0
// This file restores samples that have a relative step from a codeword and decoded heights
// (relative_pass.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline relative {

/// The heights with the samples restored, row by row, as far as they are decided; meshes pass
/// through these as well. decoded: first rows of what encodeRelative() coded, whole, without
/// corrections. codeword: any prefix of its one. relative: a finite and positive step, 1 to 4
/// quarters. Safe on any bytes.
DecodedHeights restoreRelative(DecodedHeights decoded, const GeometryHeader& header,
                               const RelativeSteps& relative, std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline relative
