// SPDX-License-Identifier: Apache-2.0
// Samples with a *relative step* lie whole multiples of it from what their neighbours predict,
// though no base and step hold all of them: whole metres above a geoid, or above a slope; floats
// out of LERC, each square of which has an offset of its own; two surveys side by side.
//
// The exact neighbours before a sample, W + N - NW, say where its multiples lie, also across the
// borders of squares and on slopes. Where other planes through neighbours nearly agree, up to whole
// steps, their mean says it better: each neighbour is off by what the rounding of its float left.
// The decoded height says which of the multiples it is, if it is off by less than half of the step.
// So two corrections restore a sample: how many multiples it lies beside that one, mostly none, and
// how many neighbouring values of its type beside the multiple, which is what the rounding of
// floats leaves: mostly 0, or 1 to the side where the multiple lies between two values.
//
// A multiple that has a geoid in it is known better than its rounded sample says: it is pulled from
// where its neighbours predict it only a quarter of the way to the sample. Where the offsets were
// rounded themselves, as those of LERC, the samples are the multiples.
//
// All numbers here are integers that count units of the step (codec/geometry/steps/step_units.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline relative {

inline constexpr size_t kMultipleHints = 8;
/// Places between a value and the middle of two; then those of multiples that planes do not say.
inline constexpr size_t kRestPlaces = 8;

/// The whole steps in so many units, to the nearest, and not too many for 32 bits.
inline int64_t nearestSteps(int64_t units, int64_t step) {
  constexpr int64_t kFarthest = 1 << 30;
  return std::clamp(floorDiv(units + step / 2, step), -kFarthest, kFarthest);
}

/// Where the multiples lie, and which of them is nearest to the decoded height.
struct RelativePrediction {
  int64_t origin;        ///< a multiple, in units
  int32_t nearest;       ///< relative steps from it to the multiple nearest to the height
  bool above;            ///< that one lies above the height
  size_t multiple_hint;  ///< how near the height is to the middle of two multiples
  size_t missing;        ///< how many neighbours are

  /// The relative steps to the multiple so many beside the nearest one, to the height's side of it.
  int32_t number(int32_t beside) const {
    const auto side = static_cast<uint32_t>(toSide(beside, above));
    return static_cast<int32_t>(static_cast<uint32_t>(nearest) + side);
  }
};

/// A multiple, and the value of type T next to it.
template <class T>
struct RoundedMultiple {
  int64_t multiple;  ///< in units
  T value;
  bool below;        ///< the multiple lies below the value
  size_t rest_hint;  ///< how near the multiple is to the middle of two values

  RoundedMultiple(const RelativePrediction& prediction, int32_t number, const StepUnits& units)
      : multiple(prediction.origin + number * units.step),
        value(nearestSample<T>(multiple, units.exponent)) {
    const int64_t off = multiple - inUnits(value, units.exponent);
    below = off < 0;
    const int spacing = spacingExponent(value) - units.exponent;  // log2 of it, in units
    rest_hint = prediction.missing > 0 ? kRestPlaces + prediction.missing - 1
                                       : placeOf(std::abs(off), spacing);
  }

  /// The value so many beside the one next to the multiple, to the multiple's side of it.
  T sample(int32_t rest) const {
    return fromOrder<T>(orderOf(value) + static_cast<uint32_t>(toSide(rest, below)));
  }
  /// And how many beside it a sample lies.
  int32_t restOf(T sample) const {
    return toSide(static_cast<int32_t>(orderOf(sample) - orderOf(value)), below);
  }

 private:
  /// The place of a distance from a value: 2 * kRestPlaces of them are 2^spacing units.
  static size_t placeOf(int64_t off, int spacing) {
    constexpr int kPlacesLog2 = 4;
    const int64_t places = scaled(off, kPlacesLog2) >> std::clamp(spacing, 0, 62);
    return static_cast<size_t>(std::min<int64_t>(places, kRestPlaces - 1));
  }
};

/// What is known of the multiples in three rows, in units.
class KnownMultiples {
 public:
  KnownMultiples(uint32_t width, const RelativeSteps& relative)
      : units_(stepUnits(relative.step)),
        quarters_(relative.quarters),
        above_(size_t{width} + kLeft + 1, kMissing),
        here_(above_),
        twice_above_(above_) {}

  const StepUnits& units() const { return units_; }

  /// Begins a row, whose multiples are missing until they are put.
  void nextRow() {
    std::swap(twice_above_, above_);
    std::swap(above_, here_);
    std::fill(here_.begin(), here_.end(), kMissing);
  }

  /// Predicts the sample of column x. height: the decoded one.
  RelativePrediction predict(uint32_t x, int64_t height) const {
    const int64_t west = here_[x + kLeft - 1], north = above_[x + kLeft];
    RelativePrediction p{height, 0, false, 0, 2};
    if (west != kMissing && north != kMissing && above_[x + kLeft - 1] != kMissing) {
      p.origin = meanOfPlanes(x);
      p.missing = 0;
    } else if (west != kMissing || north != kMissing) {
      p.origin = west == kMissing ? north : west;
      p.missing = 1;
    }
    const int64_t rise = height - p.origin, nearest = nearestSteps(rise, units_.step);
    const int64_t off = nearest * units_.step - rise;
    p.nearest = static_cast<int32_t>(nearest);
    p.above = off > 0;
    const int64_t halves = std::min(std::abs(off), units_.step / 2);
    p.multiple_hint = static_cast<size_t>(
        std::min<int64_t>(halves * 2 * int64_t{kMultipleHints} / units_.step, kMultipleHints - 1));
    return p;
  }

  /// The sample of column x lies `rest` values beside a multiple. A sample that is no number, or
  /// lies far beyond the step, counts as missing.
  template <class T>
  void put(uint32_t x, int64_t multiple, int32_t rest, T sample) {
    if (!isNumber(sample)) return;
    const int64_t units = inUnits(sample, units_.exponent);
    const bool rounded = rest >= -1 && rest <= 1 && std::abs(multiple) < 2 * kFar;
    const int64_t known = rounded ? multiple + (((units - multiple) * quarters_ + 2) >> 2) : units;
    if (std::abs(units) < kFar && std::abs(known) < kFar) here_[x + kLeft] = known;
  }

 private:
  static constexpr int64_t kMissing = std::numeric_limits<int64_t>::min();
  static constexpr size_t kLeft = 2;  ///< the margin there

  /// The mean of the plane through W, N and NW, none of which is missing, and of others that differ
  /// from it by some spacings of floats, beside whole steps.
  int64_t meanOfPlanes(uint32_t x) const {
    const int64_t west = here_[x + kLeft - 1], north = above_[x + kLeft];
    const int64_t plane = west + north - above_[x + kLeft - 1];
    const int64_t near = (std::abs(plane) >> 22) + 1;  // 2 to 4 spacings
    int64_t sum = 0, count = 1;
    const auto take = [&](int64_t first, int64_t second, int64_t less) {
      if (second == kMissing || less == kMissing) return;
      const int64_t apart = first + second - less - plane;
      const int64_t off = apart - floorDiv(apart + units_.step / 2, units_.step) * units_.step;
      if (std::abs(off) > near) return;
      sum += off;
      ++count;
    };
    take(west, west, here_[x]);
    take(north, north, twice_above_[x + kLeft]);
    take(west, above_[x + kLeft + 1], north);
    return plane + floorDiv(2 * sum + count, 2 * count);
  }

  StepUnits units_;
  int64_t quarters_;
  std::vector<int64_t> above_, here_, twice_above_;  ///< with margins at the left and the right
};

// codeRelativeRows() walks over samples that have a relative step, for both sides: row by row, two
// corrections for each sample that exists.

/// What samples with a relative step are restored from.
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
  CorrectionCoder<Io> multiples(width, io), rests(width, io);
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

// restoreRelative() restores samples that have a relative step from a codeword and decoded heights.

/// The heights with the samples restored, row by row, as far as they are decided; meshes pass
/// through these as well. decoded: first rows of what encodeRelative() coded, whole, without
/// corrections. codeword: any prefix of its one. relative: a finite and positive step, 1 to 4
/// quarters. Safe on any bytes.
DecodedHeights restoreRelative(DecodedHeights decoded, const GeometryHeader& header,
                               const RelativeSteps& relative, std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline relative
