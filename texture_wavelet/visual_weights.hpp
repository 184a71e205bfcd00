// SPDX-License-Identifier: Apache-2.0
// visualWeights() gives each band of each colour plane a weight, so that passes come in the order
// in which an eye notices them. Encoder only.
#pragma once

#include <cstdint>

#include "bitstream/stream/texture_header.hpp"

namespace tetrakis::inline texture {

/// planes: 1 to 4, the last of an even number being alpha or a further colour, which is weighted
/// like the first.
BandWeights visualWeights(uint32_t planes);

}  // namespace tetrakis::inline texture
