// SPDX-License-Identifier: Apache-2.0
// textureBytes() computes from the header how many bytes of memory it takes to decode a view of the
// texture.
#pragma once

#include <cstdint>

#include "api/decoder.hpp"

namespace tetrakis::inline api {

/// Bytes for a view of the texture of a decoder, which has one.
uint64_t textureBytes(const tks_decoder& decoder, const View& view);

}  // namespace tetrakis::inline api
