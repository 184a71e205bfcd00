// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/relative/relative_pass.hpp"

#include "base/samples.hpp"
#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/steps/restore.hpp"

namespace tetrakis::inline relative {

DecodedHeights restoreRelative(DecodedHeights decoded, const GeometryHeader& header,
                               const RelativeSteps& relative, std::span<const uint8_t> codeword) {
  DecodedGeometry& geometry = decoded.geometry;
  decoded.corrections.assign(geometry.heights.size(), 0);
  DecisionDecoding reader(codeword);
  const StepGrid grid(header.base, header.step);
  const PlaneView<const int32_t> plane(geometry.heights, geometry.extent(), geometry.valid);
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    codeRelativeRows<T>(
        {header, relative, plane, geometry.fraction_bits}, reader, [](size_t) { return T{}; },
        [&](size_t i, T sample) {
          const ValueInSteps value = inSteps(sample, header, grid, geometry.fraction_bits);
          geometry.heights[i] = value.height;
          decoded.corrections[i] = value.correction;
        });
  });
  return decoded;
}

}  // namespace tetrakis::inline relative
