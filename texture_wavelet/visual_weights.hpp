// SPDX-License-Identifier: Apache-2.0
// Visual weights order the passes by what an eye sees. Encoder only.
#pragma once

#include <cstdint>

#include "bitstream/stream/texture_header.hpp"

namespace tetrakis::inline texture {

/// planes: 1 to 4, the last of an even number being alpha or a further colour, which is weighted
/// like the first.
BandWeights visualWeights(uint32_t planes);

}  // namespace tetrakis::inline texture
