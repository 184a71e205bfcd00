// SPDX-License-Identifier: Apache-2.0
// Samples with a *relative step* lie whole multiples of it from what their neighbours predict,
// though no base and step hold all of them: whole metres above a geoid, or above a slope; floats
// out of LERC, each square of which has an offset of its own; two surveys side by side.
//
// The exact neighbours before a sample, W + N - NW, say where its multiples lie, also across the
// borders of squares and on slopes. The decoded height says which of them it is, if it is off by
// less than half of the step. So two corrections restore a sample: how many multiples it lies
// beside that one, mostly none, and how many neighbouring values of its type beside the multiple,
// which is what the rounding of floats leaves.
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

namespace tetrakis::inline relative {

inline constexpr size_t kMultipleHints = 8, kRestHints = 3;

/// Where the multiples lie, and which of them is nearest to the decoded height.
struct RelativePrediction {
  double origin;         ///< a multiple
  int32_t nearest;       ///< relative steps from it to the multiple nearest to the height
  bool above;            ///< that one lies above the height
  size_t multiple_hint;  ///< how near the height is to the middle of two multiples
  size_t rest_hint;      ///< how many neighbours are missing

  /// The relative steps to the multiple so many beside the nearest one, to the height's side of it.
  int32_t number(int32_t beside) const {
    const auto side = static_cast<uint32_t>(beside);
    return static_cast<int32_t>(static_cast<uint32_t>(nearest) + (above ? 0u - side : side));
  }
};

/// What is known of the multiples in two rows.
class KnownMultiples {
 public:
  KnownMultiples(uint32_t width, const RelativeSteps& relative)
      : step_(relative.step),
        pull_(relative.quarters / 4.),
        above_(size_t{width} + 1, kMissing),
        here_(above_) {}

  /// Begins a row, whose multiples are missing until they are put.
  void nextRow() {
    std::swap(above_, here_);
    std::fill(here_.begin(), here_.end(), kMissing);
  }

  /// Predicts the sample of column x. height: the decoded one, finite.
  RelativePrediction predict(uint32_t x, double height) const {
    constexpr double kFarthest = 1 << 30;
    const double west = here_[x], north = above_[x + 1], corner = above_[x];
    const double plane = (west + north) - corner;
    RelativePrediction p{height, 0, false, 0, 2};
    if (std::isfinite(plane)) {
      p.origin = plane;
      p.rest_hint = 0;
    } else if (!std::isnan(west) || !std::isnan(north)) {
      p.origin = std::isnan(west) ? north : west;
      p.rest_hint = 1;
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

  /// The sample of column x lies `rest` values beside the multiple of that number. Infinity and NaN
  /// count as missing.
  void put(uint32_t x, const RelativePrediction& prediction, int32_t number, int32_t rest,
           double sample) {
    const double multiple = prediction.origin + static_cast<double>(number) * step_;
    const bool rounded = rest >= -1 && rest <= 1;
    const double known = rounded ? multiple + (sample - multiple) * pull_ : sample;
    here_[x + 1] = std::isfinite(known) ? known : kMissing;
  }

 private:
  static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  double step_, pull_;
  std::vector<double> above_, here_;  ///< with a margin at the left
};

}  // namespace tetrakis::inline relative
