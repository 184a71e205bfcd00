// SPDX-License-Identifier: Apache-2.0
// sampleDetails() samples the orthonormal Haar details of an image at all scales, to which the axes
// of colour are fitted. Encoder only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline colour {

using Colour = std::array<float, 3>;

/// Details of one scale.
struct ColourDetails {
  std::array<std::vector<float>, 3> channels;  ///< of each detail
  double weight = 1;                           ///< coefficients of the image that each stands for

  size_t count() const { return channels[0].size(); }
  void add(const Colour& detail) {
    for (size_t k = 0; k < detail.size(); ++k) channels[k].push_back(detail[k]);
  }
};

/// [i]: of level i + 1, some thousands at most. channels: 3 or more of that extent.
/// Empty where the image has less than two rows or columns.
std::vector<ColourDetails> sampleDetails(std::span<const int32_t* const> channels, Extent extent);

/// Mean over samples and channels; 0 if there are none.
double meanMagnitude(const ColourDetails& details);

/// The magnitude that a tenth of all coefficients of the channels exceed: about the step at middle
/// rates.
double typicalStep(std::span<const ColourDetails> details);

/// Estimated bits of all coefficients along one axis, a unit vector: log2(1 + |c| / step) each.
double bitsAlong(const std::array<double, 3>& axis, const ColourDetails& details, double step);

}  // namespace tetrakis::inline colour
