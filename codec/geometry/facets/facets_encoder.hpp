// SPDX-License-Identifier: Apache-2.0
// findFacets() tells how much of a surface consists of facets, and encodeFacets() codes its samples
// as parts of them, behind decoded heights. restoreFacets() (facet_coder.hpp) takes that back.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline facets {

// findFacets() measures how much of a surface consists of facets (facet_rows.hpp), so that an
// encoder tries them only where they may pay.

struct FacetShare {
  double beyond = 1;   ///< the part of the samples that no prediction comes near
  double spacing = 1;  ///< the geometric mean of their distances to the next floats
  int unit = 1;        ///< that suits the samples, of FacetUnit
};

/// By bands of rows that are spread over the plane. heights: floats.
FacetShare findFacets(const tks_heights& heights, Mask valid);

// encodeFacets() codes the difference between decoded heights and samples of facets
// (facet_coder.hpp).

/// The codeword that leads from decoded heights to the samples of a part, whatever these are.
/// samples: floats. steps: the heights in whole steps, and which of them are valid. header: base
/// and step. unit: of FacetUnit.
std::vector<uint8_t> encodeFacets(const tks_heights& samples, PlaneView<const int32_t> steps,
                                  const Window& part, const GeometryHeader& header, int unit);

}  // namespace tetrakis::inline facets
