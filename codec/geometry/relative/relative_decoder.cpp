// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/relative/relative_decoder.hpp"

#include <cassert>

#include "base/plane.hpp"
#include "base/samples.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/corrections/correction_reader.hpp"
#include "codec/geometry/relative/relative_prediction.hpp"
#include "codec/geometry/steps/value_in_steps.hpp"

namespace tetrakis::inline relative {

namespace {

template <class T>
void restoreRows(DecodedHeights& decoded, const GeometryHeader& header,
                 const RelativeSteps& relative, CorrectionReader& reader) {
  DecodedGeometry& geometry = decoded.geometry;
  const Mask valid(geometry.valid);
  const auto [width, height] = geometry.extent();
  KnownMultiples known(width, relative);
  CorrectionCoder multiples(width, kMultipleHints, reader), rests(width, kRestHints, reader);
  for (uint32_t y = 0; y < height; ++y) {
    known.nextRow();
    multiples.nextRow();
    rests.nextRow();
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = size_t{y} * width + x;
      if (!valid[i]) continue;
      const int32_t q = wholeStep(geometry.heights[i], geometry.fraction_bits);
      const auto near = static_cast<double>(restore<T>(header.base, header.step, q));
      const RelativePrediction prediction = known.predict(x, near);
      const int32_t beside = multiples.code(x, prediction.multiple_hint, 0);
      if (reader.stopped()) return;
      const RoundedMultiple<T> rounded(prediction, prediction.number(beside), relative.step);
      const int32_t rest = rests.code(x, rounded.rest_hint, 0);
      if (reader.stopped()) return;
      const T sample = rounded.sample(rest);
      known.put(x, rounded.multiple, rest, static_cast<double>(sample));
      const ValueInSteps value = inSteps(sample, header, geometry.fraction_bits);
      geometry.heights[i] = value.height;
      decoded.corrections[i] = value.correction;
    }
  }
}

}  // namespace

DecodedHeights restoreRelative(DecodedHeights decoded, const GeometryHeader& header,
                               const RelativeSteps& relative, std::span<const uint8_t> codeword) {
  decoded.corrections.assign(decoded.geometry.heights.size(), 0);
  CorrectionReader reader(codeword);
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    restoreRows<decltype(type)>(decoded, header, relative, reader);
  });
  return decoded;
}

}  // namespace tetrakis::inline relative
