// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/facets/facet_coder.hpp"

#include <cassert>

#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/steps/restore.hpp"

namespace tetrakis::inline facets {

DecodedHeights restoreFacets(DecodedHeights decoded, const GeometryHeader& header, int unit,
                             std::span<const uint8_t> codeword) {
  assert(header.sample == TKS_F32);
  DecodedGeometry& geometry = decoded.geometry;
  decoded.corrections.assign(geometry.heights.size(), 0);
  DecisionDecoding reader(codeword);
  const StepGrid grid(header.base, header.step);
  const PlaneView<const int32_t> plane(geometry.heights, geometry.extent(), geometry.valid);
  codeFacets(
      {header, FacetUnit(unit), plane, geometry.fraction_bits}, reader,
      [](size_t) { return float{}; },
      [&](size_t i, float sample) {
        const ValueInSteps value = inSteps(sample, header, grid, geometry.fraction_bits);
        geometry.heights[i] = value.height;
        decoded.corrections[i] = value.correction;
      });
  return decoded;
}

}  // namespace tetrakis::inline facets
