// SPDX-License-Identifier: Apache-2.0
// codeRelativeRows() walks over samples that have a relative step (relative_prediction.hpp), for
// both sides: row by row, two corrections for each sample that exists.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/relative/relative_prediction.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline relative {

/// What such samples are restored from.
struct RelativeHeights {
  const GeometryHeader& header;  ///< base and step
  const RelativeSteps& relative;
  PlaneView<const int32_t> plane;  ///< in units of 2^-fraction_bits steps
  int fraction_bits;
};

/// How many multiples the sample lies beside the predicted one, to the side of the height, modulo
/// 2^32; 0 for what is no number.
template <class T>
int32_t multiplesBeside(const RelativePrediction& prediction, T sample, const StepUnits& units) {
  if (!isNumber(sample)) return 0;
  const int64_t rise = inUnits(sample, units.exponent) - prediction.origin;
  const auto whole = static_cast<uint32_t>(nearestSteps(rise, units.step));
  const uint32_t beside = whole - static_cast<uint32_t>(prediction.nearest);
  return static_cast<int32_t>(prediction.above ? 0u - beside : beside);
}

/// T: of the samples. Io: as of CorrectionCoder. exact(i): sample i, or anything in decoders.
/// take(i, sample): takes these one after the other, up to the first undecided one.
template <class T, class Io, class ExactSample, class TakeSample>
void codeRelativeRows(const RelativeHeights& of, Io& io, const ExactSample& exact,
                      const TakeSample& take) {
  const auto& [header, relative, heights, fraction_bits] = of;
  const uint32_t width = heights.width;
  KnownMultiples known(width, relative);
  const StepUnits units = known.units();
  const StepGrid grid(header.base, header.step);
  CorrectionCoder<Io> multiples(width, kMultipleHints, io), rests(width, kRestHints, io);
  for (uint32_t y = 0; y < heights.height; ++y) {
    known.nextRow();
    multiples.nextRow();
    rests.nextRow();
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = size_t{y} * width + x;
      if (!heights.valid[i]) continue;
      const int32_t q = wholeStep(heights.data[i], fraction_bits);
      const RelativePrediction prediction = known.predict(x, grid.inUnitsOf(units.exponent, q));
      const T truth = exact(i);
      const int32_t beside =
          multiples.code(x, prediction.multiple_hint, multiplesBeside(prediction, truth, units));
      if (io.stopped()) return;
      const RoundedMultiple<T> rounded(prediction, prediction.number(beside), units);
      const int32_t rest = rests.code(x, rounded.rest_hint, rounded.restOf(truth));
      if (io.stopped()) return;
      const T sample = rounded.sample(rest);
      known.put(x, rounded.multiple, rest, sample);
      take(i, sample);
    }
  }
}

}  // namespace tetrakis::inline relative
