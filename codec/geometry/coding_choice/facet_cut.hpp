// SPDX-License-Identifier: Apache-2.0
// Where to cut the coefficients of a surface of facets, whose samples are restored behind the cut.
// Only samples beyond edges need the decoded heights: each takes a bit less for each halving of
// their error, and a halving takes coefficients all over the plane.
#pragma once

#include "base/plane.hpp"
#include "codec/geometry/facets/facet_share.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"

namespace tetrakis::inline coding_choice {

struct FacetCut {
  double mean_square = 0;  ///< squared error of a sample, in steps, that it leaves
  double bytes = 0;        ///< of it and of what follows, mostly within a tenth
};

/// A cut by typical parts of the heights. For the sake of prefixes it is the finest one that takes,
/// in all, a tenth more bytes than the best, or a quarter more where there is room for that.
FacetCut chooseFacetCut(const HeightSteps& steps, Extent extent, const FacetShare& facets,
                        double room);

}  // namespace tetrakis::inline coding_choice
