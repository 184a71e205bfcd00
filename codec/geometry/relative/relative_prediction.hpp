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
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline relative {

inline constexpr size_t kMultipleHints = 8;
/// Places between a value and the middle of two; then those of multiples that planes do not say.
inline constexpr size_t kRestPlaces = 8, kRestHints = kRestPlaces + 2;

/// Where the multiples lie, and which of them is nearest to the decoded height.
struct RelativePrediction {
  double origin;         ///< a multiple
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
  double multiple;
  T value;
  bool below;        ///< the multiple lies below the value
  size_t rest_hint;  ///< how near the multiple is to the middle of two values

  RoundedMultiple(const RelativePrediction& prediction, int32_t number, double step)
      : multiple(prediction.origin + static_cast<double>(number) * step),
        value(restore<T>(prediction.origin, step, number)) {
    const double off = std::ldexp(multiple - static_cast<double>(value), -spacingExponent(value));
    below = off < 0;
    rest_hint = prediction.missing > 0
                    ? kRestPlaces + prediction.missing - 1
                    : static_cast<size_t>(
                          std::min(std::abs(off) * 2 * kRestPlaces, double{kRestPlaces - 1}));
  }

  /// The value so many beside the one next to the multiple, to the multiple's side of it.
  T sample(int32_t rest) const {
    return fromOrder<T>(orderOf(value) + static_cast<uint32_t>(toSide(rest, below)));
  }
  /// And how many beside it a sample lies.
  int32_t restOf(T sample) const {
    return toSide(static_cast<int32_t>(orderOf(sample) - orderOf(value)), below);
  }
};

/// What is known of the multiples in three rows.
class KnownMultiples {
 public:
  KnownMultiples(uint32_t width, const RelativeSteps& relative)
      : step_(relative.step),
        pull_(relative.quarters / 4.),
        above_(size_t{width} + kLeft + 1, kMissing),
        here_(above_),
        twice_above_(above_) {}

  /// Begins a row, whose multiples are missing until they are put.
  void nextRow() {
    std::swap(twice_above_, above_);
    std::swap(above_, here_);
    std::fill(here_.begin(), here_.end(), kMissing);
  }

  /// Predicts the sample of column x. height: the decoded one, finite.
  RelativePrediction predict(uint32_t x, double height) const {
    constexpr double kFarthest = 1 << 30;
    const double west = here_[x + kLeft - 1], north = above_[x + kLeft];
    const double mean = meanOfPlanes(x);
    RelativePrediction p{height, 0, false, 0, 2};
    if (std::isfinite(mean)) {
      p.origin = mean;
      p.missing = 0;
    } else if (!std::isnan(west) || !std::isnan(north)) {
      p.origin = std::isnan(west) ? north : west;
      p.missing = 1;
    }
    const double steps = std::clamp((height - p.origin) / step_, -kFarthest, kFarthest);
    const double nearest = std::floor(steps + 0.5);
    const double off = nearest - steps;
    p.nearest = static_cast<int32_t>(nearest);
    p.above = off > 0;
    p.multiple_hint = static_cast<size_t>(
        std::min(std::abs(off) * 2 * kMultipleHints, double{kMultipleHints - 1}));
    return p;
  }

  /// The sample of column x lies `rest` values beside a multiple. What is no finite number counts
  /// as missing.
  void put(uint32_t x, double multiple, int32_t rest, double sample) {
    const bool rounded = rest >= -1 && rest <= 1;
    const double known = rounded ? multiple + (sample - multiple) * pull_ : sample;
    here_[x + kLeft] = std::isfinite(known) ? known : kMissing;
  }

 private:
  static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  static constexpr size_t kLeft = 2;  ///< the margin there

  /// The mean of the plane through W, N and NW and of others that differ from it by some spacings
  /// of floats, beside whole steps. Not finite where one of the three is missing.
  double meanOfPlanes(uint32_t x) const {
    const double west = here_[x + kLeft - 1], north = above_[x + kLeft];
    const double plane = (west + north) - above_[x + kLeft - 1];
    const double near = std::abs(plane) * 0x1p-22;  // 2 to 4 spacings
    double sum = 0;
    int count = 1;
    for (const double other : {2 * west - here_[x], 2 * north - twice_above_[x + kLeft],
                               (west + above_[x + kLeft + 1]) - north}) {
      const double apart = other - plane;
      const double off = apart - std::floor(apart / step_ + 0.5) * step_;
      if (!(std::abs(off) <= near)) continue;  // nor if it is missing
      sum += off;
      ++count;
    }
    return plane + sum / count;
  }

  double step_, pull_;
  std::vector<double> above_, here_, twice_above_;  ///< with margins at the left and the right
};

}  // namespace tetrakis::inline relative
