// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/relative/relative_encoder.hpp"

#include <cassert>
#include <cmath>

#include "base/samples.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "codec/geometry/relative/relative_pass.hpp"

namespace tetrakis::inline relative {

std::vector<uint8_t> encodeRelative(const tks_heights& samples, PlaneView<const int32_t> steps,
                                    const Window& part, const GeometryHeader& header,
                                    const RelativeSteps& relative) {
  assert(samples.width == steps.width && samples.height == steps.height);
  assert(std::isfinite(relative.step) && relative.step > 0);
  const Extent plane = steps.extent();
  const WindowValues<int32_t> heights(steps.values(), plane, part);
  const WindowValues<uint8_t> valid(steps.valid.bytes(), plane, part);
  DecisionEncoding writer;
  withSampleType(samples.sample, [&](auto type) {
    using T = decltype(type);
    const WindowValues<T> exact({static_cast<const T*>(samples.data), plane.samples()}, plane,
                                part);
    codeRelativeRows<T>(
        {header, relative, {heights.values(), part.extent(), valid.values()}, 0}, writer,
        [&](size_t i) { return exact.values()[i]; }, [](size_t, T) {});
  });
  return writer.finish();
}

}  // namespace tetrakis::inline relative
