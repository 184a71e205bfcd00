// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/relative/relative_encoder.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "base/samples.hpp"
#include "codec/geometry/corrections/correction_writer.hpp"
#include "codec/geometry/relative/relative_prediction.hpp"
#include "codec/geometry/steps/restore.hpp"

namespace tetrakis::inline relative {

namespace {

/// How many multiples the sample lies beside the predicted one, to the side of the height, modulo
/// 2^32.
int32_t multiplesBeside(const RelativePrediction& prediction, double sample, double step) {
  constexpr double kFarthest = 1 << 30;
  const double steps = (sample - prediction.origin) / step;
  if (std::isnan(steps)) return 0;
  const double number = std::round(std::clamp(steps, -kFarthest, kFarthest));
  const auto whole = static_cast<uint32_t>(static_cast<int32_t>(number));
  const uint32_t beside = whole - static_cast<uint32_t>(prediction.nearest);
  return static_cast<int32_t>(prediction.above ? 0u - beside : beside);
}

/// samples, steps: of the same part.
template <class T>
void writeRows(std::span<const T> samples, const PlaneView<const int32_t>& steps,
               const GeometryHeader& header, const RelativeSteps& relative,
               CorrectionWriter& writer) {
  const uint32_t width = steps.width;
  KnownMultiples known(width, relative);
  CorrectionCoder multiples(width, kMultipleHints, writer), rests(width, kRestHints, writer);
  for (uint32_t y = 0; y < steps.height; ++y) {
    known.nextRow();
    multiples.nextRow();
    rests.nextRow();
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = size_t{y} * width + x;
      if (!steps.valid[i]) continue;
      const auto near = static_cast<double>(restore<T>(header.base, header.step, steps.data[i]));
      const RelativePrediction prediction = known.predict(x, near);
      const auto sample = static_cast<double>(samples[i]);
      const int32_t beside = multiplesBeside(prediction, sample, relative.step);
      const RoundedMultiple<T> rounded(prediction, prediction.number(beside), relative.step);
      const int32_t rest = rounded.restOf(samples[i]);
      multiples.code(x, prediction.multiple_hint, beside);
      rests.code(x, rounded.rest_hint, rest);
      known.put(x, rounded.multiple, rest, sample);
    }
  }
}

}  // namespace

std::vector<uint8_t> encodeRelative(const tks_heights& samples, PlaneView<const int32_t> steps,
                                    const Window& part, const GeometryHeader& header,
                                    const RelativeSteps& relative) {
  assert(samples.width == steps.width && samples.height == steps.height);
  assert(std::isfinite(relative.step) && relative.step > 0);
  const Extent plane = steps.extent();
  const WindowValues<int32_t> heights(steps.values(), plane, part);
  const WindowValues<uint8_t> valid(steps.valid.bytes(), plane, part);
  CorrectionWriter writer;
  withSampleType(samples.sample, [&](auto type) {
    using T = decltype(type);
    const WindowValues<T> exact({static_cast<const T*>(samples.data), plane.samples()}, plane,
                                part);
    writeRows<T>(exact.values(), {heights.values(), part.extent(), valid.values()}, header,
                 relative, writer);
  });
  return writer.finish();
}

}  // namespace tetrakis::inline relative
