// SPDX-License-Identifier: Apache-2.0
// Visual weights order the passes by what an eye sees. Encoder only.
#pragma once

#include <cstdint>

#include "bitstream/stream/texture_header.hpp"

namespace tetrakis::inline texture {

/// components: 1 to 4, the last of an even number being alpha, which is weighted like the first.
BandWeights visualWeights(uint32_t components);

}  // namespace tetrakis::inline texture
