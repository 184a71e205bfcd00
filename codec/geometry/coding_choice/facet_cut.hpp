// SPDX-License-Identifier: Apache-2.0
// chooseFacetCut() decides where to cut the coefficients of a surface of facets, whose samples are
// restored behind the cut. Only samples beyond edges need the decoded heights: each takes a bit
// less for each halving of their error, and a halving takes coefficients all over the plane.
#pragma once

#include "base/plane.hpp"
#include "codec/geometry/facets/facet_share.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"

namespace tetrakis::inline coding_choice {

/// The mean squared error, in steps, that the cut leaves, by typical parts of the heights. For the
/// sake of prefixes it is the finest cut that takes a tenth more bytes in all than the best cut, or
/// a quarter more where there is room for that. room: bytes.
double chooseFacetCut(const HeightSteps& steps, Extent extent, const FacetShare& facets,
                      double room);

}  // namespace tetrakis::inline coding_choice
