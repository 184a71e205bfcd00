// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/facets/facets_encoder.hpp"

#include <cassert>

#include "bitstream/coder/decision_encoding.hpp"
#include "codec/geometry/facets/facet_coder.hpp"

namespace tetrakis::inline facets {

std::vector<uint8_t> encodeFacets(const tks_heights& samples, PlaneView<const int32_t> steps,
                                  const Window& part, const GeometryHeader& header, int unit) {
  assert(samples.sample == TKS_F32);
  assert(samples.width == steps.width && samples.height == steps.height);
  const WindowValues<int32_t> heights(steps.values(), steps.extent(), part);
  const WindowValues<uint8_t> valid(steps.valid.bytes(), steps.extent(), part);
  const auto* first =
      static_cast<const float*>(samples.data) + size_t{part.y} * samples.width + part.x;
  DecisionEncoding writer;
  codeFacets(
      {header, FacetUnit(unit), {heights.values(), part.extent(), valid.values()}, 0}, writer,
      [&](size_t i) { return first[i / part.width * samples.width + i % part.width]; },
      [](size_t, float) {});
  return writer.finish();
}

}  // namespace tetrakis::inline facets
