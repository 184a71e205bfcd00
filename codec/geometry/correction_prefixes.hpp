// SPDX-License-Identifier: Apache-2.0
// prefixesOfCorrections() gives the heights behind each prefix of their corrections, for encoders
// that measure many prefixes. It corrects all samples once instead of decoding each prefix anew.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline geometry {

/// Returns a function that gives the same heights as decodeHeights() of the first bytes of the
/// track, where `bytes` bytes of corrections, 1 or more, follow the whole coefficients. track: the
/// only one of the heights, which have corrections, as an encoder wrote it; it and the headers
/// outlive the result. The work begins at the first call.
std::function<DecodedHeights(uint64_t bytes)> prefixesOfCorrections(const GeometryHeader& header,
                                                                    const GeometryLayers& layers,
                                                                    std::span<const uint8_t> track);

}  // namespace tetrakis::inline geometry
