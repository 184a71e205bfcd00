// SPDX-License-Identifier: Apache-2.0
// The functions here measure how far samples that come back from steps are from the true ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

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

}  // namespace tetrakis::inline quantiser
