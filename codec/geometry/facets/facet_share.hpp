// SPDX-License-Identifier: Apache-2.0
// The functions here measure how much of a surface consists of facets (facet_rows.hpp), so that an
// encoder tries them only where they may pay.
#pragma once

#include "base/plane.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline facets {

struct FacetShare {
  double beyond = 1;   ///< the part of the samples that no prediction comes near
  double spacing = 1;  ///< the geometric mean of their distances to the next floats
  int unit = 1;        ///< that suits the samples, of FacetUnit
};

/// By bands of rows that are spread over the plane. heights: floats.
FacetShare findFacets(const tks_heights& heights, Mask valid);

}  // namespace tetrakis::inline facets
