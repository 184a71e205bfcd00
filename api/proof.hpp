// SPDX-License-Identifier: Apache-2.0
// prove() decodes a finished stream through the public interface and compares it with the input:
// the byte budget, the largest error, and every bit where the stream calls itself lossless. No
// caller gets a stream that breaks a promise.
#pragma once

#include <cstdint>
#include <span>

#include "base/status.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// Decodes the finished stream through the public interface and compares: a budget, a largest
/// error, and every bit where the target or the stream says lossless. heights and image (null:
/// there is none) are what was encoded. TKS_MISMATCH with a sentence if a promise is broken, which
/// is a fault of the encoder. Streams that promise nothing are not decoded.
Status prove(std::span<const uint8_t> stream, const tks_heights* heights, const tks_image* image,
             const tks_encode_options& options);

}  // namespace tetrakis::inline api
