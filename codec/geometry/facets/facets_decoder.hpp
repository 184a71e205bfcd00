// SPDX-License-Identifier: Apache-2.0
// This file restores samples of facets (facet_coder.hpp) from a codeword and decoded heights.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline facets {

/// The heights with the samples restored, row by row, as far as they are decided; meshes pass
/// through these as well. decoded: first rows of what encodeFacets() coded, whole, without
/// corrections. header: of floats. unit: of FacetUnit. codeword: any prefix of its one. Safe on any
/// bytes.
DecodedHeights restoreFacets(DecodedHeights decoded, const GeometryHeader& header, int unit,
                             std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline facets
