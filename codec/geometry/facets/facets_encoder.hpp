// SPDX-License-Identifier: Apache-2.0
// This file codes the difference between decoded heights and samples of facets (facet_coder.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline facets {

/// The codeword that leads from decoded heights to the samples of a part, whatever these are.
/// samples: floats. steps: the heights in whole steps, and which of them are valid. header: base
/// and step. unit: of FacetUnit.
std::vector<uint8_t> encodeFacets(const tks_heights& samples, PlaneView<const int32_t> steps,
                                  const Window& part, const GeometryHeader& header, int unit);

}  // namespace tetrakis::inline facets
