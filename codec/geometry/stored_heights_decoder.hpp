// SPDX-License-Identifier: Apache-2.0
// decodeStoredHeights() decodes heights that are stored sample by sample, because coding them would
// take more bytes.
#pragma once

#include <cstdint>
#include <span>

#include "base/bit_plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline geometry {

/// Returns the samples of a view. Their steps are those nearest to the samples, and corrections
/// restore the samples. A sample that has no byte yet is that of step 0. bytes: any prefix of the
/// stored bytes of a geometry with header.stored(). valid: of the whole plane.
DecodedHeights decodeStoredHeights(const GeometryHeader& header, std::span<const uint8_t> bytes,
                                   const SharedBits& valid, const View& view);

}  // namespace tetrakis::inline geometry
