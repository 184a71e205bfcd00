// SPDX-License-Identifier: Apache-2.0
// fromSteps() turns the steps of decoded heights into samples: sample = base + q * step, plus a
// correction where there is one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline steps {

/// Writes samples of header.sample, one for each height of `decoded`; integers saturate at their
/// type's range. Voids become layers.nodata or NaN; a height that would be the declared nodata
/// value becomes the next sample, whether there are voids or not.
void fromSteps(const DecodedHeights& decoded, const GeometryHeader& header,
               const GeometryLayers& layers, void* out);

/// The hints (codec/geometry/corrections/corrections_pass.hpp) of corrections of samples, from the
/// heights that the samples come from, as decoders know them.
std::vector<uint8_t> sampleHints(std::span<const int32_t> heights, int fraction_bits,
                                 const GeometryHeader& header);

}  // namespace tetrakis::inline steps
