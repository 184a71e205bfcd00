// SPDX-License-Identifier: Apache-2.0
// HeightSteps is heights of any sample type as integer steps, with the mask of the valid ones. The
// functions of this file find the valid samples, restore samples, measure the errors of steps, and
// choose the voids that are bridged: all that an encoder does with steps once base and step are
// known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

// findVoids() finds the samples of a height field that are valid, from its nodata value and NaN.

/// Returns one byte for each sample, which is 1 where the sample is valid and 0 where it is void,
/// or nothing if all samples are valid. A sample is void if it equals heights.nodata (and there is
/// has_nodata) or is NaN. TKS_USAGE: a sample is infinite; its place is in the message.
Result<std::vector<uint8_t>> findVoids(const tks_heights& heights);

/// Whether streams of these heights state their nodata value: NaN is that of floats anyway, and no
/// integer is infinite.
inline bool statesNodata(const tks_heights& heights) {
  const bool infinite_integer = heights.sample != TKS_F32 && !std::isfinite(heights.nodata);
  return heights.has_nodata != 0 && !std::isnan(heights.nodata) && !infinite_integer;
}

/// The smallest and the largest of the valid samples; both are 0 if no sample is valid.
struct SampleRange {
  double low = 0, high = 0;
};
SampleRange rangeOf(const tks_heights& heights, Mask valid);

// HeightSteps holds heights of any sample type as integer steps: sample = base + q * step.
// sampleCorrections() computes the corrections that restore samples which their steps do not show.

/// Returns the size of a height field of the C interface.
inline Extent extentOf(const tks_heights& heights) {
  return {heights.width, heights.height};
}

struct HeightSteps {
  std::vector<int32_t> steps;   ///< |q| <= 2^25, centred on 0; of voids any
  std::vector<uint8_t> valid;   ///< 1 valid, 0 void; empty: all are valid
  uint8_t bridge = 0;           ///< the reach of bridges over voids (codec/wavelet/morphology.hpp)
  std::vector<uint8_t> lifted;  ///< with bridges only: liftedSamples()
  double base = 0, step = 1;
  ValueTable table;    ///< not empty: steps count its values, which `base` and `step` approximate
  bool exact = false;  ///< every valid sample comes back bit for bit
  int range_bits = 0;  ///< the steps span less than 2^range_bits
  uint32_t patch_rows = 0;          ///< as of PlaneView
  std::vector<uint8_t> owned = {};  ///< of a forest: 1 where no other sample owns one; empty: all

  size_t validCount() const;
  size_t liftedCount() const;
  /// The share of the squared error of the lifted samples that falls, roughly, on the valid ones.
  double liftedShare() const;
  /// The steps as a plane for the transform.
  PlaneView<const int32_t> lifting(Extent plane) const {
    PlaneView<const int32_t> view(steps, plane, bridge == 0 ? valid : lifted);
    view.patch_rows = patch_rows;
    return view;
  }
};

/// The whole steps of the heights as decoders have them, which turn places in a table into heights.
std::vector<int32_t> decodedSteps(const HeightSteps& steps, const GeometryHeader& header);

/// The corrections that restore the samples.
std::vector<int32_t> sampleCorrections(const tks_heights& heights, const HeightSteps& steps);

// errorsOf() and squaresOfSamples() measure how far samples that come back from steps are from the
// true ones.

/// Largest distance between a valid sample and the sample that its step restores, and the sum of
/// the squared distances; in sample units.
struct StepErrors {
  double largest = 0, squares = 0;
};
/// The rule by which squared errors add up.
struct SquareSum {
  double most = std::numeric_limits<double>::infinity();  ///< largest error that one sample adds
  std::span<const uint32_t> times = {};                   ///< how often each counts; empty: once
  double of(size_t sample, double error) const {
    const double square = std::min(error * error, most);
    return times.empty() ? square : times[sample] * square;
  }
};
StepErrors errorsOf(const tks_heights& heights, const HeightSteps& steps,
                    const SquareSum& sum = {});

/// The squared distances between decoded samples, corrections included, and the true ones, over the
/// samples that `valid` marks (empty: all). scale: the base and step of the decoded heights.
double squaresOfSamples(const tks_heights& truth, const DecodedHeights& decoded,
                        const std::vector<uint8_t>& valid, const HeightSteps& scale,
                        const SquareSum& sum);

// withBridges() marks the bridged voids of heights in steps (codec/wavelet/morphology.hpp), and
// withBridgesFor() chooses them.

/// The steps with bridges of the given reach over voids; 0: without any.
HeightSteps withBridges(HeightSteps steps, Extent plane, uint8_t reach);

/// The steps with the bridges that pay, if any do.
HeightSteps withBridgesFor(const BridgeTarget& target, HeightSteps steps, Extent plane);

}  // namespace tetrakis::inline quantiser
