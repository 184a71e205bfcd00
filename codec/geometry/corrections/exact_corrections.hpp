// SPDX-License-Identifier: Apache-2.0
// Exact corrections turn decoded heights, which have fractions of steps, into the whole steps that
// they come from, row by row. All samples before one are exact then: the errors of the decoded
// heights are known there and foretell its own (error_forecast.hpp). The height and its foretold
// error add up to a sum, and the step nearest to it is the one that the sample is expected to have.
// Numbers count on the side of that step where the sum lies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/corrections/error_forecast.hpp"

namespace tetrakis::inline corrections {

/// The step nearest to a height plus its foretold error, halves up.
struct ForetoldStep {
  int32_t step;
  bool below;    ///< the height lies below it
  size_t place;  ///< of kPlaces between the step and the middle of two

  static constexpr size_t kPlaces = 8;

  ForetoldStep(int32_t height, int32_t foretold, int fraction_bits) {
    const int some = fraction_bits > 0;
    const auto sum =
        static_cast<int32_t>(static_cast<uint32_t>(height) + static_cast<uint32_t>(foretold));
    step = (sum >> fraction_bits) + ((sum >> (fraction_bits - some)) & some);
    const uint32_t whole = static_cast<uint32_t>(step) << fraction_bits;
    const auto beside = static_cast<int32_t>(static_cast<uint32_t>(sum) - whole);
    below = beside < 0;
    place =
        std::min(static_cast<size_t>(std::abs(beside)) * 2 * kPlaces >> fraction_bits, kPlaces - 1);
  }

  int32_t correctionTo(int32_t exact) const {
    return toSide(static_cast<int32_t>(static_cast<uint32_t>(exact) - static_cast<uint32_t>(step)),
                  below);
  }
  int32_t corrected(int32_t correction) const {
    return static_cast<int32_t>(static_cast<uint32_t>(step) +
                                static_cast<uint32_t>(toSide(correction, below)));
  }
};

/// Codes all steps. heights: in units of 2^-fraction_bits steps. exact(sample): the whole steps
/// that the sample comes from, or any number in decoders. take(first, row): takes the steps row by
/// row, up to the first undecided one; 0 where samples are void.
template <class Io, class ExactStep, class TakeRow>
void codeExactSteps(const PlaneView<const int32_t>& heights, int fraction_bits, Io& io,
                    const ExactStep& exact, const TakeRow& take) {
  ErrorForecast forecast(heights.width);
  NumberRows rows(heights.width);
  NumberCoder<Io> coder(io);
  std::vector<int32_t> row(heights.width);
  for (uint32_t y = 0; y < heights.height; ++y) {
    const size_t first = size_t{y} * heights.width;
    forecast.nextRow();
    rows.nextRow();
    for (uint32_t x = 0; x < heights.width; ++x) {
      row[x] = 0;
      if (!heights.valid[first + x]) continue;
      const int32_t height = heights.data[first + x];
      forecast.look(x);
      const ForetoldStep step(height, forecast.foretold(), fraction_bits);
      const int32_t known = step.correctionTo(exact(first + x));
      const NearNumbers near = rows.near(x, step.step, step.below);
      row[x] = step.corrected(coder.code(near, {forecast.missedLevel(), step.place}, known));
      if (io.stopped()) return take(first, std::span<const int32_t>(row).first(x));
      const auto whole = static_cast<int32_t>(static_cast<uint32_t>(row[x]) << fraction_bits);
      forecast.learn(x, int64_t{whole} - height);
      rows.put(x, row[x]);
    }
    take(first, std::span<const int32_t>(row));
  }
}

}  // namespace tetrakis::inline corrections
