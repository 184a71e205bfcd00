// SPDX-License-Identifier: Apache-2.0
// The functions here find the axes of colour along which an image is cheapest to code: a
// coefficient c at a step T costs about log2(1 + |c| / T) bits, and the axes are turned by small
// rotations until the sum of these costs is least. Encoder only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour/colour_details.hpp"

namespace tetrakis::inline colour {

/// Axes of colour that need the fewest bits: rows of rotations, luma first.
struct ColourAxes {
  std::vector<ColourDetails> details;  ///< empty: the image is too small to have any
  Matrix3 overall;                     ///< for all scales, each counting as much
  std::vector<Matrix3> levels;         ///< [i]: for level i + 1; as many as details
};

/// Fits axes to 3 or more channels of that extent.
ColourAxes fitAxes(std::span<const int32_t* const> channels, Extent extent, Purpose purpose);

}  // namespace tetrakis::inline colour
